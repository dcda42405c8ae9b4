#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "assembly/assemble.h"
#include "mission/mission.h"

namespace sonarsim {

/// From the least of some values to the greatest; empty until one is taken in.
struct Interval {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    bool empty() const { return low > high; }
    void take(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

/// Why pings saw nothing: of the blind ones, how many are so for each reason.
struct Blindness {
    std::size_t too_far = 0;    ///< what is in view begins behind range_max_m
    std::size_t too_near = 0;   ///< all that is in view ends before range_min_m
    std::size_t too_flat = 0;   ///< within range there is surface above or below the view alone
    std::size_t elsewhere = 0;  ///< within range there is surface in other directions alone
    std::size_t nothing = 0;    ///< no surface within range in any direction
    Interval in_view_m;  ///< where what is in view begins, in the pings for which it is too far
    Interval ends_m;     ///< where it ends, in those for which it is too near
    Interval
        elevation_deg;   ///< the nearest surface to the view, in those for which that is too flat
    Interval nearest_m;  ///< to the box around the scene, where there is no surface within range
};

/// What a sonar sees in a few of its pings, spread over the trajectory.
struct SonarSurvey {
    std::size_t pings = 0;  ///< that were looked at
    std::size_t blind = 0;  ///< of these, those that lit no bin
    Blindness why;
    std::size_t below_surface = 0;  ///< pings with surface above and none below
    std::size_t enclosed = 0;       ///< pings from within one instance of several
    std::string enclosed_by;        ///< the last of these instances
    Interval altitude_m;            ///< empty where there is never anything below
    Interval roll_deg;              ///< of the vehicle
    Interval pitch_deg;
    Interval first_echo_m;  ///< of each ping that saw anything
    Interval last_echo_m;
    double lit_share = 0.0;    ///< of the bins of all pings
    double white_share = 0.0;  ///< of the lit bins, above the white of pictures
    float brightest = 0.0F;
    double signal = 0.0;          ///< mean intensity of the lit bins without pixel noise
    double noise = 0.0;           ///< mean deviation of the noise that is added to them
    std::vector<double> seen_m2;  ///< surface that was seen, by Scene::instances
};

/// Pings a few dozen poses with every sonar of the mission, at a coarse sampling and with rays. By
/// Mission::sensors. The same mission gives the same numbers.
std::vector<SonarSurvey> survey(const Mission& mission, const Assembly& assembly,
                                const VisibilityEngine& rays);

}  // namespace sonarsim
