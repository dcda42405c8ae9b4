#pragma once

#include <string>

#include "recording/recording.h"

namespace sonarsim {

/// InputError when a recording has no pings, pings without values or of other sizes, values that
/// are not finite or negative where the law has none, or bearings that are not as many as its
/// beams. `source` is for the message.
void check_recording(const Recording& recording, const std::string& source);

}  // namespace sonarsim
