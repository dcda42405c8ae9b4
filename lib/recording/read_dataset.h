#pragma once

#include <filesystem>

#include "recording/options.h"
#include "recording/recording.h"

namespace sonarsim {

/// The pings of a sensor of a dataset, to compare it like a real sonar: raw/ where it was written,
/// else polar/ or the file of records. Soundings are those of a profiling sonar. InputError when it
/// is damaged, when the sensor is not named and there are several, and when the sensor has no
/// arrays that are read.
Recording read_dataset_recording(const std::filesystem::path& folder,
                                 const RecordingOptions& options);

}  // namespace sonarsim
