#include "calibrated/receiver_chain.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "calibrated/companding.h"
#include "calibrated/decibel.h"
#include "core/units.h"
#include "support/approx.h"
#include "support/calibrated.h"
#include "support/statistics.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

constexpr int chain_rows = 2000;

View chain_view() {
    return {.azimuth_rad = 0.3,
            .elevation_rad = 0.3,
            .range_min_m = 10.0,
            .range_max_m = 30.0,
            .range_bins = chain_rows,
            .beams = 1,
            .relative_l1 = 0.03,
            .shape = ViewShape::cone};
}

/// An echosounder that receives noise of -100 dB alone, without TVG. The pulse is so short that
/// samples are independent.
CalibratedModel noisy_sounder(const ReceiverConfig& chain) {
    InstrumentConfig config;
    config.frequency_hz = 2e5;
    config.beam.aperture = Aperture::piston;
    config.beam.width_deg = 10.0;
    config.pulse.resolution_m = 1e-4;
    config.source_level_db = 0.0;
    config.receiver = chain;
    config.receiver.noise_db = -100.0;
    config.receiver.full_scale_db = 0.0;
    config.receiver.tvg_log = 0.0;
    config.receiver.tvg_absorption = false;
    return calibrated_model(config, {}, chain_view(), {});
}

std::vector<float> noise_image(const ReceiverConfig& chain, std::uint32_t ping = 0) {
    return image_of_traced(noisy_sounder(chain), chain_view(), {}, {}, {3, 2, ping});
}

/// The powers of several pings over the mean of the noise.
std::vector<double> noise_powers(const ReceiverConfig& chain) {
    std::vector<double> out;
    for (std::uint32_t ping = 0; ping < 8; ++ping) {
        for (const float power : noise_image(chain, ping))
            out.push_back(power / 1e-10);
    }
    return out;
}

struct AmplitudeShape {
    double variation, weibull;
};

/// The coefficient of variation of the amplitudes, and the shape of the Weibull distribution whose
/// logarithm varies as much as theirs: pi / (sqrt(6) sigma of ln A).
AmplitudeShape shape_of(const std::vector<double>& powers) {
    double sum = 0.0;
    double sum2 = 0.0;
    double logs = 0.0;
    double logs2 = 0.0;
    for (const double power : powers) {
        const double log_amplitude = 0.5 * std::log(power);
        sum += std::sqrt(power);
        sum2 += power;
        logs += log_amplitude;
        logs2 += log_amplitude * log_amplitude;
    }
    const auto n = static_cast<double>(powers.size());
    const double mean = sum / n;
    const double variance_of_log = logs2 / n - logs * logs / (n * n);
    return {std::sqrt(sum2 / n - mean * mean) / mean, pi / std::sqrt(6.0 * variance_of_log)};
}

/// The same of the largest of n Rayleigh amplitudes. The largest of n exponential powers has the
/// density sum over k of C(n, k) (-1)^(k+1) k exp(-k x): means are such sums of those of
/// exponential powers of rate k. E[sqrt x] = sqrt(pi / k) / 2, E[x] = 1 / k, E[ln x] = -g - ln k
/// and E[ln^2 x] = (g + ln k)^2 + pi^2 / 6, g being Euler's constant.
AmplitudeShape shape_of_largest(int n) {
    constexpr double euler = 0.57721566490153286;
    double root = 0.0;
    double mean = 0.0;
    double log = 0.0;
    double log2 = 0.0;
    double binomial = 1.0;
    for (int k = 1; k <= n; ++k) {
        binomial *= -static_cast<double>(n - k + 1) / k;
        const double weight = -binomial;
        const double shift = euler + std::log(k);
        root += weight * 0.5 * std::sqrt(pi / k);
        mean += weight / k;
        log -= weight * shift;
        log2 += weight * (shift * shift + pi * pi / 6.0);
    }
    return {std::sqrt(mean - root * root) / root, pi / std::sqrt(6.0 * 0.25 * (log2 - log * log))};
}

}  // namespace

TEST_SUITE("calibrated") {
    // The largest of n exponential powers lies below x with the probability (1 - exp(-x))^n.
    TEST_CASE("receiver: the largest of several samples follows order statistics") {
        for (const int n : {1, 2, 3}) {
            ReceiverConfig chain;
            chain.samples = n;
            const std::vector<double> powers = noise_powers(chain);
            CHECK(ks_p_value(powers, [&](double x) { return std::pow(1.0 - std::exp(-x), n); }) >
                  1e-3);
            const AmplitudeShape found = shape_of(powers);
            const AmplitudeShape closed = shape_of_largest(n);
            CHECK(found.variation == test::approx(closed.variation).epsilon(0.025));
            CHECK(found.weibull == test::approx(closed.weibull).epsilon(0.03));
        }
        CHECK(shape_of_largest(2).variation == test::approx(0.3776).epsilon(1e-3));
        CHECK(shape_of_largest(3).variation == test::approx(0.3180).epsilon(1e-3));
    }

    // The mean of two exponential powers is gamma distributed with shape 2. The variance of ln A is
    // a quarter of the trigamma function at 2, pi^2 / 6 - 1, and the variation of A follows from
    // E[A] = Gamma(5/2) / (Gamma(2) sqrt 2).
    TEST_CASE("receiver: two looks average powers") {
        const double mean = 0.75 * std::sqrt(pi) / std::sqrt(2.0);
        const double variation = std::sqrt(1.0 - mean * mean) / mean;
        const double weibull = pi / std::sqrt(6.0 * 0.25 * (pi * pi / 6.0 - 1.0));
        ReceiverConfig looks;
        looks.looks = 2;
        ReceiverConfig samples;
        samples.samples = 2;
        samples.combine = SampleRule::rms;
        for (const ReceiverConfig& chain : {looks, samples}) {
            const std::vector<double> powers = noise_powers(chain);
            CHECK(ks_p_value(powers, [](double x) {
                      return 1.0 - (1.0 + 2.0 * x) * std::exp(-2.0 * x);
                  }) > 1e-3);
            const AmplitudeShape found = shape_of(powers);
            CHECK(found.variation == test::approx(variation).epsilon(0.025));
            CHECK(found.weibull == test::approx(weibull).epsilon(0.03));
        }
        ReceiverConfig of_amplitudes = samples;
        of_amplitudes.combine = SampleRule::mean;
        // The mean of two Rayleigh amplitudes varies by 1 / sqrt 2 of one.
        CHECK(shape_of(noise_powers(of_amplitudes)).variation ==
              test::approx(0.5227 / std::sqrt(2.0)).epsilon(0.025));
    }

    TEST_CASE("receiver: ringing lies where it should") {
        const std::vector<float> plain = noise_image({});
        ReceiverConfig ringing;
        ringing.ring_down_db = 200.0;
        ringing.ring_down_m = 1.0;
        const std::vector<float> rung = noise_image(ringing);
        for (const int row : {0, 200, 500})
            CHECK(10.0 * std::log10((rung[row] - plain[row]) / 1e-10) ==
                  test::approx(200.0 - 10.0 * (10.005 + 0.01 * row)).epsilon(1e-3));
    }

    // Gains of beams are normal in dB: neighbours differ by 2 s^2 in the mean square.
    TEST_CASE("receiver: gains of beams stay") {
        ReceiverConfig receiver;
        receiver.beam_gain_db = 0.5;
        constexpr int draws = 2000;
        double square = 0.0;
        for (std::uint64_t seed = 0; seed < draws; ++seed) {
            const double apart =
                beam_gain_db(receiver, 1, {seed, 2, 7}) - beam_gain_db(receiver, 2, {seed, 2, 7});
            square += apart * apart / draws;
        }
        // Four standard errors of a mean of squares, sqrt(2 / draws) of it, once in 16,000 runs.
        CHECK(std::fabs(square / (2.0 * 0.25) - 1.0) < 4.0 * std::sqrt(2.0 / draws));
        const ImageRows rows{.rows = 2, .beams = 8, .noise = {}};
        for (const std::uint32_t ping : {3U, 9U}) {
            std::vector<float> image(16, 1.0F);
            CHECK(has_faults(receiver));
            add_faults(receiver, rows, {1, 2, ping}, image);
            for (int k = 0; k < 16; ++k) {
                CHECK(10.0 * std::log10(image[k]) ==
                      test::approx(beam_gain_db(receiver, k % 8, {1, 2, 0})).epsilon(1e-4));
            }
        }
    }

    TEST_CASE("receiver: an offset makes zeros") {
        ReceiverConfig offset;
        offset.offset = 0.25;
        // Amplitudes of 1, 1/4, 1/16 and 1/100 of full scale have the values 1, 1/2, 1/4 and 1/10.
        const std::vector<float> powers{1.0F, 1.0F / 16, 1.0F / 256, 1e-4F};
        CHECK(companded(powers, offset) == std::vector<std::uint16_t>{191, 64, 0, 0});
        CHECK(companded(powers, {}) == std::vector<std::uint16_t>{255, 128, 64, 26});
    }
}
