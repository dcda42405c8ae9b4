#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assembly/assemble.h"
#include "benchmark/summary.h"
#include "mission/mission.h"
#include "sonar/sonar_at_pose.h"

namespace sonarsim {

// Timing of pings for a comparison of settings. A caller lets the settings take turns, so that a
// machine that slows down slows all of them.

/// The pings that every setting is measured on.
struct PingSet {
    const Mission& mission;
    const Scene& scene;
    std::vector<Pose> poses;             ///< T_world_vehicle
    std::vector<std::uint32_t> indices;  ///< index of each pose on the trajectory

    /// The sonar with its per-ping settings at pose `p`.
    SonarAtPose at_pose(const Sonar& sonar, std::size_t p) const {
        return {mission, sonar, indices[p]};
    }
    PingKey key(std::size_t p) const { return {mission.seed, indices[p]}; }
    /// The complete ping at pose `p`.
    Ping render(const Sonar& sonar, const VisibilityEngine& engine, std::size_t p) const;
};

/// A set of `poses` poses sampled along the trajectory. Mission and assembly must outlive it.
PingSet make_ping_set(const Mission& mission, const Assembly& assembly, int poses);

/// The times of one setting at one pose, over all visits.
struct PoseTimes {
    std::vector<double> ping_ms;
    std::vector<double> bare_ms;
    std::vector<double> ping_thread_ms;  ///< CPU time of the same pings
    std::vector<double> rays_thread_ms;  ///< CPU time of Embree on view_rays()
    std::vector<PingSeconds> stages;
};

/// Pings a few times and adds the times to `times`: first a ping to warm the caches after the other
/// settings, then the measured ones. A slow setting needs only one. Returns the traced surface.
TracedPing visit_pose(const PingSet& pings, const Sonar& sonar, const VisibilityEngine& engine,
                      std::size_t p, PoseTimes& times);

/// The medians at the poses, summarised over the poses; milliseconds.
Summary over_poses(std::span<const PoseTimes> poses, std::vector<double> PoseTimes::*times_ms);
Summary over_poses(std::span<const PoseTimes> poses, double PingSeconds::*stage);

}  // namespace sonarsim
