#pragma once

#include <Eigen/Geometry>
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
struct ValueRange {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    bool empty() const { return low > high; }
    void take(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

/// Counts of the pings without returns, by the reason.
struct NoReturnReasons {
    std::size_t too_far = 0;    ///< the surface in view begins behind range_max_m
    std::size_t too_near = 0;   ///< the surface in view ends before range_min_m
    std::size_t too_flat = 0;   ///< within range there is surface above or below the view alone
    std::size_t elsewhere = 0;  ///< within range there is surface in other directions alone
    std::size_t nothing = 0;    ///< no surface within range in any direction
    std::size_t depths = 0;     ///< z above the scene whose negative would be a place over it
    ValueRange in_view_m;       ///< begin of the surface in view, of the pings that are too far
    ValueRange ends_m;          ///< end of the surface in view, of those that are too near
    ValueRange elevation_deg;   ///< surface nearest to the view, of those that are too flat
    ValueRange nearest_m;       ///< distance to the box around the scene, of those with nothing
};

/// A sonar's view of the scene in a few of its pings along the trajectory.
struct SonarSurvey {
    std::size_t pings = 0;  ///< number of pings that were tried
    std::size_t blind = 0;  ///< pings without an occupied bin
    NoReturnReasons no_return;
    std::size_t below_surface = 0;  ///< pings with surface above and none below
    std::size_t enclosed = 0;       ///< pings from within one instance of several
    std::string enclosed_by;        ///< the last of these instances
    ValueRange altitude_m;          ///< empty if there is never anything below
    ValueRange roll_deg;            ///< attitude of the vehicle
    ValueRange pitch_deg;
    ValueRange first_echo_m;  ///< one value for each ping that saw anything
    ValueRange last_echo_m;
    double occupied_share = 0.0;  ///< a share of the bins of all pings
    double white_share = 0.0;     ///< share of the occupied bins above the white of pictures
    float brightest = 0.0F;
    double signal = 0.0;          ///< mean intensity of the occupied bins without pixel noise
    double noise = 0.0;           ///< mean deviation of the noise that is added to them
    std::vector<double> seen_m2;  ///< visible surface, by Scene::instances
};

/// Traces a few dozen pings of every sonar of the mission with rays, coarsely sampled. By
/// Mission::sensors. The same mission gives the same numbers.
std::vector<SonarSurvey> survey(const Mission& mission, const Assembly& assembly,
                                const VisibilityEngine& rays);

}  // namespace sonarsim
