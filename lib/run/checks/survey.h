#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "input/mission/mission.h"
#include "simulate/assembly/assemble.h"

namespace sonarsim {

/// The least and the greatest of some values; empty before the first value.
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
    std::size_t too_far = 0;   ///< the surface in view begins behind range_max_m
    std::size_t too_near = 0;  ///< the surface in view ends before range_min_m
    /// Within range, surface lies only above or below the view.
    std::size_t elevation_too_narrow = 0;
    std::size_t elsewhere = 0;  ///< within range, surface lies only in other directions
    std::size_t nothing = 0;    ///< no surface within range in any direction
    std::size_t depths = 0;     ///< z out of range above the scene, but -z in range
    ValueRange in_view_m;       ///< start of the surface in view, for pings that are too far
    ValueRange ends_m;          ///< end of the surface in view, for pings that are too near
    /// Elevation of the surface nearest to the view, if the view is too narrow.
    ValueRange elevation_deg;
    ValueRange nearest_m;  ///< distance to the box around the scene, for pings with nothing
};

/// A sonar's view of the scene in a few of its pings along the trajectory.
struct SonarSurvey {
    std::size_t pings = 0;  ///< number of pings that were tried
    std::size_t blind = 0;  ///< pings without an occupied bin
    NoReturnReasons no_return;
    std::size_t below_surface = 0;  ///< pings with surface above and none below
    std::size_t enclosed = 0;       ///< pings inside one instance that is no basin
    std::string enclosed_by;        ///< the last of these instances
    std::size_t beyond_edge = 0;    ///< pings that look past the end of the scene
    ValueRange altitude_m;          ///< empty if there never is surface below
    ValueRange first_echo_m;        ///< one value for each ping that saw anything
    ValueRange last_echo_m;
    double occupied_share = 0.0;  ///< a share of the bins of all pings
    double white_share = 0.0;     ///< share of the occupied bins above the white of pictures
    float brightest = 0.0F;
    double signal = 0.0;               ///< mean intensity of the occupied bins without pixel noise
    double noise = 0.0;                ///< mean deviation of the noise that is added to them
    std::vector<double> visible_m2;    ///< visible surface, by Scene::instances
    std::vector<std::size_t> visible;  ///< number of pings with its surface, by Assembly::objects
};

/// Unit vectors of the sensor frame along which to look for surface: about a thousand over the
/// sphere, and a few dozen over the field of view, however narrow it is.
std::vector<Eigen::Vector3f> look_around(const View& view);

/// True if a direction lies in the azimuths of a fan, at any elevation; ahead, for a cone.
bool is_in_azimuth(const View& view, const Eigen::Vector3f& direction);

/// Traces a few dozen pings of every sonar of the mission with rays, coarsely sampled. The result
/// is indexed by Mission::sensors. The same mission gives the same numbers.
std::vector<SonarSurvey> survey(const Mission& mission, const Assembly& assembly,
                                const VisibilityEngine& rays);

}  // namespace sonarsim
