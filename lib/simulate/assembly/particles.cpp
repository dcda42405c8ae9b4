#include "simulate/assembly/particles.h"

#include <memory>

#include "core/decibel.h"
#include "core/elementary.h"
#include "core/error.h"
#include "core/random.h"
#include "core/text.h"
#include "input/scene/materials.h"
#include "simulate/calibrated/equation/water.h"
#include "simulate/trace/particles.h"

namespace sonarsim {

namespace {

/// Draws for a target: the second word of the counter; the first is the target.
enum class ParticleDraw : std::uint32_t { size, x, y, z, count };

/// The draws of one group.
using GroupDraws = NamedDraws<ParticleDraw>;

std::uint32_t count_of(const ParticlesConfig& config, const GroupDraws& draws) {
    const double choices = config.count[1] - config.count[0] + 1.0;
    const double more = std::floor(choices * draws.unit(ParticleDraw::count));
    return static_cast<std::uint32_t>(config.count[0] + more);
}

/// A place in the region, evenly distributed, from its middle in halves of its size. In a ball the
/// cosine of the angle to z and the cube of the radius are even.
Eigen::Vector3d place_in(ParticleRegion region, const GroupDraws& draws, std::uint32_t target) {
    const double x = draws.unit(ParticleDraw::x, target);
    const double y = draws.unit(ParticleDraw::y, target);
    const double z = draws.unit(ParticleDraw::z, target);
    if (region == ParticleRegion::box) return {2.0 * x - 1.0, 2.0 * y - 1.0, 2.0 * z - 1.0};
    const double up = 2.0 * z - 1.0;
    const double around = std::sqrt(1.0 - up * up);
    const auto [sine, cosine] = sincos(2.0 * pi * y);
    const double radius = x > 0.0 ? power(x, 1.0 / 3.0) : 0.0;
    return radius * Eigen::Vector3d(around * cosine, around * sine, up);
}

/// A target of a group, before a frequency is known.
struct DrawnParticle {
    Particle particle;
    double size;  ///< length, radius or target strength, by the kind
};

std::vector<DrawnParticle> draw_group(const ParticlesConfig& config, const GroupDraws& draws) {
    const Eigen::Vector3d middle(config.position_m.data());
    const Eigen::Vector3d half = 0.5 * Eigen::Vector3d(config.size_m.data());
    const Eigen::Vector3d velocity =
        Eigen::Vector3d(config.drift_m_s.data()) + config.rise_m_s * Eigen::Vector3d::UnitZ();
    const std::array<double, 2>& sizes = config.kind() == ParticleKind::fish ? config.length_m
                                         : config.kind() == ParticleKind::bubbles
                                             ? config.radius_m
                                             : *config.target_strength_db;
    std::vector<DrawnParticle> out(count_of(config, draws));
    for (std::uint32_t k = 0; k < out.size(); ++k) {
        Particle& particle = out[k].particle;
        const Eigen::Vector3d at = place_in(config.region, draws, k);
        particle.start_m = middle + half.cwiseProduct(at);
        particle.velocity_m_s = velocity;
        if (config.rise_m_s > 0.0) {
            const double share = config.region == ParticleRegion::box
                                     ? 1.0
                                     : std::sqrt(std::max(1.0 - at.head<2>().squaredNorm(), 0.0));
            particle.bottom_m = middle.z() - share * half.z();
            particle.top_m = middle.z() + share * half.z();
        }
        out[k].size = draws.in(sizes, ParticleDraw::size, k);
    }
    return out;
}

/// The number of a material that stands for the targets of a kind in labels; it has no surface.
std::uint32_t material_of(ParticleKind kind, Scene& scene) {
    constexpr std::array names{"points", "fish", "bubbles"};
    return material_number(scene, names[static_cast<std::size_t>(kind)]);
}

std::uint32_t add_instance(const ParticlesConfig& config, const std::string& name, Scene& scene) {
    scene.instance_classes.resize(scene.instances.size());
    scene.instances.push_back(name);
    scene.instance_classes.push_back(config.class_or_name());
    return static_cast<std::uint32_t>(scene.instances.size() - 1);
}

/// Refuses a name that the scene already has: labels could not distinguish the two.
void require_new_name(const ParticlesConfig& config, const Scene& scene) {
    const auto is_it = [&](const std::string& name) {
        return name == config.name || name.starts_with(config.name + "_");
    };
    if (std::ranges::none_of(scene.instances, is_it)) return;
    throw InputError(config.place, "'" + printable(config.name) +
                                       "': the scene has an object of that name, or one "
                                       "that begins with it and _; choose another name");
}

/// Gives the targets of a group their material and instances, and adds these to the scene.
void add_group(const ParticlesConfig& config, std::vector<DrawnParticle>& targets, Scene& scene) {
    require_new_name(config, scene);
    const bool is_single = static_cast<double>(targets.size()) < max_single_particles;
    const std::uint32_t material = material_of(config.kind(), scene);
    std::uint32_t instance = 0;
    if (!is_single) instance = add_instance(config, config.name, scene);
    for (std::size_t k = 0; k < targets.size(); ++k) {
        if (is_single)
            instance = add_instance(config, config.name + "_" + std::to_string(k + 1), scene);
        targets[k].particle.material = material;
        targets[k].particle.instance = instance;
    }
}

double section_of(const ParticlesConfig& config, const DrawnParticle& drawn, const Mission& mission,
                  double frequency_hz) {
    if (config.kind() == ParticleKind::points) return power_of_db(drawn.size);
    if (config.kind() == ParticleKind::fish) return fish_section_m2(drawn.size, frequency_hz);
    const auto& surface = mission.scene.water_surface;
    const double depth_m = (surface ? surface->height_m : 0.0) - drawn.particle.start_m.z();
    return bubble_section_m2(drawn.size, depth_m, mission.water.density_kg_m3,
                             mission.water.sound_speed_m_s, frequency_hz);
}

}  // namespace

void add_particles(const Mission& mission, const Trajectory& trajectory, Scene& scene,
                   std::span<Sonar> sonars) {
    if (mission.scene.particles.empty()) return;
    std::vector<double> time_s;
    for (const TimedPose& pose : trajectory)
        time_s.push_back(pose.t_s - trajectory.front().t_s);
    std::vector<std::vector<Particle>> of_sonar(sonars.size());
    std::uint32_t number = 0;
    for (const ParticlesConfig& config : mission.scene.particles) {
        const PhiloxKey key = stream_key(mission.seed, number++, 0, stream_named("particles"));
        std::vector<DrawnParticle> targets = draw_group(config, {key});
        add_group(config, targets, scene);
        for (std::size_t s = 0; s < sonars.size(); ++s) {
            const double frequency_hz = sonars[s].config.instrument.frequency_hz;
            for (const DrawnParticle& drawn : targets) {
                Particle& particle = of_sonar[s].emplace_back(drawn.particle);
                particle.section_m2 =
                    static_cast<float>(section_of(config, drawn, mission, frequency_hz));
            }
        }
    }
    for (std::size_t s = 0; s < sonars.size(); ++s)
        sonars[s].settings.sources.push_back(
            std::make_shared<const Particles>(std::move(of_sonar[s]), time_s));
}

}  // namespace sonarsim
