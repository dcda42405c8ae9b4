#include "calibrate/texture_fit.h"

#include <doctest/doctest.h>

#include <cmath>

#include "calibrate/made_pings.h"
#include "support/approx.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// Patches with the correlations of a texture and a pulse, each off by a drawn number.
PatchClasses textured_patches(const BottomTexture& texture, const EchoPatches& distances,
                              const std::array<double, patch_lags>& of_pulse) {
    Draws draws(11);
    PatchClasses out;
    out.places = 300;
    for (int place = 0; place < out.places; ++place) {
        PatchMoments patch;
        patch.place = place;
        patch.variance = 1.0;
        for (std::size_t lag = 0; lag < patch_lags; ++lag) {
            const auto number = static_cast<double>(lag + 1);
            const double along =
                texture.correlation(of_pulse[lag], number * distances.range_step_m);
            const double across =
                texture.correlation(distances.of_beams[lag], number * distances.beam_step_m);
            patch.along_range[lag] = 1.0 - along + draws.between(-0.1, 0.1);
            patch.along_beams[lag] = 1.0 - across + draws.between(-0.1, 0.1);
        }
        out.echoes.push_back(out.patches.size());
        out.patches.push_back(patch);
    }
    return out;
}

}  // namespace

TEST_SUITE("calibrate") {
    TEST_CASE("texture: trigamma and its inverse") {
        // trigamma(1) = pi^2 / 6; trigamma(1/2) = pi^2 / 2.
        CHECK(trigamma(1.0) == test::approx(pi * pi / 6.0).epsilon(1e-7));
        CHECK(trigamma(0.5) == test::approx(pi * pi / 2.0).epsilon(1e-7));
        for (const double shape : {0.3, 2.0, 40.0})
            CHECK(inverse_trigamma(trigamma(shape)) == test::approx(shape).epsilon(1e-6));
    }

    TEST_CASE("texture: share, edge and pulse are found in the correlations that they make") {
        const PulseModel model{.receiver = {}, .kind = ReceivedKind::echo};
        EchoPatches echoes{nullptr, 0.003, 0.004, {}};
        for (std::size_t lag = 0; lag < patch_lags; ++lag)
            echoes.of_beams[lag] = std::exp(-0.8 * static_cast<double>((lag + 1) * (lag + 1)));
        for (const double share : {0.1, 0.3}) {
            CAPTURE(share);
            const BottomTexture truth{share, 0.02};
            const PatchClasses patches = textured_patches(truth, echoes, model.correlations(1.3));
            echoes.classes = &patches;
            const std::optional<TextureFit> fit = fit_texture(echoes, model);
            REQUIRE(fit.has_value());
            // One draw of six numbers: twice the interval of 95 of 100 cases is missed once in
            // 10^4.
            const auto is_near = [](const Bounded& number, double truth) {
                return std::fabs(number.value - truth) < 2.0 * number.half_width();
            };
            CHECK(is_near(fit->share, share));
            CHECK(is_near(fit->edge_m, 0.02));
            CHECK(is_near(fit->pulse_bins, 1.3));
        }
        const PatchClasses even = textured_patches({}, echoes, model.correlations(1.3));
        echoes.classes = &even;
        CHECK_FALSE(fit_texture(echoes, model).has_value());
    }

    TEST_CASE("texture: the preset's shape has the variance that was measured") {
        const LogStatistics one = log_statistics(1);
        const SpeckleConfig speckle{.clutter_shape = inverse_trigamma(0.25 * one.variance),
                                    .clutter_m = 0.05};
        const BottomTexture texture = texture_of(speckle, one);
        CHECK(texture.share == test::approx(0.2).epsilon(1e-6));
        CHECK(texture.correlation(0.5, 0.025) == test::approx(0.8 * 0.5 + 0.2 * 0.5));
        CHECK(texture.correlation(0.5, 0.06) == test::approx(0.8 * 0.5));
        CHECK(texture_of({}, one).share == 0.0);
    }
}
