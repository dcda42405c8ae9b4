#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "assembly/assemble.h"
#include "benchmark/spread.h"
#include "mission/mission.h"
#include "sonar/sonar_at_pose.h"

namespace sonarsim {

// Timing pings so that settings can be compared. A caller lets the settings take turns: a machine
// that slows down slows them all.

/// The pings that every setting is measured on.
struct PingSet {
    const Mission& mission;
    const Scene& scene;
    std::vector<Pose> poses;             ///< T_world_vehicle
    std::vector<std::uint32_t> indices;  ///< of the poses on the trajectory

    /// The sonar as it is at pose `p`.
    SonarAtPose at_pose(const Sonar& sonar, std::size_t p) const {
        return {mission, sonar, indices[p]};
    }
    PingKey key(std::size_t p) const { return {mission.seed, indices[p]}; }
    /// The ping at pose `p`, whole.
    Ping render(const Sonar& sonar, const VisibilityEngine& engine, std::size_t p) const;
};

/// With `poses` of them spread along the trajectory. Mission and assembly must outlive it.
PingSet make_ping_set(const Mission& mission, const Assembly& assembly, int poses);

/// The times of one setting at one pose, over all visits.
struct PoseTimes {
    std::vector<double> ping_ms;
    std::vector<double> bare_ms;
    std::vector<double> ping_thread_ms;  ///< the same pings, of the processor
    std::vector<double> rays_thread_ms;  ///< Embree, view_rays() over the view, of the processor
    std::vector<PingSeconds> stages;
};

/// Pings a few times and adds the times to `times`: first a ping to warm the caches after the other
/// settings, then the ones that count. A slow setting needs neither. Returns what was seen.
TracedPing visit_pose(const PingSet& pings, const Sonar& sonar, const VisibilityEngine& engine,
                      std::size_t p, PoseTimes& times);

/// The medians at the poses, spread over the poses; milliseconds.
Spread over_poses(std::span<const PoseTimes> poses, std::vector<double> PoseTimes::*times_ms);
Spread over_poses(std::span<const PoseTimes> poses, double PingSeconds::*stage);

}  // namespace sonarsim
