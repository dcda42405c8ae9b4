#include "core/decibel.h"
#include "simulate/calibrated/signal/filtered_noise.h"
#include "simulate/calibrated/signal/range_response.h"
#include "support/calibrated.h"
#include "support/patches.h"
#include "support/statistics.h"

namespace {

/// The correlation that taps give white noise.
double tap_correlation(const std::vector<float>& taps, std::size_t lag) {
    double sum = 0.0;
    for (std::size_t k = 0; k + lag < taps.size(); ++k)
        sum += static_cast<double>(taps[k]) * taps[k + lag];
    return sum;
}

/// A sonar of 400 bins of 4 cm and a pulse of 20 cm, whose image is noise of mean 1.
Sonar noisy_sonar(SonarKind kind, double source_db, double noise_db) {
    SonarConfig config = calibrated(default_sonar(kind), 2e5);
    config.azimuth_deg = kind == SonarKind::sidescan ? 170.0 : 60.0;
    set_range(config, 1.0, 17.0, 400);
    config.azimuth_bins = 61;
    InstrumentConfig& instrument = config.instrument;
    instrument.pulse.resolution_m = 0.2;
    instrument.pulse.side_lobe_db = -20.0;
    instrument.source_level_db = source_db;
    instrument.receiver.noise_db = noise_db;
    instrument.receiver.full_scale_db = noise_db;
    instrument.receiver.tvg_log = 0.0;
    instrument.receiver.tvg_absorption = false;
    return make_sonar(config, {});
}

/// Noise of many pings, whose power should be 1. Correlations are over bins and beams, about it.
struct NoiseOfPings {
    static constexpr int lags = 6;
    std::array<std::vector<double>, lags + 1> products;  ///< [lag][ping]
    std::vector<double> power;                           ///< [ping]

    NoiseOfPings(const Sonar& sonar, std::uint32_t pings) {
        const CalibratedModel& model = calibrated_model_of(sonar);
        const View& view = sonar.settings.view;
        for (std::uint32_t ping = 0; ping < pings; ++ping) {
            const std::vector<float> image =
                image_of_samples(model, view, {}, {.random = 2}, {}, {5, 6, ping});
            const std::vector<double> powers(image.begin(), image.end());
            power.push_back(mean(powers));
            const Eigen::ArrayXd off = array_of(powers) - 1.0;
            for (int lag = 0; lag <= lags; ++lag) {
                const Eigen::Index count = off.size() - lag * view.beams;
                products[lag].push_back((off.head(count) * off.tail(count)).mean());
            }
        }
    }
};

}  // namespace

// The correlation behind a matched filter is the pulse, whose spectrum is the noise's power.
TEST_CASE("noise: its taps give it the correlation of the pulse and keep the power") {
    constexpr double unit = 1e-3;  // a width in sines that stands for that of the pulse
    CHECK(noise_taps(0.3, -30.0) == std::vector<float>{1.0F});  // shorter than a bin: white
    for (const double bins : {0.8, 1.0, 1.3, 2.0, 3.5, 5.0, 12.0}) {
        for (const double side_lobe_db : {-13.3, -20.0, -30.0, -40.0}) {
            CAPTURE_ALL(bins, side_lobe_db);
            const LineArray pulse = line_array(unit, side_lobe_db);
            const std::vector<float> taps = noise_taps(bins, side_lobe_db);
            CHECK(std::fabs(tap_correlation(taps, 0) - 1.0) < 1e-6);
            for (const int lag : {1, 2, 3, 4, 6}) {
                // The taps stop after three widths of the pulse, as those of the echoes do. A
                // band without taper has many more side lobes.
                const double off =
                    tap_correlation(taps, lag) - line_pattern(pulse, lag / bins * unit);
                CHECK(std::fabs(off) < (side_lobe_db < -25.0 ? 0.06 : 0.14));
            }
        }
    }
}

TEST_CASE("noise: that of a bin does not depend on the bins before it") {
    const std::vector<float> taps = noise_taps(5.0, -25.0);
    const NoiseChannels channels{.firsts = 4, .seconds = 3};
    FilteredNoise all(channels, taps, {11, 12}), one(channels, taps, {11, 12});
    for (int row = 0; row <= 40; row += lanes)
        all.go_to(row);
    one.go_to(40);
    for (int channel = 0; channel < channels.count(); ++channel)
        CHECK(all.of(channel).re == one.of(channel).re);
}

// The powers of Gaussian amplitudes have the square of the amplitudes' correlation (Siegert's
// relation), within 4.5 standard errors: 30 such tests fail once in 5000 runs by chance.
TEST_CASE("noise: the powers of every kind of sonar, correlated along range as the pulse is") {
    const std::vector<float> taps = noise_taps(5.0, -20.0);
    // Whatever its level is, and that of the source.
    struct Case {
        SonarKind kind;
        double source_db, noise_db;
        std::uint32_t pings;
    };
    for (const Case& c : {Case{SonarKind::imaging, 300.0, -90.0, 40},
                          Case{SonarKind::profiling, -100.0, -299.0, 40},
                          Case{SonarKind::sidescan, -300.0, 300.0, 1500},
                          Case{SonarKind::echosounder, 150.0, -299.0, 3000},
                          Case{SonarKind::scanning, 0.0, 300.0, 3000}}) {
        CAPTURE(static_cast<int>(c.kind));
        const NoiseOfPings noise(noisy_sonar(c.kind, c.source_db, c.noise_db), c.pings);
        CHECK(std::fabs(db_of_power(mean(noise.power))) < 0.05);
        for (int lag = 1; lag <= NoiseOfPings::lags; ++lag) {
            const double rho = tap_correlation(taps, lag);
            const double off = mean(noise.products[lag]) - rho * rho;
            CAPTURE(lag);
            CHECK(std::fabs(off) < 4.5 * standard_error(noise.products[lag]));
        }
    }
}

TEST_CASE("noise: that of the converter is the same at all ranges, whatever the gain") {
    for (const SonarKind kind : {SonarKind::imaging, SonarKind::sidescan}) {
        SonarConfig config = calibrated(default_sonar(kind), 2e5);
        set_range(config, 1.0, 17.0, 400);
        config.instrument.receiver.noise_db = -300.0;
        config.instrument.receiver.full_scale_db = 150.0;
        config.instrument.receiver.converter_noise_db = -20.0;
        config.instrument.receiver.tvg_log = 40.0;
        const Sonar sonar = make_sonar(config, {});
        std::array<std::vector<double>, 4> quarters;
        const std::uint32_t pings = kind == SonarKind::imaging ? 4 : 200;
        std::vector<float> before;
        for (std::uint32_t ping = 0; ping < pings; ++ping) {
            const std::vector<float> image =
                image_of_samples(calibrated_model_of(sonar), sonar.settings.view, {}, {.random = 2},
                                 {}, {5, 6, ping / 2, ping % 2});  // two groups of a shutter
            CHECK(image != std::exchange(before, image));
            for (std::size_t k = 0; k < image.size(); ++k)
                quarters[4 * k / image.size()].push_back(image[k]);
        }
        CHECK(std::ranges::max(calibrated_model_of(sonar).analog_noise_values) == 0.0F);
        // 40,000 exponential values or more, correlated over a few: 0.01 within 2.5 %.
        for (const std::vector<double>& values : quarters)
            CHECK(mean(values) == approx(0.01).epsilon(0.025));
    }
}

TEST_CASE("levels: noise_db -300 is no noise, whatever the gain") {
    for (const SonarKind kind : {SonarKind::imaging, SonarKind::sidescan}) {
        SonarConfig config = bare_sonar(default_sonar(kind), 1e6);
        config.instrument.receiver.tvg_log = 40.0;
        config.instrument.receiver.tvg_absorption = true;
        for (const double source_db : {0.0, 200.0}) {
            config.instrument.source_level_db = source_db;
            set_range(config, 200.0, 400.0, 100);
            const Sonar sonar = make_sonar(config, {});
            const auto image = image_of_samples(calibrated_model_of(sonar), sonar.settings.view, {},
                                                {.random = 2});
            CAPTURE_ALL(name_of(kind), source_db);
            CHECK(std::ranges::max(image) == 0.0F);
            CHECK(std::ranges::max(calibrated_model_of(sonar).noise_values) == 0.0F);
        }
    }
}
