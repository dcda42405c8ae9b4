#pragma once

#include <cstddef>

#include "recording/recording.h"
#include "recording/recording_file.h"

namespace sonarsim {

/// Adds the side-scan pings of the XTF files that recording.yaml names, with their times, ranges
/// and speed of sound. InputError when a file is damaged, or when the range changes from ping to
/// ping.
void read_xtf_pings(const RecordingFile& file, std::size_t most_pings, Recording& recording);

/// The same for a multibeam's soundings.
void read_xtf_pings_of_soundings(const RecordingFile& file, std::size_t most_pings,
                                 Recording& recording);

}  // namespace sonarsim
