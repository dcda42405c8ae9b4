#include "assembly/engine_probes.h"

#include "assembly/spread_pings.h"
#include "ping/sonar.h"
#include "sonar/engine_settings.h"

namespace sonarsim {

namespace {

constexpr std::size_t most_probes = 3;  // per sonar

}  // namespace

EngineSettings engine_settings(const Mission& mission, const Assembly& assembly) {
    EngineSettings settings = engine_settings(mission);
    if (settings.type != EngineType::automatic) return settings;
    for (const Sonar& sonar : assembly.sonars) {
        for (const std::uint32_t pose :
             spread_pings(assembly.trajectory.size(), sonar.config.every, most_probes)) {
            settings.probes.push_back(
                {sonar.settings.view,
                 sensor_pose(sonar, assembly.trajectory[pose].T_world_vehicle, pose),
                 sonar.config.multipath.method != MultipathMethod::none});
        }
    }
    return settings;
}

}  // namespace sonarsim
