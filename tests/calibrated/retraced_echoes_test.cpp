#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "calibrated/decibel.h"
#include "core/units.h"
#include "support/calibrated.h"
#include "support/labelled.h"
#include "support/sanitized.h"
#include "support/scenes.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// The wall behind scatters back so much more than that ahead.
constexpr double rougher_db = 3.0;
constexpr int most_reflections = 4;

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
        config.multipath.retraced = most_reflections;
        config.multipath.retraced_loss_db = 100.0;
        config.instrument = bare(config.instrument);
        config.instrument.beam.width_deg = 2.0;
        sonar = make_sonar(config, {});
    }
};

/// Folded out, the walls stand at 4 + 7 n m: for even n that ahead, for odd n that behind. A point
/// of one wall is seen there over n reflections, with the same y and z for each n. Out over n and
/// back over m its echo comes at the mean of both ranges, k = (n + m) / 2 walls behind the first,
/// from the direction of the second. With the share P_n of the power that n reflections leave,
/// the energy behind the wall is the sum over n + m = 2 k of
///
///     P_n P_m mu integral of sin_n sin_m / (r_n^2 r_m^2) e^(-loss (r_n + r_m) / 2) dy dz.
///
/// A sheet at r reaches to r / (cos 20 cos 8) = 1.075 r, so that they stay apart.
double expected_energy(int k, double loss_per_m) {
    constexpr int steps = 200;
    double sum = 0.0;
    for (int n = std::max(0, 2 * k - most_reflections); n <= most_reflections && n <= 2 * k; ++n) {
        const int m = 2 * k - n;
        const double x_n = 4.0 + 7.0 * n;
        const double x_m = 4.0 + 7.0 * m;
        const auto left = [](int order) {
            return std::pow(0.5, (order + 1) / 2) * std::pow(0.3, order / 2);
        };
        const double factor = left(n) * left(m) * (n % 2 == 0 ? 1.0 : power_of_db(rougher_db));
        const double reach_y = std::min(x_n, x_m) * std::tan(radians(20.0));
        const double reach_z = 1.1 * std::min(x_n, x_m) * std::tan(radians(8.0));
        for (int i = 0; i < steps; ++i) {
            const double y = reach_y * ((2.0 * i + 1.0) / steps - 1.0);
            for (int j = 0; j < steps; ++j) {
                const double z = reach_z * ((2.0 * j + 1.0) / steps - 1.0);
                const double r_n = std::sqrt(x_n * x_n + y * y + z * z);
                const double r_m = std::sqrt(x_m * x_m + y * y + z * z);
                const bool seen = z < std::min(r_n, r_m) * std::sin(radians(8.0)) &&
                                  -z < std::min(r_n, r_m) * std::sin(radians(8.0));
                if (!seen || std::fabs(y) > r_m * std::sin(radians(10.0))) continue;
                sum += factor * x_n * x_m / std::pow(r_n * r_m, 3.0) *
                       std::exp(-0.5 * loss_per_m * (r_n + r_m)) * reach_y * reach_z;
            }
        }
    }
    return sum;
}

}  // namespace

TEST_SUITE("calibrated") {
    TEST_CASE("retraced: the levels of the echoes behind a wall, over equal and unequal ways") {
        const Tank tank;
        const auto engine = make_engine(tank.scene, {});
        const Ping ping =
            render_ping(tank.sonar, tank.scene, *engine, {}, {.seed = 1}, without_random_terms);
        const double loss_per_m =
            2.0 * std::log(10.0) / 10.0 * calibrated_model_of(tank.sonar).absorption_db_per_m;
        const auto energy = [&](double from_m, double to_m) {
            double sum = 0.0;
            for (int i = 0; i < ping.range_bins; ++i) {
                const double range = 1.0 + 24.0 * (i + 0.5) / ping.range_bins;
                for (int j = 8; j < 24; ++j)
                    sum += range >= from_m && range < to_m ? ping.at(i, j) : 0.0F;
            }
            return sum;
        };
        const double first = energy(3.5, 5.0) / expected_energy(0, loss_per_m);
        CHECK(std::fabs(db_of_power(energy(10.5, 12.4) / first / expected_energy(1, loss_per_m))) <
              0.1);
        CHECK(std::fabs(db_of_power(energy(17.5, 20.0) / first / expected_energy(2, loss_per_m))) <
              0.1);
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
    TEST_CASE("second bottom echo: that of a side-scan sonar begins at 2 h + d" *
              doctest::skip(test::sanitized)) {
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
