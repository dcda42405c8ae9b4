#pragma once

#include <cstddef>

#include "recording/recording.h"
#include "recording/recording_file.h"

namespace sonarsim {

/// Adds the pings of the files under `logs` of recording.yaml: .kmall, .raw of an EK60, .aris, logs
/// of a Ping360. Ranges, bearings, times, frequency and law are those of the file if it has them.
/// InputError if neither the file nor recording.yaml has one, if both do, or if the file is
/// damaged.
void read_log_pings(const RecordingFile& file, std::size_t most_pings, Recording& recording);

/// The same for soundings of a .kmall.
void read_log_soundings(const RecordingFile& file, std::size_t most_pings, Recording& recording);

}  // namespace sonarsim
