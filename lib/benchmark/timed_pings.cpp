#include "benchmark/timed_pings.h"

#include "benchmark/thread_clock.h"
#include "core/clock.h"

namespace sonarsim {

Ping PingSet::render(const Sonar& sonar, const VisibilityEngine& engine, std::size_t p) const {
    return render_ping(*at_pose(sonar, p), scene, engine, poses[p], key(p));
}

PingSet make_ping_set(const Mission& mission, const Assembly& assembly, int poses) {
    PingSet pings{mission, assembly.scene, {}, {}};
    for (const std::size_t pose : sample_poses(assembly.trajectory.size(), poses)) {
        pings.poses.push_back(assembly.trajectory[pose].T_world_vehicle);
        pings.indices.push_back(static_cast<std::uint32_t>(pose));
    }
    return pings;
}

TracedPing visit_pose(const PingSet& pings, const Sonar& sonar, const VisibilityEngine& engine,
                      std::size_t p, PoseTimes& times) {
    constexpr double slow_ms = 100.0;
    constexpr int repeats = 3;
    const SonarAtPose then = pings.at_pose(sonar, p);
    TracedPing traced;
    PingSeconds stages;
    double thread_ms = 0.0;
    const auto timed_ms = [&] {
        const double thread_start = thread_seconds_now();
        Stopwatch watch;
        traced = trace(*then, pings.scene, engine, pings.poses[p], pings.indices[p]);
        const Ping ping = form_image(traced, then->settings, pings.scene, pings.key(p));
        stages = ping.seconds;
        thread_ms = 1e3 * (thread_seconds_now() - thread_start);
        return 1e3 * watch.lap();
    };
    double ms = timed_ms();
    const int count = ms > slow_ms ? 1 : repeats;
    for (int k = 0; k < count; ++k) {
        if (count > 1) ms = timed_ms();
        times.ping_ms.push_back(ms);
        times.ping_thread_ms.push_back(thread_ms);
        times.stages.push_back(stages);
    }
    return traced;
}

Summary over_poses(std::span<const PoseTimes> poses, std::vector<double> PoseTimes::*times_ms) {
    std::vector<double> medians;
    for (const PoseTimes& times : poses)
        medians.push_back(median_summary(times.*times_ms).centre);
    return median_summary(medians);
}

Summary over_poses(std::span<const PoseTimes> poses, double PingSeconds::*stage) {
    std::vector<double> medians;
    for (const PoseTimes& times : poses) {
        std::vector<double> ms;
        for (const PingSeconds& stages : times.stages)
            ms.push_back(1e3 * stages.*stage);
        medians.push_back(median_summary(ms).centre);
    }
    return median_summary(medians);
}

}  // namespace sonarsim
