#include "simulate/sonar/setup.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/elementary.h"
#include "core/units.h"
#include "simulate/calibrated/model.h"
#include "simulate/paper/paper_model.h"

namespace sonarsim {

namespace {

float cosine_of(double angle_deg) {
    return static_cast<float>(sincos(radians(angle_deg)).cos);
}

}  // namespace

std::vector<double> edges(double low, double high, int bins) {
    std::vector<double> out(bins + 1);
    for (int i = 0; i < bins; ++i)
        out[i] = low + (high - low) * i / bins;
    out[bins] = high;
    return out;
}

void set_mount(Sonar& sonar, const KindOfSonar& kind) {
    const auto& [translation_m, rpy_deg] = sonar.config.mount;
    const Pose turned{
        rotation_from_rpy(radians(rpy_deg[0]), radians(rpy_deg[1]), radians(rpy_deg[2])),
        Eigen::Vector3d(translation_m.data())};
    const Pose down{rotation_from_rpy(0.0, 0.5 * pi, 0.0), Eigen::Vector3d::Zero()};
    sonar.T_vehicle_sensor = turned * (kind.looks_down ? down : Pose{});
}

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
    settings.multipath = {.on = multipath.method != MultipathMethod::none,
                          .cluster = {.epsilon_bins = exact ? 0 : multipath.epsilon_bins,
                                      .delta_cosine = cosine_of(multipath.delta_deg)}};
    return sonar;
}

void add_azimuth(Sonar& sonar) {
    const double half = 0.5 * sonar.settings.view.azimuth_rad;
    std::vector<double>& borders = sonar.azimuth_edges_rad;
    borders = edges(-half, half, sonar.settings.view.beams);
    sonar.beam_azimuths_rad.clear();
    for (std::size_t j = 0; j + 1 < borders.size(); ++j)
        sonar.beam_azimuths_rad.push_back(0.5 * (borders[j] + borders[j + 1]));
}

namespace {

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

}  // namespace

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

nlohmann::ordered_json number_or_null(const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

EngineSettings engine_settings(EngineKind kind, const OctreeConfig& octree) {
    return {.type = kind, .octree = {.leaf_m = octree.leaf_m}};
}

EngineSettings engine_settings(const Mission& mission) {
    return engine_settings(mission.engine, mission.octree);
}

std::optional<double> altitude_m(const VisibilityEngine& engine, const Pose& T_world_sensor) {
    const Eigen::Vector3d down =
        T_world_sensor.rotation.conjugate() * Eigen::Vector3d(0.0, 0.0, -1.0);
    const Ray ray{Eigen::Vector3f::Zero(), down.cast<float>()};
    Intersection bottom{};
    engine.intersect(T_world_sensor, {&ray, 1}, {&bottom, 1});
    if (!std::isfinite(bottom.distance_m)) return std::nullopt;
    return bottom.distance_m;
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
