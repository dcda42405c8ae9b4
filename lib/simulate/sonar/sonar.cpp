#include "simulate/sonar/sonar.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "input/mission/ping_draws.h"
#include "simulate/sonar/setup.h"

namespace sonarsim {

Sonar make_sonar(const SonarConfig& config, const AccuracyConfig& accuracy,
                 const WaterConfig& water) {
    return make_sonar(kind_of(config.kind), config, accuracy, water);
}

Sonar make_sonar(const KindOfSonar& kind, const SonarConfig& config, const AccuracyConfig& accuracy,
                 const WaterConfig& water) {
    Sonar sonar = common_sonar(config, accuracy, kind);
    if (kind.finish) kind.finish(sonar);
    PingSettings& settings = sonar.settings;
    settings.model = make_echo_model(sonar, kind, water);
    settings.view.energies_add = settings.model->info.energies_add;
    settings.view.guards = settings.model->info.guard_beams;
    settings.map_strengths = settings.model->info.map_strengths;
    // Multipath starts at the samples, so it needs those of every beam.
    if (settings.multipath.on) settings.view.guards.joined = 1;
    settings.multipath.scattered = settings.model->info.needs_scattered_paths;
    return sonar;
}

void prepare_for(const Scene& scene, Sonar& sonar) {
    PingSettings& settings = sonar.settings;
    if (auto prepared = settings.model->prepared(scene)) settings.model = std::move(prepared);
    settings.wall_transmissions = settings.model->info.wall_transmissions;
}

void find_targets(std::span<Sonar> sonars, const Scene& scene) {
    const auto needs = [](const Sonar& sonar) { return sonar.settings.model->info.energies_add; };
    if (std::ranges::none_of(sonars, needs)) return;
    const std::shared_ptr<const TargetShapes> targets = find_target_shapes(scene);
    for (Sonar& sonar : sonars) {
        if (needs(sonar)) sonar.settings.targets = targets;
    }
}

std::optional<Sonar> drawn_sonar(const Mission& mission, const Sonar& sonar, std::uint32_t pose) {
    if (!varies_by_ping(mission, sonar.config.name)) return std::nullopt;
    Sonar drawn = sonar;
    draw_for_ping(mission, pose, drawn.config);
    const KindOfSonar& kind = kind_of(drawn.config.kind);
    set_mount(drawn, kind);
    if (drawn.config.noise == sonar.config.noise && drawn.config.streaks == sonar.config.streaks)
        return drawn;
    if (kind.finish) kind.finish(drawn);
    drawn.settings.model = make_echo_model(drawn, kind, mission.water);
    return drawn;
}

namespace {

/// The trace of one transmission of a ping.
TracedPing trace_at(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                    const Pose& T_world_sensor, std::uint32_t pose, const PingMotion& motion,
                    const Terms& terms) {
    TracedPing traced = trace_ping(sonar.settings, scene, engine, T_world_sensor, terms, motion);
    if (const auto& particles = sonar.settings.particles) {
        const double time_s = pose < particles->time_s.size() ? particles->time_s[pose] : 0.0;
        add_particles(*particles, time_s, sonar.settings.view, engine, T_world_sensor, motion,
                      traced.samples);
    }
    return traced;
}

}  // namespace

double group_period_s(const Sonar& sonar, double sound_speed_m_s) {
    const double period_s = sonar.config.shutter.period_s;
    return period_s > 0.0 ? period_s : 2.0 * sonar.settings.view.range_max_m / sound_speed_m_s;
}

std::vector<int> groups_of_beams(const ShutterConfig& shutter, int beams) {
    std::vector<int> groups(beams);
    for (int j = 0; j < beams; ++j) {
        groups[j] = shutter.order == ShutterOrder::interleaved
                        ? j % shutter.groups
                        : static_cast<int>(std::int64_t{j} * shutter.groups / beams);
    }
    return groups;
}

TracedPing trace(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                 const Pose& T_world_vehicle, std::uint32_t pose, const Terms& terms) {
    const PingMotion motion =
        sonar.motions && pose < sonar.motions->size() ? (*sonar.motions)[pose] : PingMotion{};
    const Pose T_world_sensor = sensor_pose(sonar, T_world_vehicle, pose);
    TracedPing traced = trace_at(sonar, scene, engine, T_world_sensor, pose, motion, terms);
    const ShutterConfig& shutter = sonar.config.shutter;
    if (shutter.groups == 1 || motion.is_still()) return traced;
    const double period_s = group_period_s(sonar, motion.sound_speed_m_s);
    for (int group = 1; group < shutter.groups; ++group) {
        const double later_s = group * period_s;
        traced.later_groups.push_back(trace_at(sonar, scene, engine,
                                               pose_after(motion, T_world_sensor, later_s), pose,
                                               motion_after(motion, later_s), terms));
    }
    traced.group_of_beam = groups_of_beams(shutter, sonar.settings.view.beams);
    return traced;
}

Ping render_ping(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                 const Pose& T_world_vehicle, const PingKey& key, const Terms& terms) {
    return form_image(trace(sonar, scene, engine, T_world_vehicle, key.ping, terms), sonar.settings,
                      scene, key, terms);
}

std::size_t stage_count(const Sonar& sonar) {
    return 2 + sonar.settings.model->info.random_terms.size();
}

std::vector<Ping> form_stages(const TracedPing& traced, const Sonar& sonar, const Scene& scene,
                              const PingKey& key) {
    std::vector<Ping> stages;
    for (std::size_t k = 0; k < stage_count(sonar); ++k)
        stages.push_back(form_image(traced, sonar.settings, scene, key, terms_at_stage(k)));
    return stages;
}

}  // namespace sonarsim
