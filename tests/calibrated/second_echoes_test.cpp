#include "simulate/calibrated/decibel.h"
#include "support/calibrated.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

constexpr double over_bottom_m = 8.0;
constexpr double below_surface_m = 2.0;

/// A rough flat bottom that reflects 0.25 of the power, below water whose surface reflects 0.9.
Scene bottom_and_surface() {
    Scene scene = empty_scene();
    const std::uint32_t bottom = add_material(scene, 0.25F);
    scene.materials[bottom].slope_rms_deg = 0.0;
    add_floor(scene, 100.0F, 0.0F, bottom, 4);
    scene.water_surface = {over_bottom_m + below_surface_m, 0.9F};
    return scene;
}

/// An echosounder whose beam is far wider than its view.
Sonar wide_echosounder() {
    SonarConfig config = calibrated(default_sonar(SonarKind::echosounder), 3.8e4);
    config.opening_deg = 4.0;
    config.range_min_m = 1.0;
    config.range_max_m = 36.0;
    config.range_bins = 700;
    config.multipath.method = MultipathMethod::exact;
    config.instrument = bare(config.instrument);
    config.instrument.beam.width_deg = 100.0;
    config.instrument.pulse.resolution_m = 0.1;
    return make_sonar(config, {0.002});
}

}  // namespace

TEST_SUITE("calibrated") {
    // A sonar h over the bottom and d below the surface sees the bottom at s_i = h + 2 i (h + d),
    // with the share q^i of the power left, q = 0.25 * 0.9. Echo k is out over way i and back over
    // way k - i, for all i. A narrow view sees the area s^2 w of the longer way s, so that the
    // energy of echo k by that of the first is
    //
    //     h^2 q^k e^-(loss (s_k - h)) sum over i + j = k of min(s_i, s_j)^2 / (s_i^2 s_j^2)
    //
    // Paths end at the second surface: there is no third echo.
    TEST_CASE("second bottom echo: range and level of an echosounder's") {
        const Scene scene = bottom_and_surface();
        const auto engine = make_engine(scene, {});
        const Pose pose{Eigen::Quaterniond::Identity(), {0.0, 0.0, over_bottom_m}};
        const Sonar sonar = wide_echosounder();
        const Ping ping =
            render_ping(sonar, scene, *engine, pose, {.seed = 1}, without_random_terms);
        const double loss_per_m =
            0.2 * std::log(10.0) * calibrated_model_of(sonar).absorption_db_per_m;
        const double bin_m = sonar.settings.view.bin_m();
        const auto s = [](int i) {
            return over_bottom_m + 2.0 * i * (over_bottom_m + below_surface_m);
        };
        const auto predicted = [&](int k) {
            double sum = 0.0;
            for (int i = 0; i <= k; ++i) {
                const double longer = std::max(s(i), s(k - i));
                sum += 1.0 / (longer * longer);
            }
            const double range_m = 0.5 * (s(0) + s(k));
            return sum * over_bottom_m * over_bottom_m * std::pow(0.25 * 0.9, k) *
                   std::exp(-loss_per_m * (range_m - over_bottom_m));
        };
        const auto energy = [&](int k) {
            const double range_m = 0.5 * (s(0) + s(k));
            double sum = 0.0;
            for (int i = 0; i < ping.range_bins; ++i)
                if (std::fabs(1.0 + bin_m * (i + 0.5) - range_m) < 1.0) sum += ping.at(i, 0);
            return sum;
        };
        CHECK(std::fabs(db_of_power(energy(1) / energy(0) / predicted(1))) < 0.15);
        CHECK(energy(2) < 1e-3 * predicted(2) * energy(0));
    }

    // Sound that a bottom h below and a surface d above a side-scan sonar reflect, and that the
    // bottom scatters back, has gone 2 h + d at least: straight down, up, down and up.
    TEST_CASE("second bottom echo: that of a side-scan sonar begins at 2 h + d") {
        constexpr double h = 6.0;
        constexpr double d = 3.0;
        Scene scene = empty_scene();
        add_floor(scene, 50.0F, 0.0F, add_material(scene, 0.25F), 4);
        scene.water_surface = {h + d, 0.9F};
        SonarConfig config = calibrated(default_sonar(SonarKind::sidescan), 3e5);
        config.instrument = bare(config.instrument);
        config.multipath.method = MultipathMethod::exact;
        config.elevation_deg = 4.0;
        config.range_max_m = 30.0;
        config.range_bins = 600;
        const Sonar sonar = make_sonar(config, {0.01});
        const auto engine = make_engine(scene, {});
        const Ping ping =
            render_ping(sonar, scene, *engine, {Eigen::Quaterniond::Identity(), {0.0, 0.0, h}},
                        {.seed = 1}, multipath_alone);
        const double bin_m = sonar.settings.view.bin_m();
        const float most = *std::ranges::max_element(ping.intensity);
        REQUIRE(most > 0.0F);
        for (const int side : {0, 1}) {
            int first = 0;
            while (first < ping.range_bins && ping.at(first, side) < 1e-3F * most)
                ++first;
            const double range = sonar.settings.view.range_min_m + first * bin_m;
            CHECK(range > 2.0 * h + d - 4.0 * bin_m);
            CHECK(range < 2.0 * h + d + 0.5);
        }
    }
}
