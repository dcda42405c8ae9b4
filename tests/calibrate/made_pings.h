#pragma once

#include <cmath>
#include <vector>

#include "calibrated/model.h"
#include "core/random.h"
#include "core/units.h"
#include "recording/recording.h"
#include "sonar/sonar.h"
#include "support/calibrated.h"

namespace sonarsim::test {

/// Numbers of one draw, each in [0, 1).
class Draws {
  public:
    explicit Draws(std::uint32_t draw)
        : key_(stream_key(7, draw, 0, stream_named("made instrument"))) {}

    double between(double low, double high) {
        const PhiloxBlock block = philox({count_++, 0, 0, 0}, key_);
        return low + (high - low) * unit_double(block.x0, block.x1);
    }

  private:
    PhiloxKey key_;
    std::uint32_t count_ = 0;
};

/// An imaging sonar of 384 bins and 96 beams whose noise has a few per cent of the largest value.
inline SonarConfig plain_imaging() {
    SonarConfig config = calibrated(default_sonar(SonarKind::imaging), 1e6);
    config.azimuth_deg = 48.0;
    config.elevation_deg = 20.0;
    config.range_min_m = 1.0;
    config.range_max_m = 8.68;
    config.range_bins = 384;
    config.azimuth_bins = 96;
    InstrumentConfig& instrument = config.instrument;
    instrument.beam.spread = BeamSpacing::equal_sine;
    instrument.beam.width_deg = 1.0;
    instrument.beam.side_lobe_db = -22.0;
    instrument.pulse.resolution_m = 0.03;
    instrument.speckle.mode = SpeckleMode::ping;
    instrument.source_level_db = 0.0;
    ReceiverConfig& receiver = instrument.receiver;
    receiver.noise_db = -105.0;
    receiver.full_scale_db = -50.0;
    receiver.tvg_log = 25.0;
    return config;
}

/// A flat bottom seen at grazing incidence, as patches in the frame of the sensor. They are shorter
/// than a bin, for longer ones would be a texture.
inline Samples made_bottom(double from_m, double to_m) {
    Samples out;
    constexpr double step = 0.04;
    constexpr double length = 0.01;
    constexpr double below = 1.0;
    for (double x = from_m; x < to_m; x += length) {
        for (double y = -3.0; y < 3.0; y += step) {
            out.items.push_back({.position = Eigen::Vector3d(x, y, -below).cast<float>(),
                                 .edge_u = Eigen::Vector3f(0.5F * static_cast<float>(length), 0, 0),
                                 .edge_v = Eigen::Vector3f(0, 0.5F * static_cast<float>(step), 0),
                                 .normal = Eigen::Vector3f(0, 0, 1),
                                 .height_m = static_cast<float>(below),
                                 .area_m2 = static_cast<float>(length * step),
                                 .material = 0,
                                 .instance = 0});
        }
    }
    return out;
}

/// The bearings of the beams of a fan with even steps of the sine.
inline std::vector<double> made_bearings(const SonarConfig& config) {
    std::vector<double> out;
    const double most = std::sin(radians(0.5 * config.azimuth_deg));
    for (int j = 0; j < config.azimuth_bins; ++j)
        out.push_back(std::asin(most * (2.0 * (j + 0.5) / config.azimuth_bins - 1.0)));
    return out;
}

/// Pings of an instrument as it delivers them, by the calibrated model.
inline Recording made_recording(const SonarConfig& config, std::uint32_t pings, std::uint32_t seed,
                                const Samples& bottom) {
    const Sonar sonar = make_sonar(config, {});
    const CalibratedModel& model = calibrated_model_of(sonar);
    const View& view = sonar.settings.view;
    Recording out;
    out.name = "made";
    out.law.full_value = (1 << config.instrument.receiver.bits) - 1;
    out.range_step_m = view.bin_m();
    out.first_range_m = view.range_min_m + 0.5 * view.bin_m();
    out.bearing_rad = made_bearings(config);
    for (std::uint32_t k = 0; k < pings; ++k) {
        Ping ping;
        ping.intensity = image_of_samples(model, view, bottom, {.random = 2}, {}, {seed, 1, k});
        const std::vector<std::uint16_t> raw = model.raw(ping);
        RecordedPing made;
        made.time_s = k;
        made.ranges = view.range_bins;
        made.beams = view.beams;
        made.values.assign(raw.begin(), raw.end());
        out.pings.push_back(std::move(made));
    }
    return out;
}

/// An instrument with all that calibrate estimates drawn at random.
inline SonarConfig drawn_instrument(std::uint32_t draw) {
    Draws draws(draw);
    SonarConfig config = plain_imaging();
    InstrumentConfig& instrument = config.instrument;
    instrument.beam.width_deg = draws.between(0.7, 1.6);
    instrument.beam.side_lobe_db = draws.between(-32.0, -15.0);
    instrument.pulse.resolution_m = draws.between(0.022, 0.06);
    ReceiverConfig& receiver = instrument.receiver;
    receiver.tvg_log = draws.between(10.0, 40.0);
    receiver.gamma = draws.between(0.35, 0.7);
    receiver.dynamic_range_db = draws.between(50.0, 80.0);
    receiver.companding = draws.between(0.0, 1.0) < 0.3 ? Companding::log : Companding::gamma;
    receiver.bits = draws.between(0.0, 1.0) < 0.5 ? 8 : 12;
    // The noise at the far end is 25 to 15 dB below full scale.
    receiver.full_scale_db = *receiver.noise_db +
                             10.0 * receiver.tvg_log / 10.0 * std::log10(8.68) + 6.0 +
                             draws.between(15.0, 25.0);
    const double samples = draws.between(0.0, 4.0);
    receiver.samples = samples < 2.0 ? 1 : (samples < 3.0 ? 2 : 3);
    const double offset = draws.between(-0.04, 0.04);
    if (receiver.companding == Companding::gamma) receiver.offset = std::max(offset, 0.0);
    const double common_mode_db = draws.between(-30.0, 15.0);
    if (common_mode_db > -5.0) receiver.common_mode_db = *receiver.noise_db + common_mode_db;
    return config;
}

}  // namespace sonarsim::test
