#include <algorithm>
#include <cstddef>
#include <string>

#include "assembly/engine_at.h"
#include "checks/find_warnings.h"
#include "core/text.h"
#include "sonar/sonar_at_pose.h"
#include "trace/particles.h"

namespace sonarsim {

namespace {

constexpr std::size_t most_particle_pings = 200;  // the most pings of each sonar to test

/// Marks the instances of the targets that a sonar sees at a pose.
void mark_seen(const Mission& mission, const Assembly& assembly, const Sonar& sonar,
               std::size_t pose, const VisibilityEngine& rays, std::vector<bool>& is_seen) {
    const TimedPose& at = assembly.trajectory[pose];
    const Particles& particles = *sonar.settings.particles;
    const View& view = sonar.settings.view;
    const auto index = static_cast<std::uint32_t>(pose);
    const SeenParticles seen = seen_particles(
        particles, particles.time_s[pose], view, sonar.settings.guard_beams,
        *engine_at(rays, assembly.motions, at.t_s),
        sensor_pose(*SonarAtPose(mission, sonar, index), at.T_world_vehicle, index), {});
    for (const Sample& sample : seen.samples) {
        if (sample.height_m >= static_cast<float>(view.range_min_m))
            is_seen[sample.instance] = true;
    }
}

/// The groups of which no target is seen, in quotes.
std::string unseen_groups(const Mission& mission, const Scene& scene,
                          const std::vector<bool>& is_seen) {
    std::string names;
    for (const ParticlesConfig& group : mission.scene.particles) {
        bool any = false;
        for (std::size_t k = 0; k < scene.instances.size(); ++k) {
            const std::string& name = scene.instances[k];
            any = any || (is_seen[k] && (name == group.name || name.starts_with(group.name + "_")));
        }
        if (!any) names += (names.empty() ? "'" : ", '") + printable(group.name) + "'";
    }
    return names;
}

}  // namespace

std::vector<Warning> unseen_particles(const Mission& mission, const Assembly& assembly,
                                      const VisibilityEngine& rays) {
    if (mission.scene.particles.empty()) return {};
    std::vector<bool> is_seen(assembly.scene.instances.size());
    std::string names = unseen_groups(mission, assembly.scene, is_seen);
    for (const Sonar& sonar : assembly.sonars) {
        if (!sonar.settings.particles) continue;
        const auto every = static_cast<std::size_t>(sonar.config.every);
        const std::size_t pings = (assembly.trajectory.size() + every - 1) / every;
        const std::size_t step = every * ((pings + most_particle_pings - 1) / most_particle_pings);
        for (std::size_t pose = 0; pose < assembly.trajectory.size() && !names.empty();
             pose += step) {
            mark_seen(mission, assembly, sonar, pose, rays, is_seen);
            names = unseen_groups(mission, assembly.scene, is_seen);
        }
    }
    if (names.empty()) return {};
    return {make_warning(WarningCode::unseen_particles, "scene.particles", names)};
}

}  // namespace sonarsim
