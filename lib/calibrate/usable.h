#pragma once

#include "mission/mission.h"
#include "recording/recording.h"

namespace sonarsim {

/// InputError, which says why, when a recording cannot be calibrated: one ping, nothing in it, most
/// values at the largest one, or another kind than the sonar of the start.
void check_usable(const Recording& recording, SonarKind start);

/// Parts of a recording. The pings of each follow each other.
struct SplitRecording {
    Recording fitted, judged;
};

/// The last `judged_share` of the pings is judged, rounded down, at least one; the rest is fitted.
/// `reversed`: the first are judged.
SplitRecording split(const Recording& recording, double judged_share, bool reversed);

}  // namespace sonarsim
