#pragma once

#include <cstddef>

#include "recording/recording.h"
#include "recording/recording_file.h"

namespace sonarsim {

/// Adds the pings of the files under `logs` of recording.yaml: .kmall, .raw of an EK60, .aris, logs
/// of a Ping360. What a file says of ranges, bearings, times, frequency and law is taken from it;
/// InputError where recording.yaml has to say it, where both do, or where the file is damaged.
void read_log_pings(const RecordingFile& file, std::size_t most_pings, Recording& recording);

/// The same of soundings: a .kmall's.
void read_log_soundings(const RecordingFile& file, std::size_t most_pings, Recording& recording);

}  // namespace sonarsim
