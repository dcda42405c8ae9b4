#include "sonar/setup.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "calibrated/beamformer.h"
#include "calibrated/model.h"
#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

namespace {

float cosine_of(double angle_deg) {
    return static_cast<float>(sincos(radians(angle_deg)).cos);
}

/// Beams that reach from the view to the borders of what is heard, `heard_rad` wide. They are as
/// wide as the bins or, where that is wider, as `array_step_rad`, which the array cannot resolve.
BeamsBeside beams_beside(const View& view, double heard_rad, double array_step_rad) {
    const double side_rad = 0.5 * (heard_rad - view.azimuth_rad);
    const double bin_rad = view.azimuth_rad / view.beams;
    if (array_step_rad < 2.0 * bin_rad) {
        // Whole beams; rounding of degrees to radians must not cost one.
        return {.count = static_cast<int>(std::max(0.0, std::floor(side_rad / bin_rad + 1e-6)))};
    }
    if (side_rad <= 0.0) return {};
    const double count = std::max(1.0, std::floor(side_rad / array_step_rad));
    return {.count = static_cast<int>(count), .beam_rad = side_rad / count};
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

void set_noise(Sonar& sonar, const KindOfSonar& kind) {
    const SonarConfig& config = sonar.config;
    const NoiseConfig& noise = config.noise;
    PingSettings& settings = sonar.settings;
    settings.streaks = {.mode = config.streaks.mode,
                        .threshold = static_cast<float>(config.streaks.threshold),
                        .least_cosine = cosine_of(config.streaks.angle_deg)};
    settings.range_noise = {.lambda_m = static_cast<float>(noise.range_lambda_m),
                            .scatterer_m = static_cast<float>(noise.scatterer_m),
                            .fades = kind.range_noise_fades};
    settings.pixel_noise = {.gain = static_cast<float>(noise.gain > 0.0 ? noise.gain : kind.gain),
                            .add_sigma = static_cast<float>(noise.add_sigma),
                            .mult_sigma = static_cast<float>(noise.mult_sigma),
                            .range_scale = std::vector<float>(config.range_bins, 1.0F),
                            .lobe_scale = std::vector<float>(settings.view.beams, 1.0F)};
    if (!noise.scale_with_range) return;
    for (int i = 0; i < config.range_bins; ++i) {
        const double middle = 0.5 * (sonar.range_edges_m[i] + sonar.range_edges_m[i + 1]);
        const double r = middle / config.range_max_m;
        settings.pixel_noise.range_scale[i] = static_cast<float>(r * r);
    }
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
    set_noise(sonar, kind);
    return sonar;
}

void add_azimuth(Sonar& sonar) {
    const SonarConfig& config = sonar.config;
    const double half = 0.5 * sonar.settings.view.azimuth_rad;
    sonar.azimuth_edges_rad = edges(-half, half, sonar.settings.view.beams);
    if (!config.noise.scale_with_range) return;
    const double sigma = radians(config.noise.lobe_sigma_deg > 0.0 ? config.noise.lobe_sigma_deg
                                                                   : config.azimuth_deg / 8.0);
    for (int j = 0; j < sonar.settings.view.beams; ++j) {
        const double phi = 0.5 * (sonar.azimuth_edges_rad[j] + sonar.azimuth_edges_rad[j + 1]);
        // The narrowest lobes that a mission can ask for have no width left in radians.
        const double sigmas = phi == 0.0 ? 0.0 : phi / sigma;
        sonar.settings.pixel_noise.lobe_scale[j] =
            static_cast<float>(1.0 + 0.5 * exponential(-0.5 * sigmas * sigmas));
    }
}

void add_instrument(Sonar& sonar, const WaterConfig& water) {
    const InstrumentConfig& instrument = sonar.config.instrument;
    const View& view = sonar.settings.view;
    std::vector<double> sines;
    if (instrument.beam.aperture == Aperture::line) {
        const double half = 0.5 * view.azimuth_rad;
        const bool even_sines = instrument.beam.spread == BeamSpacing::equal_sine;
        for (int j = 0; j < view.beams; ++j) {
            const double share = (2.0 * j + 1.0) / view.beams - 1.0;
            sines.push_back(even_sines ? share * sincos(half).sin : sincos(share * half).sin);
        }
        for (int j = 0; even_sines && j <= view.beams; ++j)
            sonar.azimuth_edges_rad[j] = arcsin((2.0 * j / view.beams - 1.0) * sincos(half).sin);
        const double array_step = arcsin(
            sine_grid(line_array(radians(instrument.beam.width_deg), instrument.beam.side_lobe_db),
                      {0.0})
                .step);
        sonar.settings.beside =
            beams_beside(view, radians(instrument.beam.view_azimuth_deg), array_step);
    }
    sonar.settings.calibrated =
        std::make_shared<const CalibratedModel>(calibrated_model(instrument, water, view, sines));
}

Pose looking_down() {
    return {rotation_from_rpy(0.0, 0.5 * pi, 0.0), Eigen::Vector3d::Zero()};
}

nlohmann::ordered_json number_or_null(const std::optional<double>& value) {
    return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

}  // namespace sonarsim
