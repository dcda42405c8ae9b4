#pragma once

#include <cstddef>

#include "recording/recording.h"
#include "recording/recording_file.h"

namespace sonarsim {

/// Adds the pings of the files under `logs` of recording.yaml, of the formats of read_sonar_log().
/// Ranges, bearings, times and law are those of the files if they have them; a speed of sound and a
/// frequency in recording.yaml take precedence. InputError if neither the file nor recording.yaml
/// has the law, the speed of sound or the bearings of an imaging sonar, if both have a law, or if
/// the file is damaged.
void read_log_pings(const RecordingFile& file, std::size_t most_pings, Recording& recording);

/// The same for soundings of a .kmall.
void read_log_soundings(const RecordingFile& file, std::size_t most_pings, Recording& recording);

}  // namespace sonarsim
