#pragma once

#include <string>

#include "recording/recording.h"

namespace sonarsim {

/// InputError when a recording has no pings, pings without values or of different sizes, values
/// that are not finite, negative values that its law does not allow, or another number of bearings
/// than of beams. `source` is for the message.
void check_recording(const Recording& recording, const std::string& source);

}  // namespace sonarsim
