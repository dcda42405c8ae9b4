#include "simulate/calibrated/receiver/receiver_chain.h"

#include "core/decibel.h"
#include "support/calibrated.h"
#include "support/statistics.h"

namespace {

/// The image of an echosounder that receives independent noise of -100 dB alone, without TVG.
std::vector<float> noise_image(const ReceiverConfig& chain, std::uint32_t ping = 0) {
    const View view{0.3, 0.3, 10.0, 30.0, 2000, 1, 0.03, ViewShape::cone};
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
    return image_of_traced(calibrated_model(config, {}, view, {}), view, {}, {}, {3, 2, ping});
}

/// The faults of a window of 26.68 ms in bins over noise of 1e-6, with pulses of two bins.
std::vector<float> faults_of(const ReceiverConfig& receiver, int bins, std::uint32_t ping) {
    const std::vector<float> noise(bins, 1e-6F);
    std::vector<float> image(bins, 0.0F);
    ImageRows rows{.bin_s = 0.02668 / bins, .rows = bins, .beams = 1, .noise = noise};
    rows.pulse_s = 2.0 * rows.bin_s;
    add_faults(receiver, rows, {1, 2, ping}, image);
    return image;
}

constexpr double bin_m = 0.05;
constexpr double water_speed_m_s = 1500.0;

Reverberation tail_of(double share_db, double time_s) {
    ReceiverConfig receiver;
    receiver.reverberation_db = share_db;
    receiver.reverberation_s = time_s;
    return {receiver, bin_m, water_speed_m_s};
}

ReceiverConfig sampling(double samples, SampleRule rule, double expansion = 1.0) {
    ReceiverConfig out;
    out.samples = samples;
    out.combine = rule;
    out.expansion = expansion;
    return out;
}

/// The delivered power of one sample of the power x, both in units of the mean 3.
double delivered(const ReceiverConfig& config, double x) {
    constexpr float mean = 3.0F;
    std::vector<float> power{static_cast<float>(x) * mean};
    DetectedSample(config).apply(std::vector<float>{mean}, power);
    return static_cast<double>(power[0] / mean);
}

}  // namespace

TEST_CASE("receiver: ringing lies where it should") {
    const std::vector<float> plain = noise_image({});
    ReceiverConfig ringing;
    ringing.ring_down_db = 200.0;
    ringing.ring_down_m = 1.0;
    const std::vector<float> rung = noise_image(ringing);
    for (const int row : {0, 200, 500})
        CHECK(10.0 * std::log10((rung[row] - plain[row]) / 1e-10) ==
              approx(200.0 - 10.0 * (10.005 + 0.01 * row)).epsilon(1e-3));
}

// A Poisson process of 40 pulses in 2,000 pings of 20 m (26.7 ms) has 2,135; 4.5 standard
// deviations are 208. Their mean power is 100 times the noise over two bins.
TEST_CASE("receiver: foreign pulses come at their rate and with their level") {
    ReceiverConfig receiver;
    receiver.interference_per_s = 40.0;
    receiver.interference_db = 20.0;
    double energy = 0.0;
    int pulses = 0;
    for (std::uint32_t ping = 0; ping < 2000; ++ping) {
        const std::vector<float> image = faults_of(receiver, 400, ping);
        for (int row = 0; row < 400; ++row) {
            energy += image[row] / 1e-6;
            pulses += image[row] > 0.0F && (row == 0 || image[row - 1] == 0.0F) ? 1 : 0;
        }
    }
    CHECK(std::abs(pulses - 2135) < 208 + 20);  // one pulse in a hundred meets another
    // Products of two exponential draws: the standard error is sqrt(3 / (2 * 2135)).
    CHECK(std::fabs(energy / (2135.0 * 2.0 * 100.0) - 1.0) < 4.5 * 0.035);
}

// Pulses of 1 s at 0.2 per second cover a window of 26.7 ms whole or in part with the probability
// 1 - exp(-0.2 (1 + 0.0267)) = 0.186: 371 of 2,000 pings; 4.5 standard deviations are 78. Nine in
// ten of these, (1 - 0.0267) / (1 + 0.0267), are covered whole.
TEST_CASE("receiver: long foreign pulses cover whole pings") {
    ReceiverConfig receiver;
    receiver.interference_per_s = 0.2;
    receiver.interference_s = 1.0;
    int pings = 0;
    int whole = 0;
    for (std::uint32_t ping = 0; ping < 2000; ++ping) {
        const std::vector<float> image = faults_of(receiver, 50, ping);
        const auto covered = std::ranges::count_if(image, [](float value) { return value > 0.0F; });
        pings += covered > 0 ? 1 : 0;
        whole += covered == 50 ? 1 : 0;
    }
    CHECK(std::abs(pings - 371) < 78);
    CHECK(whole > 0.9 * pings);
}

// A share of 0.3 of 4,000 pings is 1,200; 4.5 standard deviations are 130. The mean loss is 6 dB.
TEST_CASE("receiver: a share of the pings is weaker") {
    ReceiverConfig receiver;
    receiver.loss_share = 0.3;
    receiver.loss_db = 6.0;
    const ImageRows rows{.rows = 2, .beams = 1, .noise = {}};
    int weak = 0;
    double loss_db = 0.0;
    for (std::uint32_t ping = 0; ping < 4000; ++ping) {
        std::vector<float> image{1.0F, 0.5F};
        add_faults(receiver, rows, {1, 2, ping}, image);
        CHECK(image[1] == 0.5F * image[0]);
        weak += image[0] < 1.0F ? 1 : 0;
        loss_db -= 10.0 * std::log10(static_cast<double>(image[0]));
    }
    CHECK(std::abs(weak - 1200) < 130);
    CHECK(std::fabs(loss_db / weak - 6.0) < 4.5 * 6.0 / std::sqrt(1200.0));
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
        add_faults(receiver, rows, {1, 2, ping}, image);
        for (int k = 0; k < 16; ++k) {
            CHECK(10.0 * std::log10(image[k]) ==
                  approx(beam_gain_db(receiver, k % 8, {1, 2, 0})).epsilon(1e-4));
        }
    }
    receiver.channel_beams = 3;
    CHECK(beam_gain_db(receiver, 3, {1, 2, 0}) == beam_gain_db(receiver, 5, {1, 2, 0}));
    CHECK(beam_gain_db(receiver, 2, {1, 2, 0}) != beam_gain_db(receiver, 3, {1, 2, 0}));
}

TEST_CASE("receiver: beams that are received together leak into each other") {
    ReceiverConfig receiver;
    receiver.channel_beams = 3;
    std::vector<float> image(16, 1.0F);  // 2 bins
    image[8 + 4] = 1001.0F;
    add_mean_leaks(receiver, 8, image);
    const std::array more{0.0, 1.0, 0.0, 0.0, 1000.0, 0.0, 0.0, 1.0};
    for (int k = 0; k < 8; ++k)
        CHECK(image[8 + k] - image[k] == approx(more[k]).epsilon(1e-3));
    std::vector<float> noise(64 * 1600);  // exponential powers stay so, of the mean 1.0203
    for (std::uint32_t k = 0; k < noise.size(); ++k)
        noise[k] = -natural_log(unit_float(philox({k, 0, 0, 0}, {5, 6}).x0));
    add_leaks(receiver, 64, {1, 2}, noise);
    const auto weak = std::ranges::count_if(noise, [](float power) { return power < 0.01F; });
    CHECK(std::fabs(static_cast<double>(weak) / noise.size() - 0.00975) < 4.5 * 0.00031);
}

TEST_CASE("receiver: the lobe of an element weakens echoes at the edges of a fan, not its noise") {
    SonarConfig config = calibrated(small_imaging(), 1e6);
    config.instrument.speckle.mode = SpeckleMode::none;
    const auto image = [&](double loss_db, const Scene& scene) {
        config.instrument.receiver.edge_loss_db = loss_db;
        return render_ping(make_sonar(config, {0.03}), scene,
                           *engine_of(scene, EngineKind::automatic), pitched(30.0, {0, 0, 3}),
                           {.seed = 1, .ping = 0})
            .intensity;
    };
    CHECK(image(6.0, empty_scene()) == image(0.0, empty_scene()));
    const Scene floor = floor_scene(40.0F, 0.0F, 0.5F);
    const std::vector<float> even = image(0.0, floor);
    const std::vector<float> weaker = image(6.0, floor);
    for (const int beam : {0, 20, 63}) {
        const double off = (2.0 * beam + 1.0) / 64 - 1.0;
        const double loss_db = -10.0 * std::log10(weaker[9600 + beam] / even[9600 + beam]);
        CHECK(std::fabs(loss_db - 6.0 * off * off) < 0.2);  // beside the side lobes' share
    }
}

TEST_CASE("reverberation: a tail has its share of the energy, and falls by 60 dB in T60") {
    // sum of r_k over k behind one echo of power 1 is share (1 - d) (1 + d + d^2 ...) = share.
    constexpr double time_s = 0.02;  // 300 bins of 67 us
    EchoGrid grid(2000, 1);
    grid.column(0)[2 * 10] = 1.0F;
    std::vector<float> tails(2000, 0.0F);
    add_tails(tail_of(-20.0, time_s), grid.column(0), tails);
    const auto at = [&](int row) { return static_cast<double>(tails[row]); };
    double energy = 0.0;
    for (int row = 11; row < 2000; ++row)
        energy += at(row);
    CHECK(std::fabs(energy / 0.01 - 1.0) < 1e-3);
    CHECK(std::fabs(at(11 + 300) / at(11) / 1e-6 - 1.0) < 1e-3);
    CHECK(at(9) + at(10) == 0.0);          // nothing in the bin of the echo
    std::vector<float> water(2000, 0.0F);  // has tails, too
    water[10] = 1.0F;
    add_tails(tail_of(-20.0, time_s), EchoGrid(2000, 1).column(0), water);
    CHECK(std::equal(water.begin() + 11, water.end(), tails.begin() + 11));
}

TEST_CASE("reverberation: amplitudes of a tail have its power and are drawn for each ping") {
    std::array<std::vector<double>, 2> powers;
    for (const std::uint32_t ping : {0U, 1U}) {
        EchoGrid grid(64, 400);
        for (int c = 0; c < grid.columns(); ++c)
            grid.column(c)[0] = 1.0F;
        for (int c = 0; c < grid.columns(); ++c) {
            std::vector<float> tails(64, 0.0F);
            add_tails(tail_of(-10.0, 0.05), grid.column(c), tails);
            add_drawn(PowerForm::amplitude, tails, 1.0F, c, {ping, 7}, grid);
            for (int row = 1; row < 64; ++row) {
                const double re = grid.column(c)[2 * row];
                const double im = grid.column(c)[2 * row + 1];
                powers[ping].push_back(re * re + im * im);
            }
        }
    }
    const double d = std::pow(10.0, -6.0 * 2.0 * bin_m / water_speed_m_s / 0.05);
    const double expected = 0.1 * (1.0 - std::pow(d, 63.0)) / 63.0;
    // 25,200 exponential powers: 4.5 standard errors, which their decay raises a little.
    CHECK(std::fabs(mean(powers[0]) / expected - 1.0) < 4.5 * 1.2 / std::sqrt(25200.0));
    CHECK(powers[0] != powers[1]);
}

// A plate has its echo in few bins, and 200 bins of tail in 20 beams: 4,000 exponential draws.
TEST_CASE("reverberation: the tails of all speckle have their share of the energy") {
    const View view{radians(60.0), radians(20.0), 4.0, 24.0, 400, 60};
    Samples plate;
    plate.items = {plate_ahead(8.0, 3.0)};
    const auto energy = [&](SpeckleMode mode, double reverberation_s) {
        InstrumentConfig config = bare({});
        config.speckle.mode = mode;
        config.receiver.reverberation_s = reverberation_s;
        config.receiver.reverberation_db = -3.0103;
        const CalibratedModel model = calibrated_model(config, {}, view, fan_sines(60.0, 60));
        double sum = 0.0;
        for (std::uint64_t seed = 1; seed <= 32; ++seed) {
            const auto image =
                image_of_samples(model, view, plate, {.random = 1}, {}, {seed, 2, 0});
            sum += total(std::span<const float>(image));
        }
        return sum;
    };
    for (const SpeckleMode mode : {SpeckleMode::none, SpeckleMode::ping, SpeckleMode::scene}) {
        CAPTURE(static_cast<int>(mode));
        // Scatterers at one range have the level of their place between two bins.
        const double echo = energy(mode == SpeckleMode::scene ? mode : SpeckleMode::none, 0.0);
        const double tail = energy(mode, 0.02) - energy(mode, 0.0);
        CHECK(tail / echo == approx(0.5).epsilon(0.03));
    }
}

TEST_CASE("detected sample: one sample stays, and several keep the mean") {
    CHECK_FALSE(DetectedSample(sampling(1.0, SampleRule::maximum)).changes());
    for (const ReceiverConfig& config :
         {sampling(2.0, SampleRule::maximum), sampling(14.0, SampleRule::maximum),
          sampling(3.5, SampleRule::mean), sampling(9.0, SampleRule::maximum, 1.75)}) {
        std::mt19937 draws(11);
        std::exponential_distribution<float> speckle;
        std::vector<float> power(200000);
        for (float& x : power)
            x = speckle(draws);
        DetectedSample(config).apply(std::vector<float>(power.size(), 1.0F), power);
        // The variance is at most that of exponential powers: 5 standard errors.
        CHECK(std::fabs(total(power) / 200000.0 - 1.0) < 5.0 / std::sqrt(200000.0));
    }
}

TEST_CASE("detected sample: the largest of n has the quantile of the sample's rank") {
    // (1 - e^-v)^n = 1 - e^-x, and the mean of the largest of n is 1 + 1/2 + ... + 1/n.
    for (const int n : {2, 5, 14}) {
        double harmonic = 0.0;
        for (int k = 1; k <= n; ++k)
            harmonic += 1.0 / k;
        for (const double x : {1e-6, 1e-3, 0.1, 0.7, 2.0, 9.0, 30.0}) {
            const double v = harmonic * delivered(sampling(n, SampleRule::maximum), x);
            // ln of 1 - (1 - e^-v)^n, without cancellation where that is small.
            const double ln_above = std::log(-std::expm1(n * std::log1p(-std::exp(-v))));
            CAPTURE_ALL(n, x);
            CHECK(std::fabs(-ln_above / x - 1.0) < (x < 1e-2 ? 0.02 : 1e-3));
        }
    }
}

TEST_CASE("detected sample: the mean of two has the quantile of the gamma distribution") {
    // P(sum > z) = e^-z (1 + z) = e^-x, and the mean of two is z / 2.
    for (const double x : {0.05, 0.7, 2.0, 9.0, 25.0}) {
        const double z = 2.0 * delivered(sampling(2.0, SampleRule::mean), x);
        CAPTURE(x);
        CHECK(std::fabs((z - std::log1p(z)) / x - 1.0) < 2e-3);
    }
}

TEST_CASE("detected sample: an expansion raises the power of the sample to it") {
    const auto over_median = [](double expansion, double x) {
        const ReceiverConfig config = sampling(9.0, SampleRule::maximum, expansion);
        return delivered(config, x) / delivered(config, std::log(2.0));
    };
    for (const double x : {0.01, 0.3, 3.0, 9.0}) {
        CAPTURE(x);
        CHECK(over_median(1.75, x) == approx(std::pow(over_median(1.0, x), 1.75)).epsilon(1e-3));
    }
}
