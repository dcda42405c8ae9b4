#pragma once

#include <cstddef>

#include "recording/recording.h"
#include "recording/recording_file.h"

namespace sonarsim {

/// Adds the pings of the files of an Oculus that recording.yaml names, with their ranges, bearings,
/// frequency and speed of sound. InputError when a file is damaged, or when ranges or beams change
/// from ping to ping.
void read_oculus_pings(const RecordingFile& file, std::size_t most_pings, Recording& recording);

}  // namespace sonarsim
