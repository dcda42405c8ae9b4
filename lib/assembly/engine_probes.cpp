#include "assembly/engine_probes.h"

#include "assembly/spread_pings.h"
#include "ping/sonar.h"
#include "sonar/engine_settings.h"

namespace sonarsim {

namespace {

constexpr std::size_t most_probes = 3;  // per sonar

/// With multipath sound goes on from the middle of each sample, and a sample of the slices may be
/// as long as a beam is high. In a cone where energies add they come out 0.5 to 2 % off by
/// slices, which their estimate does not tell, and 0.1 to 0.7 % by rays, which are as fast there.
bool needs_rays(const Sonar& sonar) {
    return sonar.config.multipath.method != MultipathMethod::none ||
           (sonar.settings.calibrated && sonar.settings.view.shape == ViewShape::cone);
}

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
                 needs_rays(sonar)});
        }
    }
    return settings;
}

}  // namespace sonarsim
