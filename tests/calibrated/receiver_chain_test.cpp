#include "simulate/calibrated/receiver_chain.h"

#include "simulate/calibrated/decibel.h"
#include "support/calibrated.h"
#include "support/statistics.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

constexpr int chain_rows = 2000;

View chain_view() {
    return {0.3, 0.3, 10.0, 30.0, chain_rows, 1, 0.03, ViewShape::cone};
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

/// The coefficient of variation of amplitudes.
double variation_of(const std::vector<double>& powers) {
    double root = 0.0;
    for (const double power : powers)
        root += std::sqrt(power) / static_cast<double>(powers.size());
    return std::sqrt(mean(powers) / (root * root) - 1.0);
}

}  // namespace

TEST_SUITE("calibrated") {
    // The largest of n exponential powers lies below x with the probability (1 - exp(-x))^n. The
    // mean of two is gamma distributed with shape 2. Variations of the amplitudes by their moments.
    TEST_CASE("receiver: samples and looks have the distributions of order statistics and means") {
        const auto largest_of = [](int n) {
            return [n](double x) { return std::pow(1.0 - std::exp(-x), n); };
        };
        const auto mean_of_two = [](double x) {
            return 1.0 - (1.0 + 2.0 * x) * std::exp(-2.0 * x);
        };
        const double root = 0.75 * std::sqrt(pi / 2.0);
        const double variation_of_two = std::sqrt(1.0 - root * root) / root;
        struct Case {
            int samples, looks;
            SampleRule combine;
            std::function<double(double)> law;
            double variation;
        };
        constexpr SampleRule greatest = SampleRule::maximum;
        for (const Case& c : {Case{1, 1, greatest, largest_of(1), 0.5227},
                              Case{2, 1, greatest, largest_of(2), 0.3776},
                              Case{3, 1, greatest, largest_of(3), 0.3180},
                              Case{1, 2, greatest, mean_of_two, variation_of_two},
                              Case{2, 1, SampleRule::rms, mean_of_two, variation_of_two},
                              Case{2, 1, SampleRule::mean, {}, 0.5227 / std::sqrt(2.0)}}) {
            ReceiverConfig chain;
            chain.samples = c.samples;
            chain.looks = c.looks;
            chain.combine = c.combine;
            CAPTURE(c.variation);
            const std::vector<double> powers = noise_powers(chain);
            if (c.law) CHECK(ks_p_value(powers, c.law) > 1e-3);
            CHECK(variation_of(powers) == test::approx(c.variation).epsilon(0.025));
        }
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
}
