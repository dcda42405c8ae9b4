#include "simulate/sonar/sonar.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "core/elementary.h"
#include "core/units.h"
#include "input/mission/ping_draws.h"
#include "simulate/calibrated/model.h"
#include "simulate/paper/paper_model.h"

namespace sonarsim {

namespace {

/// Sets T_vehicle_sensor: the default mount of the kind, turned by the mission's roll, pitch and
/// yaw and moved by its translation. Sonars that look down have x along the vehicle's -z and z
/// along its x, so that azimuth runs from starboard (-) to port (+).
void set_mount(Sonar& sonar, const KindOfSonar& kind) {
    const auto& [translation_m, rpy_deg] = sonar.config.mount;
    const Pose turned{rotation_from_degrees(rpy_deg), Eigen::Vector3d(translation_m.data())};
    const Pose down{rotation_from_rpy(0.0, 0.5 * pi, 0.0), Eigen::Vector3d::Zero()};
    sonar.T_vehicle_sensor = turned * (kind.looks_down ? down : Pose{});
}

/// A sonar with the mount, the view and the range edges of its configuration and its kind.
Sonar common_sonar(const SonarConfig& config, const AccuracyConfig& accuracy,
                   const KindOfSonar& kind) {
    const bool cone = kind.shape == ViewShape::cone;
    const int sides_or_one = kind.shape == ViewShape::port_starboard ? 2 : 1;
    const int beams = kind.keys.azimuth_bins ? config.azimuth_bins : sides_or_one;
    Sonar sonar;
    sonar.config = config;
    set_mount(sonar, kind);
    sonar.range_edges_m = edges(config.range_min_m, config.range_max_m, config.range_bins);
    PingSettings& settings = sonar.settings;
    settings.stream = number_of_name(config.name);
    settings.view = {.azimuth_rad = radians(cone ? config.opening_deg : config.azimuth_deg),
                     .elevation_rad = radians(cone ? config.opening_deg : config.elevation_deg),
                     .range_min_m = config.range_min_m,
                     .range_max_m = config.range_max_m,
                     .range_bins = config.range_bins,
                     .beams = beams,
                     .relative_l1 = accuracy.relative_l1,
                     .shape = kind.shape};
    const MultipathConfig& multipath = config.multipath;
    const bool exact = multipath.method == MultipathMethod::exact;
    settings.multipath = {
        .on = multipath.method != MultipathMethod::none,
        .cluster = {.epsilon_bins = exact ? 0 : multipath.epsilon_bins,
                    .delta_cosine = static_cast<float>(sincos(radians(multipath.delta_deg)).cos)}};
    return sonar;
}

/// (r / range_max)^2 of Eq. 10 by range bin, or 1.
std::vector<float> growth_with_range(const Sonar& sonar) {
    const SonarConfig& config = sonar.config;
    std::vector<float> growth(config.range_bins, 1.0F);
    for (int i = 0; config.noise.scale_with_range && i < config.range_bins; ++i) {
        const double r = sonar.middle_m(i) / config.range_max_m;
        growth[i] = static_cast<float>(r * r);
    }
    return growth;
}

BeamSines beam_sines(const BeamConfig& beam, const View& view) {
    const double half = 0.5 * view.azimuth_rad;
    const bool equal_sine = beam.spread == BeamSpacing::equal_sine;
    const auto sine_at = [&](double share) {
        return equal_sine ? share * sincos(half).sin : sincos(share * half).sin;
    };
    BeamSines sines;
    for (int j = 0; j < view.beams; ++j)
        sines.middles.push_back(sine_at((2.0 * j + 1.0) / view.beams - 1.0));
    for (int j = 0; j <= view.beams; ++j)
        sines.edges.push_back(sine_at(2.0 * j / view.beams - 1.0));
    return sines;
}

/// Also sets the azimuths of beams that are not equal in azimuth.
CalibratedModel instrument_model(Sonar& sonar, const WaterConfig& water) {
    const InstrumentConfig& instrument = sonar.config.instrument;
    const BeamConfig& beam = instrument.beam;
    const View& view = sonar.settings.view;
    if (beam.aperture != Aperture::line) return calibrated_model(instrument, water, view, {});
    const BeamSines sines = beam_sines(beam, view);
    sonar.equal_azimuth = beam.spread == BeamSpacing::equal_angle;
    if (!sonar.equal_azimuth) {
        std::ranges::transform(sines.middles, sonar.beam_azimuths_rad.begin(), arcsin);
        std::transform(sines.edges.begin() + 1, sines.edges.end() - 1,
                       sonar.azimuth_edges_rad.begin() + 1, arcsin);
    }
    return calibrated_model(instrument, water, view, sines);
}

/// The echo model of the sonar. Sets the azimuths of beams that are not equal in azimuth.
std::shared_ptr<const EchoModel> make_echo_model(Sonar& sonar, const KindOfSonar& kind,
                                                 const WaterConfig& water) {
    switch (sonar.config.model) {
        case ModelKind::paper:
            return std::make_shared<PaperModel>(
                paper_model(sonar.config, {.gain = kind.gain,
                                           .range_noise_fades = kind.range_noise_fades,
                                           .range_scale = growth_with_range(sonar),
                                           .beam_azimuths_rad = sonar.beam_azimuths_rad,
                                           .beams = sonar.settings.view.beams}));
        case ModelKind::calibrated:
            return std::make_shared<CalibratedModel>(instrument_model(sonar, water));
    }
    throw std::logic_error("an echo model is not made here");
}

TracedPing trace_at(const Sonar& sonar, const Scene& scene, const VisibilityEngine& engine,
                    const Pose& T_world_sensor, std::uint32_t pose, const PingMotion& motion,
                    const Terms& terms) {
    TracedPing traced = trace_ping(sonar.settings, scene, engine, T_world_sensor, terms, motion);
    const TraceContext context{sonar.settings.view, scene, engine, T_world_sensor};
    for (const auto& source : sonar.settings.sources)
        source->add(context, motion, pose, traced.samples);
    return traced;
}

/// The group in which each beam of a fan transmits.
std::vector<int> groups_of_beams(const ShutterConfig& shutter, int beams) {
    std::vector<int> groups(beams);
    for (int j = 0; j < beams; ++j) {
        groups[j] = shutter.order == ShutterOrder::interleaved
                        ? j % shutter.groups
                        : static_cast<int>(std::int64_t{j} * shutter.groups / beams);
    }
    return groups;
}

}  // namespace

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

SonarAtPose::SonarAtPose(const Mission& mission, const Sonar& sonar, std::uint32_t pose)
    : own_(sonar) {
    if (!varies_by_ping(mission, sonar.config.name)) return;
    Sonar& drawn = drawn_.emplace(sonar);
    draw_for_ping(mission, pose, drawn.config);
    const KindOfSonar& kind = kind_of(drawn.config.kind);
    set_mount(drawn, kind);
    if (drawn.config.noise == sonar.config.noise && drawn.config.streaks == sonar.config.streaks)
        return;
    if (kind.finish) kind.finish(drawn);
    drawn.settings.model = make_echo_model(drawn, kind, mission.water);
}

double group_period_s(const Sonar& sonar, double sound_speed_m_s) {
    const double period_s = sonar.config.shutter.period_s;
    return period_s > 0.0 ? period_s : 2.0 * sonar.settings.view.range_max_m / sound_speed_m_s;
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
    for (std::size_t k = 0; k < stage_count(sonar); ++k) {
        const Terms terms{.multipath = k > 0, .random = k > 0 ? k - 1 : 0};
        stages.push_back(form_image(traced, sonar.settings, scene, key, terms));
    }
    return stages;
}

EngineSettings engine_settings(EngineKind kind, double octree_leaf_m) {
    return {.type = kind, .octree_leaf_m = octree_leaf_m};
}

EngineSettings engine_settings(const Mission& mission) {
    return engine_settings(mission.engine, mission.octree_leaf_m);
}

std::optional<double> altitude_m(const VisibilityEngine& engine, const Pose& T_world_sensor) {
    const Eigen::Vector3d down =
        T_world_sensor.rotation.conjugate() * Eigen::Vector3d(0.0, 0.0, -1.0);
    const Ray ray{Eigen::Vector3f::Zero(), down.cast<float>()};
    Intersection bottom{};
    engine.intersect(T_world_sensor, {&ray, 1}, {&bottom, 1});
    if (!std::isfinite(bottom.distance_m)) return std::nullopt;
    return bottom.distance_m + 0.0F;  // -0 becomes 0
}

nlohmann::ordered_json measured(const PingView& view, const VisibilityEngine& engine) {
    const KindOfSonar& kind = kind_of(view.sonar.config.kind);
    if (!kind.measure) return {};
    const Pose T_world_sensor = sensor_pose(view.sonar, view.T_world_vehicle, view.pose);
    nlohmann::ordered_json json = {
        {"altitude_m", number_or_null(altitude_m(engine, T_world_sensor))}};
    kind.measure(view, json);
    return json;
}

}  // namespace sonarsim
