#pragma once

#include "mission/mission.h"
#include "recording/recording.h"

namespace sonarsim {

/// InputError with the reason if a recording cannot be calibrated: fewer than two pings, all values
/// alike, more than 90 % of them 0, more than 10 % at the largest value, or another kind than the
/// sonar of the start.
void check_usable(const Recording& recording, SonarKind start);

/// Parts of a recording. The pings of each part are consecutive.
struct SplitRecording {
    Recording fitted, judged;
};

/// The last `judged_share` of the pings is judged, rounded down, at least one; the rest is fitted.
/// `reversed`: the first are judged.
SplitRecording split(const Recording& recording, double judged_share, bool reversed);

}  // namespace sonarsim
