#include "job/ping_cost.h"

#include <memory>

#include "assembly/engine_at.h"
#include "assembly/engine_probes.h"
#include "assembly/sample_pings.h"
#include "core/clock.h"
#include "dataset/encode_ping.h"
#include "sonar/sonar_at_pose.h"

namespace sonarsim {

namespace {

constexpr std::size_t most_pings = 3;  // after one that is not counted

}  // namespace

std::vector<PingCost> measure_pings(const Mission& mission, const Assembly& assembly,
                                    const std::vector<Writers>& writers) {
    const std::unique_ptr<VisibilityEngine> engine =
        make_engine(assembly.scene, engine_settings(mission, assembly));
    std::vector<PingCost> costs(assembly.sonars.size());
    for (std::uint32_t i = 0; i < costs.size(); ++i) {
        const Sonar& sonar = assembly.sonars[i];
        const LabelPlan plan = plan_labels(mission, assembly, sonar);
        std::vector<std::uint32_t> poses =
            sample_pings(assembly.trajectory.size(), sonar.config.every, most_pings);
        const auto counted = static_cast<double>(poses.size());
        // The first ping of an engine takes longer.
        poses.insert(poses.begin(), poses.front());
        for (std::size_t k = 0; k < poses.size(); ++k) {
            const std::uint32_t pose = poses[k];
            const TimedPose& at = assembly.trajectory[pose];
            Stopwatch watch;
            const std::shared_ptr<const VisibilityEngine> now =
                engine_at(*engine, assembly.motions, at.t_s);
            const SonarAtPose then(mission, sonar, pose);
            const TracedPing traced = trace(*then, assembly.scene, *now, at.T_world_vehicle, pose);
            const Ping ping =
                form_image(traced, then->settings, assembly.scene, {mission.seed, pose});
            const WrittenPing written =
                encode_ping(assembly, *now, writers[i], plan, {pose, i}, *then, traced, ping);
            if (k == 0) continue;
            costs[i].seconds += watch.lap() / counted;
            for (const std::string& part : written.parts)
                costs[i].bytes += static_cast<double>(part.size()) / counted;
        }
    }
    return costs;
}

}  // namespace sonarsim
