#pragma once

#include "compare/measured.h"
#include "recording/recording.h"

namespace sonarsim {

/// The interval of angles from the vertical that both recordings cover.
struct CommonAngles {
    double from_rad = 0.0;
    double to_rad = 0.0;
};
CommonAngles common_angles(const Recording& a, const Recording& b);

/// Figures of soundings by angle: level, its variation, and the spread of ranges about a parabola
/// through the soundings of one ping in a band of 10 degrees. Locations are groups of eight pings,
/// since the bottom and the sea change slowly from ping to ping. Powers are divided by
/// `unit_power`.
Measurement measure_soundings(const Recording& recording, CommonAngles angles, double unit_power);

/// The mean power of all soundings; 1 if it is 0.
double mean_power_of_soundings(const Recording& recording);

}  // namespace sonarsim
