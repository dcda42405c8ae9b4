#include "benchmark/bench.h"

#include <tuple>
#include <utility>

#include "core/clock.h"

namespace sonarsim {

Ping Bench::ping(const Sonar& sonar, const VisibilityEngine& engine, std::size_t p) const {
    return render_ping(sonar, scene, engine, poses[p], {seed, indices[p]});
}

Bench make_bench(const Mission& mission, const Assembly& assembly, int poses) {
    Bench bench{assembly.scene, mission.seed, {}, {}};
    for (const std::size_t pose : spread_poses(assembly.trajectory.size(), poses)) {
        bench.poses.push_back(assembly.trajectory[pose].T_world_vehicle);
        bench.indices.push_back(static_cast<std::uint32_t>(pose));
    }
    return bench;
}

void visit_pose(const Bench& bench, const Sonar& sonar, const VisibilityEngine& engine,
                std::size_t p, PoseTimes& times) {
    constexpr double slow_ms = 100.0;
    constexpr int repeats = 3;
    const auto timed = [&] {
        const double start = seconds_now();
        const Ping ping = bench.ping(sonar, engine, p);
        const double ms = 1e3 * (seconds_now() - start);
        return std::pair{ms, ping.seconds};
    };
    auto [ms, stages] = timed();
    const int count = ms > slow_ms ? 1 : repeats;
    for (int k = 0; k < count; ++k) {
        if (count > 1) std::tie(ms, stages) = timed();
        times.ping.push_back(ms);
        times.trace.push_back(1e3 * stages.trace);
        times.multipath.push_back(1e3 * stages.multipath);
        times.accumulate.push_back(1e3 * stages.accumulate);
        times.noise.push_back(1e3 * stages.noise);
    }
}

Spread over_poses(std::span<const PoseTimes> poses, std::vector<double> PoseTimes::*stage) {
    std::vector<double> medians;
    for (const PoseTimes& times : poses)
        medians.push_back(spread_of_times(times.*stage).centre);
    return spread_of_times(medians);
}

}  // namespace sonarsim
