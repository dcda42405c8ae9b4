#include "run/job/ping_cost.h"

#include <algorithm>
#include <memory>

#include "core/clock.h"
#include "output/dataset/encode_ping.h"
#include "simulate/assembly/engines.h"
#include "simulate/assembly/sample_pings.h"

namespace sonarsim {

std::vector<PingCost> measure_pings(const Mission& mission, const Assembly& assembly,
                                    const std::vector<Writers>& writers, double& set_up_s) {
    constexpr std::size_t max_pings = 2;  // after the first
    Stopwatch watch;
    const std::unique_ptr<VisibilityEngine> engine = make_engine(mission, assembly);
    set_up_s += watch.lap();
    std::vector<PingCost> costs(assembly.sonars.size());
    for (std::uint32_t i = 0; i < costs.size(); ++i) {
        const Sonar& sonar = assembly.sonars[i];
        const LabelPlan plan = plan_labels(mission, assembly, sonar);
        const std::vector<std::uint32_t> poses =
            sample_pings(assembly.trajectory.size(), sonar.config.every, max_pings);
        const auto measure = [&](std::uint32_t pose) {
            watch.lap();
            const WrittenPing written = encode_ping(
                assembly, writers[i], plan, render_at_pose(mission, assembly, *engine, {pose, i}));
            PingCost cost{.seconds = watch.lap()};
            for (const std::string& part : written.parts)
                cost.bytes += static_cast<double>(part.size());
            return cost;
        };
        const double first_s = measure(poses.front()).seconds;
        for (const std::uint32_t pose : poses) {
            const PingCost cost = measure(pose);
            costs[i].seconds += cost.seconds / static_cast<double>(poses.size());
            costs[i].bytes += cost.bytes / static_cast<double>(poses.size());
        }
        set_up_s += std::max(0.0, first_s - costs[i].seconds);
    }
    return costs;
}

}  // namespace sonarsim
