#include "trace/doppler_loss.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "core/units.h"
#include "support/approx.h"
#include "support/patches.h"
#include "support/scenes.h"
#include "trace/object_motion.h"
#include "trace/particles.h"
#include "visibility/rays/rays_engine.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// The ambiguity function of a pulse of length 1 that sweeps over `band` turns per length: the
/// power behind its filter, by that of an echo without a shift, for an echo that comes later by
/// `later` and is higher by `shift` turns per length.
double filtered_power(double band, double later, double shift) {
    constexpr int steps = 4000;
    std::complex<double> sum = 0.0;
    for (int k = 0; k < steps; ++k) {
        const double t = (k + 0.5) / steps - 0.5;
        if (std::fabs(t - later) > 0.5) continue;
        const auto turns = [&](double at) { return 0.5 * band * at * at; };
        sum += std::polar(1.0, 2.0 * pi * (turns(t) - turns(t - later) - shift * t));
    }
    return std::norm(sum) / (static_cast<double>(steps) * steps);
}

PingMotion sonar_of_tone() {
    PingMotion sonar;
    sonar.velocity_m_s = {2.0, 0.0, 0.0};
    sonar.sound_speed_m_s = 1500.0;
    sonar.loss.turns_s_per_m = 0.1;
    return sonar;
}

/// sinc^2 of the turns at a speed, by that sonar.
double share_at(double recedes_m_s) {
    const double x = pi * 0.1 * recedes_m_s;
    return x == 0.0 ? 1.0 : std::pow(std::sin(x) / x, 2);
}

}  // namespace

TEST_SUITE("trace") {
    // An echo that is shifted by d turns over the pulse: that of a tone peaks where it was, that of
    // a sweep over B turns peaks d / B of the pulse off. B is 200, so that its peak is sharp.
    TEST_CASE("doppler loss: what the filter passes is the peak of the ambiguity function") {
        for (const double turns : {0.0, 0.1, 0.37, 0.8, 1.6}) {
            const DopplerLoss tone{.turns_s_per_m = turns, .band_s_per_m = 0.0};
            CHECK(passed_by_filter(tone, 1.0) ==
                  test::approx(filtered_power(0.0, 0.0, turns)).epsilon(1e-5));
            CHECK(passed_by_filter(tone, -1.0) == passed_by_filter(tone, 1.0));
        }
        constexpr double band = 200.0;
        for (const double turns : {0.0, 4.0, 20.0, 60.0}) {
            const DopplerLoss sweep{.turns_s_per_m = 0.0, .band_s_per_m = turns / band};
            double peak = 0.0;
            for (int k = -40; k <= 40; ++k)
                peak = std::max(peak, filtered_power(band, turns / band + 1e-4 * k, turns));
            CHECK(passed_by_filter(sweep, 1.0) == test::approx(peak).epsilon(2e-3));
        }
        CHECK(passed_by_filter({.turns_s_per_m = 0.0, .band_s_per_m = 0.5}, 3.0) == 0.0);
    }

    // The sonar goes ahead at 2 m/s. What stands comes at 2 m/s, what goes with the sonar keeps its
    // distance, and what turns at 0.5 rad/s, 2 m to port of its middle, comes at 1 m/s more.
    TEST_CASE("doppler loss: the speeds of sonar and object add up") {
        const PingMotion sonar = sonar_of_tone();
        const std::vector<ObjectMotion> all{{.instance = 4,
                                             .centre_m = {20.0, 0.0, 0.0},
                                             .velocity_m_s = {2.0, 0.0, 0.0},
                                             .turn_rad_s = {0.0, 0.0, 0.0}},
                                            {.instance = 5,
                                             .centre_m = {20.0, -2.0, 0.0},
                                             .velocity_m_s = {0.0, 0.0, 0.0},
                                             .turn_rad_s = {0.0, 0.0, 0.5}}};
        const Eigen::Vector3f ahead(20.0F, 0.0F, 0.0F);
        const Eigen::Vector3f facing(-1.0F, 0.0F, 0.0F);
        std::vector<Sample> samples;
        for (const std::uint32_t instance : {3U, 4U, 5U})
            samples.push_back(patch_with(ahead, facing, instance));
        samples.push_back(patch_with({0.0F, 20.0F, 0.0F}, {0.0F, -1.0F, 0.0F}, 3));
        fade_by_doppler({all, 0.0}, sonar, {}, std::span<Sample>(samples));
        const std::array expected{share_at(2.0), 1.0, share_at(3.0), 1.0};
        for (std::size_t k = 0; k < samples.size(); ++k)
            CHECK(samples[k].strength == test::approx(expected[k]).epsilon(1e-5));
        TargetFacet facet{};
        facet.corners.fill(ahead);
        facet.instance = 5;
        fade_by_doppler({all, 0.0}, sonar, {}, std::span<TargetFacet>(&facet, 1));
        CHECK(facet.strength == test::approx(share_at(3.0)).epsilon(1e-5));

        const Scene scene = empty_scene();
        const auto engine = make_rays_engine(scene);
        const View view = fan_of_50_m();
        Particles fish;
        fish.all.emplace_back();
        fish.all[0].start_m = {30.0, 0.0, 0.0};
        fish.all[0].velocity_m_s = {-1.5, 0.0, 0.0};
        fish.all[0].section_m2 = 0.01F;
        const auto seen = seen_particles(fish, 0.0, view, {}, *engine, {}, sonar);
        REQUIRE(seen.samples.size() == 1);
        CHECK(seen.samples[0].area_m2 == test::approx(0.01 * share_at(3.5)).epsilon(1e-5));
    }
}
