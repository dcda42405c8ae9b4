#include "assembly/engine_probes.h"

#include "assembly/spread_pings.h"
#include "ping/sonar.h"
#include "sonar/engine_settings.h"
#include "trace/visible_surface.h"

namespace sonarsim {

namespace {

constexpr std::size_t most_probes = 3;  // per sonar

// The narrow beam of a side-scan sees least of what its view is wide: with energies that add,
// images by rays come out three times as far off as the paper's means, those by slices 14 to 18 %
// at any goal (a sea floor with boulders against brute force).
constexpr double share_along_track = 1.0 / 3.0;

/// The error goal at which a sonar's surface has to be seen by rays; 0: slices will do.
double rays_goal(const Sonar& sonar) {
    const View& view = sonar.settings.view;
    if (sonar.settings.calibrated && view.shape == ViewShape::sides)
        return share_along_track * view.relative_l1;
    // With multipath sound goes on from the middle of each sample, and a sample of the slices may
    // be as long as a beam is high. In a cone where energies add the slices come out up to 1 % off,
    // which their estimate does not tell, and rays, which are as fast there, a third of that.
    const bool by_rays = sonar.config.multipath.method != MultipathMethod::none ||
                         (sonar.settings.calibrated && view.shape == ViewShape::cone);
    return by_rays ? view.relative_l1 : 0.0;
}

}  // namespace

EngineSettings engine_settings(const Mission& mission, const Assembly& assembly) {
    EngineSettings settings = engine_settings(mission);
    if (settings.type != EngineType::automatic) return settings;
    for (const Sonar& sonar : assembly.sonars) {
        for (const std::uint32_t pose :
             spread_pings(assembly.trajectory.size(), sonar.config.every, most_probes)) {
            settings.probes.push_back(
                {heard_view(sonar.settings.view, sonar.settings.beams_beside),
                 sensor_pose(sonar, assembly.trajectory[pose].T_world_vehicle, pose),
                 rays_goal(sonar)});
        }
    }
    return settings;
}

}  // namespace sonarsim
