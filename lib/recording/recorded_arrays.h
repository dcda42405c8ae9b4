#pragma once

#include <cstddef>

#include "recording/recording.h"
#include "recording/recording_file.h"

namespace sonarsim {

/// The pings of the arrays that recording.yaml names; the first `most_pings`, or all for 0.
/// InputError for files that are damaged or do not fit together.
Recording read_recorded_arrays(const RecordingFile& file, std::size_t most_pings);

}  // namespace sonarsim
