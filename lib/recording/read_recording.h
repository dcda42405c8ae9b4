#pragma once

#include <filesystem>

#include "recording/options.h"
#include "recording/recording.h"

namespace sonarsim {

/// Reads the pings of a real sonar or of a dataset. `path` is a folder with recording.yaml, such a
/// file, or the folder of a dataset. InputError, with the file and the cure, for what cannot be
/// read.
Recording load_recording(const std::filesystem::path& path, const RecordingOptions& options = {});

}  // namespace sonarsim
