#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "calibrated/decibel.h"
#include "core/units.h"
#include "support/calibrated.h"
#include "support/labelled.h"
#include "support/scenes.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// The wall behind scatters back so much more than that ahead.
constexpr double rougher_db = 3.0;

/// A fan at 20 kHz between two walls that face each other, 4 m ahead with the reflection 0.5 and 3
/// m behind with 0.3. They scatter by Lambert's rule alone: facets would scatter by the reflection.
struct Tank {
    Scene scene = empty_scene();
    Sonar sonar;

    Tank() {
        const std::uint32_t ahead = add_material(scene, 0.5F);
        const std::uint32_t behind = add_material(scene, 0.3F);
        for (Material& material : scene.materials)
            material.slope_rms_deg = 0.0;
        scene.materials[behind].lambert_db = scene.materials[ahead].lambert_db + rougher_db;
        add_quad(scene, {4.0F, -60.0F, -60.0F}, {4.0F, 60.0F, -60.0F}, {4.0F, 60.0F, 60.0F},
                 {4.0F, -60.0F, 60.0F}, ahead);
        add_quad(scene, {-3.0F, -60.0F, -60.0F}, {-3.0F, 60.0F, -60.0F}, {-3.0F, 60.0F, 60.0F},
                 {-3.0F, -60.0F, 60.0F}, behind);
        SonarConfig config = calibrated(default_sonar(SonarKind::imaging), 2e4);
        config.azimuth_deg = 40.0;
        config.elevation_deg = 16.0;
        config.azimuth_bins = 32;
        config.range_min_m = 1.0;
        config.range_max_m = 25.0;
        config.range_bins = 480;
        config.multipath.method = MultipathMethod::cluster;
        config.multipath.retraced = 4;
        config.multipath.retraced_loss_db = 100.0;
        config.instrument = bare(config.instrument);
        config.instrument.beam.width_deg = 2.0;
        sonar = make_sonar(config, {});
    }
};

}  // namespace

TEST_SUITE("calibrated") {
    // Folded out, the walls stand at 4, 11 and 18 m: that ahead, that behind and that ahead. Seen
    // in one direction their mu of Lambert's rule alone differs, and in one solid angle their area
    // grows as r^2: of -40 log r there is left -20 log r. With the power reflected out and back,
    // the energy of wall k by that of wall 0 is
    //
    //     muk / mu0 r0^2 / rk^2 (product of R)^2 e^-(loss (rk - r0)):  R = 0.5, then 0.5 and 0.3.
    //
    // A sheet at r reaches to r / (cos 20 cos 8) = 1.075 r, so that they stay apart.
    TEST_CASE("retraced: the levels of the echoes behind a wall") {
        const Tank tank;
        const auto engine = make_engine(tank.scene, {});
        const Ping ping =
            render_ping(tank.sonar, tank.scene, *engine, {}, {.seed = 1}, without_random_terms);
        const CalibratedModel& model = calibrated_model_of(tank.sonar);
        const auto energy = [&](double from_m, double to_m) {
            double sum = 0.0;
            for (int i = 0; i < ping.range_bins; ++i) {
                const double range = 1.0 + 24.0 * (i + 0.5) / ping.range_bins;
                for (int j = 8; j < 24; ++j)
                    sum += range >= from_m && range < to_m ? ping.at(i, j) : 0.0F;
            }
            return sum;
        };
        const double first = energy(3.5, 5.0);
        const auto expected = [&](double range_m, double reflected) {
            return 20.0 * std::log10(4.0 / range_m * reflected) -
                   2.0 * model.absorption_db_per_m * (range_m - 4.0);
        };
        CHECK(db_of_power(energy(10.5, 12.4) / first) ==
              doctest::Approx(rougher_db + expected(11.0, 0.5)).epsilon(0.005));
        CHECK(db_of_power(energy(17.5, 20.0) / first) ==
              doctest::Approx(expected(18.0, 0.15)).epsilon(0.005));
    }

    TEST_CASE("retraced: bins behind a wall are labelled as multipath of that wall") {
        Tank tank;
        tank.scene.triangle_instance = {0, 0, 1, 1};
        tank.scene.instances = {"ahead", "behind"};
        const Labelled found = label(tank.scene, tank.sonar, {}, EngineKind::rays);
        for (const double range : {11.05, 18.05}) {
            const std::size_t at = found.at(bin_at(tank.sonar, range), 16);
            CHECK(found.labels.multipath[at] == 1.0F);
            REQUIRE(found.labels.object[at] > 0);
            CHECK(found.objects.objects[found.labels.object[at] - 1U].name == "ahead");
        }
        const std::size_t direct = found.at(bin_at(tank.sonar, 4.05), 16);
        CHECK(found.labels.multipath[direct] == 0.0F);
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
