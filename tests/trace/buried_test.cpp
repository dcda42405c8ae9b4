#include "trace/buried.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/units.h"
#include "support/approx.h"
#include "support/scenes.h"
#include "trace/particles.h"
#include "visibility/rays/rays_engine.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

constexpr SedimentPath in_sand{.speed_ratio = 1.15, .density_ratio = 1.9, .loss_per_m = 3.0};
constexpr SedimentPath in_mud{.speed_ratio = 0.98, .density_ratio = 1.2, .loss_per_m = 0.2};

/// The distance along the bottom of the way that leaves at an angle.
double reach(const SedimentPath& sediment, double height_m, double depth_m, double angle) {
    const double below = std::asin(sediment.speed_ratio * std::sin(angle));
    return height_m * std::tan(angle) + depth_m * std::tan(below);
}

}  // namespace

TEST_SUITE("trace") {
    // Straight down, with h in the water and d in the sediment of the speed n c and the density m:
    // a cone of the half angle a is h a + d n a wide at the depth d, so the spread is (h + n d)^2.
    // R = ((m n - 1) / (m n + 1))^2 is reflected. A point in the water at the range r of the echo,
    // h + d / n, has 1 / r^4. The way back, by reciprocity, spreads from the point as
    // (d + h / n)^2, so both ways give (1 - R)^2 n^2 / (h + n d)^4 e^-(loss d).
    TEST_CASE("buried: the echo of a point straight below") {
        for (const SedimentPath& sediment : {in_sand, in_mud}) {
            for (const double depth : {0.05, 0.4, 2.0}) {
                const double h = 6.0;
                const double n = sediment.speed_ratio;
                const WayIntoBottom way = way_into_bottom(sediment, h, depth, 0.0);
                CHECK(way.range_m(sediment) == test::approx(h + depth / n).epsilon(1e-12));
                CHECK(way.spread_m2 == test::approx(std::pow(h + n * depth, 2)).epsilon(1e-9));
                const double z = sediment.density_ratio * n;
                const double passed = 1.0 - std::pow((z - 1.0) / (z + 1.0), 2);
                const double out = passed / std::pow(h + n * depth, 2);
                const double back = passed / std::pow(depth + h / n, 2);
                const double expected = out * back * std::exp(-sediment.loss_per_m * depth);
                CHECK(echo_through_bottom(sediment, way) / std::pow(way.range_m(sediment), 4) ==
                      test::approx(expected).epsilon(1e-6));
            }
        }
    }

    // At a slant: Snell's law, the least time of all ways over a point of the surface, and the
    // spread x dx/da cos(a') / sin(a) by finite differences. Beyond the critical angle of
    // sand, 60.4 degrees, a way goes in at a steeper angle and on within the sediment.
    TEST_CASE("buried: refraction at a slant") {
        for (const SedimentPath& sediment : {in_sand, in_mud}) {
            for (const double across : {0.5, 4.0, 11.0, 30.0}) {
                const double h = 6.0;
                const double d = 0.3;
                const WayIntoBottom way = way_into_bottom(sediment, h, d, across);
                const double a = way.angle_rad;
                CHECK(reach(sediment, h, d, a) == test::approx(across).epsilon(1e-6));
                const auto time = [&](double x) {
                    return std::hypot(h, x) + std::hypot(d, across - x) / sediment.speed_ratio;
                };
                const double entry = h * std::tan(a);
                CHECK(way.range_m(sediment) == test::approx(time(entry)).epsilon(1e-9));
                CHECK(time(entry) <= time(entry + 1e-3) + 1e-12);
                CHECK(time(entry) <= time(entry - 1e-3) + 1e-12);
                const double below = std::asin(sediment.speed_ratio * std::sin(a));
                const double step = 1e-7;
                const double dx =
                    (reach(sediment, h, d, a + step) - reach(sediment, h, d, a - step)) /
                    (2.0 * step);
                CHECK(way.spread_m2 ==
                      test::approx(across * dx * std::cos(below) / std::sin(a)).epsilon(1e-3));
            }
        }
    }

    TEST_CASE("buried: seen through a sea bed, and through nothing else") {
        Scene scene = empty_scene();
        add_floor(scene, 30.0F, 0.0F, add_material(scene, 0.3F), 4);
        const auto engine = make_rays_engine(scene);
        const View down{.azimuth_rad = radians(60.0),
                        .elevation_rad = radians(60.0),
                        .range_min_m = 0.5,
                        .range_max_m = 20.0,
                        .range_bins = 100,
                        .beams = 1,
                        .relative_l1 = 0.03,
                        .shape = ViewShape::cone};
        const Pose pose{rotation_from_rpy(0.0, 0.5 * pi, 0.0), {0.0, 0.0, 6.0}};
        Particles particles;
        for (const double z : {-0.5, 0.5}) {
            Particle& mine = particles.all.emplace_back();
            mine.start_m = {1.0, 0.0, z};
            mine.velocity_m_s = Eigen::Vector3d::Zero();
            mine.section_m2 = 0.01F;
            mine.buried = true;
        }
        const auto seen = [&] {
            return seen_particles(particles, 0.0, down, {}, *engine, pose, {});
        };
        CHECK(seen().samples.empty());  // rock
        particles.sediments.assign(scene.materials.size(), in_sand);
        REQUIRE(seen().numbers == std::vector<std::uint32_t>{0});  // the other is in the water
        const Sample sample = seen().samples[0];
        const WayIntoBottom way = way_into_bottom(in_sand, 6.0, 0.5, 1.0);
        CHECK(sample.height_m == test::approx(way.range_m(in_sand)).epsilon(1e-5));
        CHECK(sample.position.x() ==
              test::approx(way.range_m(in_sand) * std::cos(way.angle_rad)).epsilon(1e-5));
        CHECK(sample.area_m2 ==
              test::approx(0.01 * echo_through_bottom(in_sand, way)).epsilon(1e-4));
    }

    // Apparent places are nearer than true ones in sand, and farther in mud.
    TEST_CASE("buried: the range window holds apparent places") {
        Scene scene = empty_scene();
        add_floor(scene, 30.0F, 0.0F, add_material(scene, 0.3F), 4);
        const auto engine = make_rays_engine(scene);
        View down{.azimuth_rad = radians(60.0),
                  .elevation_rad = radians(60.0),
                  .range_min_m = 0.5,
                  .range_max_m = 20.0,
                  .range_bins = 100,
                  .beams = 1,
                  .relative_l1 = 0.03,
                  .shape = ViewShape::cone};
        const Pose pose{rotation_from_rpy(0.0, 0.5 * pi, 0.0), {0.0, 0.0, 6.0}};
        Particles particles;
        Particle& mine = particles.all.emplace_back();
        mine.start_m = {1.0, 0.0, -3.0};
        mine.velocity_m_s = Eigen::Vector3d::Zero();
        mine.section_m2 = 0.01F;
        mine.buried = true;
        for (const SedimentPath& sediment : {in_sand, in_mud}) {
            particles.sediments.assign(scene.materials.size(), sediment);
            const double range = way_into_bottom(sediment, 6.0, 3.0, 1.0).range_m(sediment);
            for (const double more : {-0.02, 0.02}) {
                down.range_max_m = range + more;
                const auto seen = seen_particles(particles, 0.0, down, {}, *engine, pose, {});
                CHECK(seen.samples.size() == (more > 0.0 ? 1 : 0));
            }
        }
    }
}
