#include "sonar/setup.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

#include "calibrated/model.h"
#include "core/elementary.h"
#include "core/units.h"
#include "paper/paper_model.h"

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
    sonar.noise_growth.assign(config.range_bins, 1.0F);
    for (int i = 0; config.noise.scale_with_range && i < config.range_bins; ++i) {
        const double middle = 0.5 * (sonar.range_edges_m[i] + sonar.range_edges_m[i + 1]);
        const double r = middle / config.range_max_m;
        sonar.noise_growth[i] = static_cast<float>(r * r);
    }
    return sonar;
}

void add_azimuth(Sonar& sonar) {
    const double half = 0.5 * sonar.settings.view.azimuth_rad;
    sonar.azimuth_edges_rad = edges(-half, half, sonar.settings.view.beams);
}

namespace {

/// The middles of the beams of a fan; empty for other sonars.
std::vector<double> beam_azimuths(const Sonar& sonar, const KindOfSonar& kind) {
    std::vector<double> middles;
    for (int j = 0; kind.keys.azimuth_bins && j < sonar.settings.view.beams; ++j)
        middles.push_back(0.5 * (sonar.azimuth_edges_rad[j] + sonar.azimuth_edges_rad[j + 1]));
    return middles;
}

/// Sets the azimuth edges, too, if beams are spaced by sine.
CalibratedModel instrument_model(Sonar& sonar, const WaterConfig& water) {
    const InstrumentConfig& instrument = sonar.config.instrument;
    const View& view = sonar.settings.view;
    std::vector<double> sines;
    if (instrument.beam.aperture == Aperture::line) {
        const double half = 0.5 * view.azimuth_rad;
        sonar.equal_sine = instrument.beam.spread == BeamSpacing::equal_sine;
        for (int j = 0; j < view.beams; ++j) {
            const double share = (2.0 * j + 1.0) / view.beams - 1.0;
            sines.push_back(sonar.equal_sine ? share * sincos(half).sin : sincos(share * half).sin);
        }
        for (int j = 0; sonar.equal_sine && j <= view.beams; ++j)
            sonar.azimuth_edges_rad[j] = arcsin((2.0 * j / view.beams - 1.0) * sincos(half).sin);
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
                                           .range_scale = sonar.noise_growth,
                                           .beam_azimuths_rad = beam_azimuths(sonar, kind),
                                           .beams = sonar.settings.view.beams}));
        case ModelKind::calibrated:
            return std::make_shared<CalibratedModel>(instrument_model(sonar, water));
    }
    throw std::logic_error("an echo model is not made here");
}

nlohmann::ordered_json number_or_null(const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

}  // namespace sonarsim
