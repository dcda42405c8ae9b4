#include "trace/retraced.h"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <random>
#include <utility>

#include "core/units.h"
#include "support/approx.h"
#include "support/scenes.h"
#include "visibility/rays/rays_engine.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

constexpr float front_m = 4.0F;  ///< walls ahead of the sonar and behind it
constexpr float back_m = 3.0F;

/// Two walls that face each other, ahead with the reflection 0.5 and behind with 0.3.
Scene two_walls() {
    Scene scene = empty_scene();
    const std::uint32_t ahead = add_material(scene, 0.5F);
    const std::uint32_t behind = add_material(scene, 0.3F);
    add_quad(scene, {front_m, -60.0F, -60.0F}, {front_m, 60.0F, -60.0F}, {front_m, 60.0F, 60.0F},
             {front_m, -60.0F, 60.0F}, ahead);
    add_quad(scene, {-back_m, -60.0F, -60.0F}, {-back_m, 60.0F, -60.0F}, {-back_m, 60.0F, 60.0F},
             {-back_m, -60.0F, 60.0F}, behind);
    return scene;
}

const View retraced_view{.azimuth_rad = radians(60.0),
                         .elevation_rad = radians(20.0),
                         .range_min_m = 0.5,
                         .range_max_m = 40.0,
                         .range_bins = 400,
                         .beams = 32,
                         .relative_l1 = 0.03,
                         .shape = ViewShape::fan};

struct Retraced {
    Samples samples;
    RetracedSurface found;
};

Retraced retrace(const Scene& scene, const Pose& pose, int most, float least) {
    const auto engine = make_rays_engine(scene);
    Retraced out;
    out.samples = engine->visible_surface(retraced_view, pose);
    Multipath multipath;
    multipath.retraced = most;
    multipath.retraced_least = least;
    MultipathCounts counts;
    out.found = retraced_surface(
        multipath,
        {.view = retraced_view, .scene = scene, .engine = *engine, .T_world_sensor = pose},
        out.samples, counts);
    return out;
}

}  // namespace

TEST_SUITE("trace") {
    // Folded out at each reflection the walls stand at 4, 4 + 7, 4 + 14 ... m, in turn the wall
    // ahead and the one behind. Power is reflected out and back: by 0.5^2, then 0.3^2 as well, and
    // so on. The solid angle of a piece is that of the sample that its sound met first.
    TEST_CASE("retraced: the images of two walls that face each other") {
        const Scene scene = two_walls();
        const auto [samples, found] = retrace(scene, {}, 4, 0.0F);
        std::map<int, int> counts;
        for (std::size_t k = 0; k < found.samples.size(); ++k) {
            const Sample& seen = found.samples[k];
            const Sample& source = samples.items[found.sources[k]];
            const int order =
                static_cast<int>(std::lround((seen.position.x() - front_m) / (front_m + back_m)));
            ++counts[order];
            CHECK(seen.position.x() ==
                  test::approx(front_m + order * (front_m + back_m)).epsilon(1e-3));
            CHECK(seen.position.normalized().dot(source.position.normalized()) > 1.0F - 1e-5F);
            CHECK((seen.normal - Eigen::Vector3f(-1.0F, 0.0F, 0.0F)).norm() < 1e-4F);
            float reflected = 1.0F;
            for (int k2 = 0; k2 < order; ++k2)
                reflected *= k2 % 2 == 0 ? 0.25F : 0.09F;
            CHECK(seen.strength == test::approx(reflected).epsilon(1e-5));
            CHECK(scene.materials[seen.material].reflection == (order % 2 == 0 ? 0.5F : 0.3F));
            const float t = seen.position.x() / front_m;
            CHECK(seen.area_m2 == test::approx(t * t * source.area_m2).epsilon(1e-3));
            CHECK(seen.edge_u.cross(seen.edge_v).norm() ==
                  test::approx(t * t * source.edge_u.cross(source.edge_v).norm()).epsilon(1e-2));
            CHECK(seen.height_m == test::approx(seen.position.x()).epsilon(1e-3));
        }
        // Walls at 11, 18, 25 and 32 m are within 40 m, and none at 4 m: that is the direct echo.
        CHECK(counts.size() == 4);
        for (const int order : {1, 2, 3, 4})
            CHECK(counts[order] > 100);
    }

    // Out over n reflections and back over m, both from the wall ahead on: the places are the
    // images of one point, and have its y and z. Where n - m is odd, one of the two begins at the
    // wall behind, outside the sector.
    TEST_CASE("unequal ways: the images of a point between two walls that face each other") {
        const Scene scene = two_walls();
        const auto [samples, found] = retrace(scene, {}, 4, 0.0F);
        const auto order_of = [](const Eigen::Vector3f& image) {
            return static_cast<int>(std::lround((image.x() - front_m) / (front_m + back_m)));
        };
        const auto reflected = [](int order) {
            float product = 1.0F;
            for (int k = 0; k < order; ++k)
                product *= k % 2 == 0 ? 0.5F : 0.3F;
            return product;
        };
        std::map<std::pair<int, int>, int> counts;
        for (const SpecularPath& path : found.unequal) {
            const Eigen::Vector3f& over_more = path.image_source.at;
            const Eigen::Vector3f& over_fewer = path.point.at;
            const int n = order_of(over_more);
            const int m = order_of(over_fewer);
            ++counts[{n, m}];
            CHECK(std::fabs(over_more.x() - front_m - n * (front_m + back_m)) < 0.01F);
            CHECK(std::fabs(over_fewer.x() - front_m - m * (front_m + back_m)) < 0.01F);
            CHECK((over_more - over_fewer).tail<2>().norm() < 0.01F);
            CHECK((path.image_source.u - path.point.u).norm() < 1e-3F);
            CHECK(path.reflection == test::approx(reflected(n) * reflected(m)).epsilon(1e-5));
            CHECK(path.sine_of_image ==
                  test::approx(over_more.x() / over_more.norm()).epsilon(1e-3));
            CHECK(path.sine_of_point ==
                  test::approx(over_fewer.x() / over_fewer.norm()).epsilon(1e-3));
            CHECK(scene.materials[path.material].reflection == (n % 2 == 0 ? 0.5F : 0.3F));
        }
        CHECK(counts.size() == 4);
        for (const auto& orders :
             {std::pair{2, 0}, std::pair{3, 1}, std::pair{4, 0}, std::pair{4, 2}})
            CHECK(counts[orders] > 10);
    }

    // In a box all ways are known: at a place x of the world that is folded out lies the point of
    // the box that a triangle wave of x gives, and the way crosses a wall at each whole number of
    // the box's lengths. Boxes and poses are drawn at random.
    TEST_CASE("unequal ways: both images of a path fold back to one point of a box") {
        std::mt19937 draws(31);
        const auto draw = [&](double low, double high) {
            return std::uniform_real_distribution<double>(low, high)(draws);
        };
        for (int trial = 0; trial < 6; ++trial) {
            Eigen::Vector3d size;
            Pose pose;
            for (int k = 0; k < 3; ++k) {
                size[k] = draw(4.0, 8.0);
                pose.translation[k] = draw(0.3, 0.7) * size[k];
            }
            const double pitch = draw(-0.3, 0.3);
            pose.rotation = rotation_from_rpy(0.0, pitch, draw(-pi, pi));
            Scene scene = empty_scene();
            add_box(scene, Eigen::Vector3f::Zero(), size.cast<float>(), add_material(scene, 0.5F));
            const auto found = retrace(scene, pose, 3, 0.0F).found;
            CHECK(found.unequal.size() > 1000);
            int crossed = 0;
            int near_walls = 0;
            const auto fold = [&](const Eigen::Vector3f& image) {
                Eigen::Vector3d x = pose.rotation * image.cast<double>() + pose.translation;
                for (int k = 0; k < 3; ++k) {
                    // The point lies on a wall, which is not crossed.
                    const double end = x[k] + (x[k] > pose.translation[k] ? -0.02 : 0.02);
                    crossed += std::abs(static_cast<int>(std::floor(end / size[k])));
                    near_walls += std::fabs(std::remainder(x[k], size[k])) < 0.04 ? 1 : 0;
                    x[k] = std::fabs(std::remainder(x[k], 2.0 * size[k]));
                }
                return x;
            };
            for (const SpecularPath& path : found.unequal) {
                crossed = near_walls = 0;
                const Eigen::Vector3d one = fold(path.image_source.at);
                const Eigen::Vector3d other = fold(path.point.at);
                CHECK((one - other).norm() < 0.02);
                if (near_walls > 2) continue;  // near a seam of two walls
                CHECK(path.reflection == test::approx(std::ldexp(1.0, -crossed)).epsilon(1e-4));
            }
        }
    }

    // After one reflection 0.25 of the power is left, after two 0.0225, after three 0.0056.
    TEST_CASE("retraced: ways end at the limit of the loss and at that of their number") {
        const Scene scene = two_walls();
        const auto furthest = [&](int most, float least) {
            float x = 0.0F;
            for (const Sample& seen : retrace(scene, {}, most, least).found.samples)
                x = std::max(x, seen.position.x());
            return x;
        };
        CHECK(furthest(8, 0.02F) == test::approx(18.0).epsilon(1e-3));
        CHECK(furthest(8, 0.3F) == 0.0F);
        CHECK(furthest(1, 0.0F) == test::approx(11.0).epsilon(1e-3));
        CHECK(furthest(0, 0.0F) == 0.0F);
    }

    // Down from h = 5 m, d = 2 m below the surface of the water, which reflects 0.9 and scatters
    // nothing: the bottom appears anew at h + 2 (h + d).
    TEST_CASE("retraced: the water's surface reflects and has no echo of its own") {
        Scene scene = empty_scene();
        add_floor(scene, 100.0F, 0.0F, add_material(scene, 0.5F), 4);
        scene.water_surface = {7.0, 0.9F};
        const Pose down{rotation_from_rpy(0.0, 0.5 * pi, 0.0), {0.0, 0.0, 5.0}};
        const auto [samples, found] = retrace(scene, down, 2, 0.0F);
        REQUIRE(!found.samples.empty());
        for (const Sample& seen : found.samples) {
            CHECK(seen.position.x() == test::approx(19.0).epsilon(1e-3));
            CHECK(seen.strength == test::approx(0.25 * 0.81).epsilon(1e-5));
        }
    }
}
