#include "assembly/engine_probes.h"

#include <algorithm>

#include "ping/sonar.h"
#include "sonar/engine_settings.h"

namespace sonarsim {

namespace {

constexpr std::size_t most_probes = 3;  // per sonar

}  // namespace

EngineSettings engine_settings(const Mission& mission, const Assembly& assembly) {
    EngineSettings settings = engine_settings(mission);
    if (settings.type != EngineType::automatic) return settings;
    const std::size_t poses = assembly.trajectory.size();
    const std::size_t count = std::min(poses, most_probes);
    for (const Sonar& sonar : assembly.sonars) {
        for (std::size_t k = 0; k < count; ++k) {
            // In the middle of equal parts of the trajectory.
            const std::size_t pose = (2 * k + 1) * poses / (2 * count);
            settings.probes.push_back({sonar.settings.view,
                                       sensor_pose(sonar, assembly.trajectory[pose].T_world_vehicle,
                                                   static_cast<std::uint32_t>(pose)),
                                       sonar.config.multipath.method != MultipathMethod::none});
        }
    }
    return settings;
}

}  // namespace sonarsim
