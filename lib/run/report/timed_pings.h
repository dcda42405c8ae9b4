#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "input/mission/mission.h"
#include "simulate/assembly/assemble.h"
#include "simulate/sonar/sonar.h"

namespace sonarsim {

// Timing of pings for a comparison of settings. A caller lets the settings take turns, so that a
// machine that slows down slows all of them.

/// 0 for no values.
double median_of(std::vector<double> values);
double mean_of(const std::vector<double>& values);

/// CPU time of this thread in seconds, which stays comparable on a busy machine.
double thread_seconds_now();

/// Number of rays for the time that pings are compared with: that of Embree alone over the same
/// view of the same scene.
inline constexpr int view_rays_count = 131'072;

/// `view_rays_count` unit directions in the sensor frame, evenly spread over a view: 512 columns of
/// 256 rays, column by column.
std::vector<Eigen::Vector3f> view_rays(const View& view);

/// The pings that every setting is measured on. Mission and scene must outlive it.
struct PingSet {
    const Mission& mission;
    const Scene& scene;
    std::vector<Pose> poses;             ///< T_world_vehicle, sampled along the trajectory
    std::vector<std::uint32_t> indices;  ///< index of each pose on the trajectory

    PingSet(const Mission& mission, const Assembly& assembly, int poses);
    /// The sonar with its per-ping settings at pose `p`.
    SonarAtPose at_pose(const Sonar& sonar, std::size_t p) const {
        return {mission, sonar, indices[p]};
    }
    PingKey key(std::size_t p) const { return {mission.seed, indices[p]}; }
};

/// The times of one setting at one pose, over all visits.
struct PoseTimes {
    std::vector<double> ping_ms;
    std::vector<double> ping_thread_ms;  ///< CPU time of the same pings
    std::vector<double> multipath_ms;    ///< time of the stage of multipath
    std::vector<double> rays_thread_ms;  ///< CPU time of Embree on view_rays()
};

/// Pings a few times and adds the times to `times`: first a ping to warm the caches after the other
/// settings, then the measured ones. A slow setting needs only one. Returns the traced surface.
TracedPing visit_pose(const PingSet& pings, const Sonar& sonar, const VisibilityEngine& engine,
                      std::size_t p, PoseTimes& times);

/// The median over the poses of the medians at each of them; milliseconds.
double over_poses(std::span<const PoseTimes> poses, std::vector<double> PoseTimes::*times_ms);

}  // namespace sonarsim
