#include "sonar/setup.h"

#include <algorithm>
#include <cmath>
#include <memory>

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

Pose mounted(const MountConfig& mount, const Pose& T_vehicle_default) {
    const Pose turned{rotation_from_rpy(radians(mount.rpy_deg[0]), radians(mount.rpy_deg[1]),
                                        radians(mount.rpy_deg[2])),
                      Eigen::Vector3d(mount.translation_m.data())};
    return turned * T_vehicle_default;
}

std::uint32_t stream_of(std::string_view sensor_name) {
    // FNV-1a.
    std::uint32_t hash = 2166136261U;
    for (const char c : sensor_name)
        hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
    return hash;
}

void set_mount(Sonar& sonar, const KindOfSonar& kind) {
    sonar.T_vehicle_sensor = mounted(sonar.config.mount, kind.looks_down ? looking_down() : Pose{});
}

std::shared_ptr<const EchoModel> paper_model(const Sonar& sonar, const KindOfSonar& kind) {
    const SonarConfig& config = sonar.config;
    const NoiseConfig& noise = config.noise;
    auto model = std::make_shared<PaperModel>();
    model->streaks = {.mode = config.streaks.mode,
                      .threshold = static_cast<float>(config.streaks.threshold),
                      .least_cosine = cosine_of(config.streaks.angle_deg)};
    model->range_noise = {.lambda_m = static_cast<float>(noise.range_lambda_m),
                          .scatterer_m = static_cast<float>(noise.scatterer_m),
                          .fades = kind.range_noise_fades};
    model->pixel_noise = {.gain = static_cast<float>(noise.gain > 0.0 ? noise.gain : kind.gain),
                          .add_sigma = static_cast<float>(noise.add_sigma),
                          .mult_sigma = static_cast<float>(noise.mult_sigma),
                          .range_scale = sonar.noise_growth,
                          .lobe_scale = std::vector<float>(sonar.settings.view.beams, 1.0F)};
    if (!noise.scale_with_range || !kind.keys.azimuth_bins) return model;
    const double sigma =
        radians(noise.lobe_sigma_deg > 0.0 ? noise.lobe_sigma_deg : config.azimuth_deg / 8.0);
    for (int j = 0; j < sonar.settings.view.beams; ++j) {
        const double phi = 0.5 * (sonar.azimuth_edges_rad[j] + sonar.azimuth_edges_rad[j + 1]);
        // The narrowest lobes that a mission can ask for have no width left in radians.
        const double sigmas = phi == 0.0 ? 0.0 : phi / sigma;
        model->pixel_noise.lobe_scale[j] =
            static_cast<float>(1.0 + 0.5 * exponential(-0.5 * sigmas * sigmas));
    }
    return model;
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
    settings.stream = stream_of(config.name);
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

std::shared_ptr<const EchoModel> instrument_model(Sonar& sonar, const WaterConfig& water) {
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
    return std::make_shared<const CalibratedModel>(
        calibrated_model(instrument, water, view, sines));
}

Pose looking_down() {
    return {rotation_from_rpy(0.0, 0.5 * pi, 0.0), Eigen::Vector3d::Zero()};
}

nlohmann::ordered_json number_or_null(const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

}  // namespace sonarsim
