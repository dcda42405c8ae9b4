#include "simulate/calibrated/equation/instrument_levels.h"

#include "core/decibel.h"
#include "simulate/calibrated/equation/expected_echo.h"
#include "simulate/calibrated/signal/directivity.h"
#include "simulate/calibrated/signal/range_response.h"
#include "support/calibrated.h"
#include "support/draws.h"
#include "support/patches.h"

namespace {

SonarConfig imaging() {
    SonarConfig config = calibrated(default_sonar(SonarKind::imaging), 9e5);
    config.azimuth_deg = 60.0;
    set_range(config, 1.0, 21.0, 100);
    config.azimuth_bins = 16;
    config.instrument.beam.elevation_width_deg = 12.0;
    return config;
}

InstrumentLevels levels_of(const SonarConfig& config, const WaterConfig& water = {}) {
    return calibrated_model_of(make_sonar(config, {}, water)).levels;
}

/// Random terms are speckle, then the receiver's noise.
std::vector<float> image_of(const Sonar& sonar, const Sample& sample, std::size_t random_terms) {
    Samples all;
    all.items = {sample};
    return image_of_samples(calibrated_model_of(sonar), sonar.settings.view, all,
                            {.random = random_terms});
}

}  // namespace

// -15 + 20 log f, and 50 + 7.5 sqrt(w) + 20 log f - 40 log(f + 0.4) of kHz, by hand.
TEST_CASE("levels: noise of heat and of the wind at three frequencies") {
    const auto at = [](double frequency_hz, double wind_m_s) {
        SonarConfig config = imaging();
        config.instrument.frequency_hz = frequency_hz;
        return levels_of(config, {.wind_m_s = wind_m_s});
    };
    CHECK(std::fabs(at(1e5, 0.0).thermal_noise_db - 25.0) < 1e-9);
    CHECK(std::fabs(at(4e5, 0.0).thermal_noise_db - 37.0412) < 1e-3);
    CHECK(std::fabs(at(1e6, 0.0).thermal_noise_db - 45.0) < 1e-9);
    CHECK(std::fabs(at(1e3, 0.0).wind_noise_db - 44.1549) < 1e-3);
    CHECK(std::fabs(at(1e4, 5.0).wind_noise_db - 46.0891) < 1e-3);
    CHECK(std::fabs(at(3.8e4, 4.0).wind_noise_db - 33.2221) < 1e-3);
}

// 4 pi over the integral of the pattern over all directions. With u and v the sines along the
// two sides a direction has du dv / sqrt(1 - u^2 - v^2).
TEST_CASE("levels: directivity of line, rectangle and disc is the integral of the pattern") {
    for (const double side_lobe_db : {-13.3, -26.8, -42.0}) {
        CAPTURE(side_lobe_db);
        const LineArray line = line_array(radians(4.0), side_lobe_db);
        const double line_integral = integral(
            -1.0, 1.0, 4000, [&](double u) { return std::pow(line_pattern(line, u), 2.0); });
        CHECK(std::fabs(db_of_power(line_directivity(line) * 0.5 * line_integral)) < 0.05);
        const LineArray across = line_array(radians(20.0), side_lobe_db);
        const double rectangle_integral = integral(-1.0, 1.0, 4000, [&](double u) {
            // Over the angle whose sine is v.
            return std::pow(line_pattern(line, u), 2.0) * integral(-1.0, 1.0, 400, [&](double v) {
                       const double rest = 1.0 - u * u - v * v;
                       return rest > 1e-4 ? std::pow(line_pattern(across, v), 2.0) / std::sqrt(rest)
                                          : 0.0;
                   });
        });
        CHECK(std::fabs(db_of_power(rectangle_directivity(line, across) * rectangle_integral /
                                    (4.0 * pi))) < 0.2);
    }
    for (const double width_deg : {3.0, 7.0, 15.0}) {
        CAPTURE(width_deg);
        const double scale = piston_scale(radians(width_deg));
        const double sum =
            2.0 * pi * integral(0.0, 0.5 * pi, 4000, [&](double angle) {
                return std::pow(piston_pattern(scale * std::sin(angle)), 2.0) * std::sin(angle);
            });
        CHECK(std::fabs(db_of_power(piston_directivity(radians(width_deg)) * sum / (4.0 * pi))) <
              0.2);
    }
}

TEST_CASE("levels: the pulse's band and length are those of the range response") {
    for (const double side_lobe_db : {-20.0, -30.0, -42.0}) {
        CAPTURE(side_lobe_db);
        const double bins = side_lobe_db == -30.0 ? 300.0 : 12.0;
        const PulseConfig pulse{.side_lobe_db = side_lobe_db};
        const PulseBand band = pulse_band(pulse, 0.1, 1500.0);
        const RangeTaps taps = range_taps(bins, side_lobe_db);
        double energy = 0.0;
        for (std::size_t m = 0; m < taps.taps.size(); ++m) {
            energy += 2.0 / 3.0 * taps.taps[m] * taps.taps[m];
            if (m > 0) energy += 1.0 / 3.0 * taps.taps[m] * taps.taps[m - 1];
        }
        CHECK(std::fabs(band.length_m / (0.1 / bins * energy) - 1.0) < 0.02);
        // Parseval: the energy of a pulse in time is that of its band.
        CHECK(std::fabs(band.noise_hz /
                            (band.sweep_hz * band.sweep_hz * 2.0 * band.length_m / 1500.0) -
                        1.0) < 1e-9);
    }
    const PulseConfig uniform{.side_lobe_db = -13.0};
    CHECK(std::fabs(pulse_band(uniform, 0.1, 1500.0).noise_hz - 0.8859 * 7500.0) < 10.0);
    const PulseConfig coded{.duration_s = 1e-3, .side_lobe_db = -13.0};
    CHECK(std::fabs(pulse_band(coded, 0.1, 1500.0).noise_hz - 1000.0) < 1e-6);
}

// 170.8 + 10 log 50 + DI. The transmitter sends into 60 degrees, and into sqrt(2) times 12
// degrees of elevation, of which a uniform aperture has 0.886 lambda / W.
TEST_CASE("levels: those of an instrument by hand") {
    SonarConfig config = imaging();
    config.instrument.beam.width_deg = 1.0;
    config.instrument.pulse = {.resolution_m = 0.1, .duration_s = 1e-3, .side_lobe_db = -13.3};
    const InstrumentLevels levels = levels_of(config, {.wind_m_s = 0.0});
    const double height = 0.8859 / radians(12.0 * std::sqrt(2.0));
    const double length = 0.8859 / radians(1.0);
    const double source_db =
        170.8 + db_of_power(50.0) + db_of_power(4.0 * pi * height / radians(60.0));
    CHECK(std::fabs(levels.source_level_db - source_db) < 0.05);
    const double noise_db = -15.0 + 2.0 * db_of_power(900.0) + 6.0 + db_of_power(2.0) + 30.0 -
                            db_of_power(4.0 * pi * length * height);
    CHECK(std::fabs(levels.noise_db - noise_db) < 0.05);
    CHECK(levels_of(config, {.wind_m_s = 20.0}).noise_db > levels.noise_db);
}

TEST_CASE("levels: relative ones are as far below the source as absolute ones") {
    SonarConfig config = imaging();
    const InstrumentLevels absolute = levels_of(config);
    CHECK(!absolute.relative);
    config.instrument.source_level_db = 0.0;
    const InstrumentLevels relative = levels_of(config);
    CHECK(relative.relative);
    CHECK(std::fabs(relative.noise_db - absolute.noise_db + absolute.source_level_db) < 1e-9);
    CHECK(std::fabs(relative.full_scale_db - absolute.full_scale_db + absolute.source_level_db) <
          1e-9);
    // A noise below 0 dB says that levels are relative.
    config.instrument.source_level_db.reset();
    config.instrument.receiver.noise_db = -110.0;
    CHECK(levels_of(config).source_level_db == 0.0);
}

TEST_CASE("levels: full scale holds the speckle of sand, and noise at two thirds at most") {
    SonarConfig config = imaging();
    ReceiverConfig& receiver = config.instrument.receiver;
    receiver.noise_db = 150.0;  // louder than sand
    for (const Companding companding : {Companding::gamma, Companding::log, Companding::linear}) {
        CAPTURE(static_cast<int>(companding));
        receiver.companding = companding;
        receiver.full_scale_db.reset();
        const Sonar sonar = make_sonar(config, {});
        const CalibratedModel& model = calibrated_model_of(sonar);
        const double noise_db = 150.0 + tvg_db(receiver, model.absorption_db_per_m, 21.0);
        Ping ping;
        ping.intensity = {static_cast<float>(power_of_db(noise_db - model.levels.full_scale_db))};
        CHECK(model.raw(ping)[0] == 170);
    }
    // Less noise than sand does not change it: ln 100 above its mean, or three times its amplitude.
    for (const double noise_db : {20.0, 30.0}) {
        receiver.noise_db = noise_db;
        receiver.companding = Companding::gamma;
        const InstrumentLevels shown = levels_of(config);
        CHECK(std::fabs(shown.full_scale_db - shown.sand_db - 6.632) < 1e-3);
        receiver.companding = Companding::linear;
        const InstrumentLevels recorded = levels_of(config);
        CHECK(std::fabs(recorded.full_scale_db - recorded.sand_db - 9.542) < 1e-3);
    }
}

// The sonar looks down at a floor of sand, which the axis meets at half of the range and at 20
// degrees of grazing, where the pattern is flat. Powers of speckle are exponential. The
// quantile of some 4,000 independent bins has a standard deviation of 0.15 dB.
TEST_CASE("levels: white in a fan is the 99 % quantile of the speckle of sand") {
    SonarConfig config = imaging();
    config.azimuth_bins = 128;
    config.range_bins = 400;
    config.instrument.receiver.noise_db = -300.0;
    config.instrument.speckle.texture = 0.0;  // the rule is that of exponential powers
    const double half_m = 0.5 * config.range_max_m;
    const double down_rad = radians(20.0);
    const Sonar sonar = make_sonar(config, {});
    const Scene scene = bed_scene(example_sand(), 50.0F, -half_m * std::sin(down_rad), 8);
    const auto engine = make_rays_engine(scene);
    std::vector<float> near_half;
    for (std::uint32_t number = 0; number < 4; ++number) {
        const Ping ping =
            render_ping(sonar, scene, *engine, pitched(20.0), {.seed = number + 1, .ping = 0});
        const auto middle = ping.intensity.begin() + bin_at(sonar, half_m) * ping.beams;
        near_half.insert(near_half.end(), middle - 10 * ping.beams, middle + 10 * ping.beams);
    }
    const auto at = near_half.begin() + static_cast<std::ptrdiff_t>(0.99 * near_half.size());
    std::ranges::nth_element(near_half, at);
    CHECK(std::fabs(db_of_power(*at / sonar.settings.model->info.white)) < 1.0);

    // A profiler sees its bottom from above, so no rule covers it; nor is white above full scale.
    config.elevation_deg = 4.0;
    CHECK(make_sonar(config, {}).settings.model->info.white == 0.0);
    config = imaging();
    config.instrument.source_level_db = 0.0;
    config.instrument.receiver.full_scale_db = -200.0;
    CHECK(make_sonar(config, {}).settings.model->info.white == 1.0);
}

// At 10 MHz two-way absorption is more than 150 dB from 2 to 4.5 m. Behind the gain both are equal.
TEST_CASE("levels: gain makes up for absorption far below what e^-43 leaves") {
    SonarConfig config = calibrated(default_sonar(SonarKind::imaging), 1e7);
    set_fan(config, 40.0, 10.0, 16);
    set_range(config, 1.0, 5.0, 200);
    config.instrument.speckle.mode = SpeckleMode::none;
    const Sonar sonar = make_sonar(config, {});
    const double absorption = calibrated_model_of(sonar).absorption_db_per_m;
    CHECK(2.0 * 4.5 * absorption > 190.0);  // 10 lg e^43.7
    // Nearer than 2 m the plate is cut into points of several columns of the grid.
    const double near = total(image_of(sonar, plate_ahead(2.0, 0.01), 1));
    const double far = total(image_of(sonar, plate_ahead(4.5, 0.01), 1));
    CHECK(near > 0.0);
    // The gain is that of a bin's middle. An echo at a bin's edge is off by 2 alpha dr / 2.
    CHECK(std::fabs(db_of_power(far / near)) < absorption * sonar.settings.view.bin_m());
}

TEST_CASE("levels: no legal level or range makes a value that is not finite") {
    constexpr std::array kinds{SonarKind::imaging, SonarKind::sidescan, SonarKind::echosounder,
                               SonarKind::scanning};
    Uniform draw(25);
    // Half of the numbers are at an end.
    const auto number = [&](double low, double high) {
        const double middle = 0.5 * (low + high);
        return std::clamp(middle + draw.between(low - high, high - low), low, high);
    };
    for (int trial = 0; trial < 100; ++trial) {
        SonarConfig config =
            calibrated(default_sonar(kinds[trial % 4]), std::pow(10.0, number(3, 7)));
        config.azimuth_bins = 16;
        set_range(config, 0.0, std::pow(10.0, number(-3.0, 9.0)), 32);
        InstrumentConfig& instrument = config.instrument;
        instrument.source_level_db = number(-300.0, 300.0);
        instrument.receiver.noise_db = number(-300.0, 300.0);
        instrument.receiver.full_scale_db = number(-300.0, 300.0);
        instrument.receiver.tvg_log = number(0.0, 60.0);
        instrument.receiver.tvg_from_m = number(0.0, 1.0) < 0.5 ? 0.0 : 1e9;
        instrument.speckle.mode = static_cast<SpeckleMode>(trial % 3);
        const Sample plate = plate_ahead(number(0.001, 1.0) * config.range_max_m, 0.01);
        for (const std::size_t random_terms : {1U, 2U}) {
            CAPTURE_ALL(trial, random_terms);
            CHECK(std::ranges::all_of(
                image_of(make_sonar(config, {}), plate, random_terms),
                [](float value) { return value >= 0.0F && value <= max_value; }));
        }
    }
}
