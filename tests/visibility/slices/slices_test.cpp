#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "core/units.h"
#include "support/approx.h"
#include "support/scenes.h"
#include "visibility/rays/rays_engine.h"
#include "visibility/slices/fixtures.h"
#include "visibility/slices/slices_engine.h"

using namespace sonarsim;
using test::area_of;
using test::fan_view;
using test::seen;

TEST_SUITE_BEGIN("slices");

namespace {

View cone_view() {
    View view = fan_view();
    view.azimuth_rad = view.elevation_rad = radians(60.0);
    view.beams = 1;
    view.shape = ViewShape::cone;
    return view;
}

View sides_view() {
    View view = fan_view();
    view.azimuth_rad = radians(160.0);
    view.elevation_rad = radians(1.0);
    view.beams = 2;
    view.shape = ViewShape::port_starboard;
    return view;
}

/// The solid angle that the samples fill.
double filled(const Samples& samples) {
    double sum = 0.0;
    for (const Sample& sample : samples.items) {
        const double r = sample.position.norm();
        sum += sample.area_m2 * (sample.height_m / r) / (r * r);
    }
    return sum;
}

Pose pitched(double pitch_deg, const Eigen::Vector3d& position = Eigen::Vector3d::Zero()) {
    return {rotation_from_rpy(0.0, radians(pitch_deg), 0.0), position};
}

/// The wall x = `x`, 40 m across, of n x n x 2 triangles.
Scene wall(float x, int n = 1) {
    Scene scene = test::empty_scene();
    test::add_quad(scene, {x, -20, -20}, {x, 20, -20}, {x, 20, 20}, {x, -20, 20},
                   test::add_material(scene, 0.5F), n);
    return scene;
}

/// The visible area of the wall x = d: |y| <= Y = d tan(phi) and |z| <= tan(theta) sqrt(d^2 + y^2).
/// The integral of sqrt(d^2 + y^2) is (y sqrt(d^2 + y^2) + d^2 asinh(y / d)) / 2.
double area_of_wall(double d, const View& view) {
    const double Y = d * std::tan(0.5 * view.azimuth_rad);
    return 2.0 * std::tan(0.5 * view.elevation_rad) *
           (Y * std::hypot(d, Y) + d * d * std::asinh(Y / d));
}

}  // namespace

TEST_CASE("slices: a wall seen face on has its area, whole or in many triangles") {
    const View view = fan_view();
    for (const int n : {1, 7, 200}) {
        CAPTURE(n);
        const Samples samples = seen(wall(5.0F, n), view, {});
        CHECK(area_of(samples) / area_of_wall(5.0, view) == test::approx(1.0).epsilon(1e-5));
        for (const Sample& sample : samples.items) {
            CHECK(sample.position.x() == test::approx(5.0).epsilon(1e-3));
            CHECK(sample.height_m == test::approx(5.0).epsilon(1e-5));
            CHECK(sample.normal.x() == test::approx(-1.0).epsilon(1e-5));
        }
    }
}

TEST_CASE("slices: at a coarse goal the pieces of neighbouring slices become one") {
    // Between slices on the borders of a beam every patch of a wall has two halves. Goals of 2 %
    // and slightly less give patches of the same size.
    View view = fan_view();
    view.beams = 128;  // wider beams are more than one gap
    const Pose pose{rotation_from_rpy(0.0, radians(20.0), radians(10.0)), {0.0, 0.0, 0.0}};
    view.relative_l1 = 0.02;
    const Samples coarse = seen(wall(5.0F), view, pose, 1);
    view.relative_l1 = 0.0199;
    const Samples fine = seen(wall(5.0F), view, pose, 1);
    CHECK(static_cast<double>(coarse.items.size()) < 0.6 * static_cast<double>(fine.items.size()));
    const auto area_of_beam = [](const Samples& samples, int j) {
        double area = 0.0;
        for (const Sample& sample : samples.beam(j))
            area += sample.area_m2;
        return area;
    };
    for (int j = 0; j < view.beams; ++j) {
        CAPTURE(j);
        REQUIRE(area_of_beam(fine, j) > 0.0);
        CHECK(area_of_beam(coarse, j) / area_of_beam(fine, j) == test::approx(1.0).epsilon(1e-4));
    }
}

TEST_CASE("slices: samples are sorted by beam and do not leave it") {
    const View view = fan_view();
    const Samples samples = seen(test::tank(), view, pitched(15.0, {-2.4, 0.4, 1.5}));
    REQUIRE(samples.beam_begin.size() == 65);
    CHECK(samples.beam_begin.front() == 0);
    CHECK(samples.beam_begin.back() == samples.items.size());
    const double width = view.azimuth_rad / view.beams;
    for (int j = 0; j < view.beams; ++j) {
        CHECK(!samples.beam(j).empty());
        for (const Sample& sample : samples.beam(j)) {
            for (const float side : {-1.0F, 1.0F}) {
                const Eigen::Vector3f p = sample.position + side * sample.edge_u;
                const double beam = std::atan2(p.y(), p.x()) / width + 0.5 * view.beams - j;
                // A parallelogram as deep as its surface may be slightly wider.
                CHECK(beam > -0.05);
                CHECK(beam < 1.05);
            }
        }
    }
}

TEST_CASE("slices: a sphere fills the solid angle that it should") {
    // 2 pi (1 - cos) of the cone that touches it: sin = R / D. Every sample fills A (v . n) / r^2.
    Scene scene = test::empty_scene();
    test::add_sphere(scene, {5, 0, 0}, 0.5F, test::add_material(scene, 0.5F), 256);
    const double expected = 2.0 * pi * (1.0 - std::sqrt(1.0 - 0.01));
    for (const View& view : {fan_view(), cone_view()}) {
        // The missing part is ends of facets at the limb; it falls with the width of the gaps.
        CHECK(filled(seen(scene, view, {}, 4)) / expected == test::approx(1.0).epsilon(0.015));
        CHECK(filled(seen(scene, view, {}, 16)) / expected == test::approx(1.0).epsilon(0.004));
    }
}

TEST_CASE("slices: a cone sees a disc, whatever it is cut into") {
    // A plane at d across the boresight, opening 60 degrees: pi (d tan 30)^2.
    const double disc = pi * 16.0 / 3.0;
    for (const int n : {1, 40}) {
        CHECK(area_of(seen(wall(4.0F, n), cone_view(), {})) / disc ==
              test::approx(1.0).epsilon(5e-4));
    }
}

TEST_CASE("slices: the narrowest cone sees its disc") {
    for (const double opening_deg : {0.3, 0.1, 0.01}) {
        View view = cone_view();
        view.azimuth_rad = view.elevation_rad = radians(opening_deg);
        const double radius = 4.0 * std::tan(radians(0.5 * opening_deg));
        // At 0.01 degrees, the surface within 1e-5 rad of the axis and rounding are missing.
        CHECK(area_of(seen(wall(4.0F, 1), view, {})) ==
              test::approx(pi * radius * radius).epsilon(opening_deg < 0.1 ? 0.2 : 5e-3));
    }
}

TEST_CASE("slices: the two sides see a strip of the floor") {
    // Elevations +-e on the wall x = d: 2 e r_ground dy = 2 tan(e) sqrt(d^2 + y^2) dy.
    View view = sides_view();
    view.range_max_m = 30.0;
    const Samples samples = seen(wall(3.0F, 3), view, {});
    CHECK(area_of(samples) / area_of_wall(3.0, view) == test::approx(1.0).epsilon(0.003));
    double starboard = 0.0;
    for (const Sample& sample : samples.beam(0)) {
        CHECK(sample.position.y() < 1e-3);
        starboard += sample.area_m2;
    }
    CHECK(starboard == test::approx(0.5 * area_of(samples)).epsilon(0.001));
}

TEST_CASE("slices: where two planes cross, each is seen on its side") {
    // x = 5 + z / 2 and x = 5 - z / 2: the second is nearer above z = 0.
    Scene scene = test::empty_scene();
    const std::uint32_t below = test::add_material(scene, 0.4F);
    const std::uint32_t above = test::add_material(scene, 0.6F);
    test::add_quad(scene, {3, -9, -4}, {3, 9, -4}, {7, 9, 4}, {7, -9, 4}, below);
    test::add_quad(scene, {7, -9, -4}, {7, 9, -4}, {3, 9, 4}, {3, -9, 4}, above);
    double area_below = 0.0;
    double area_above = 0.0;
    for (const Sample& sample : seen(scene, fan_view(), {}).items) {
        const bool is_above = sample.material == above;
        CHECK((is_above ? 1.0F : -1.0F) * sample.position.z() > -1e-4F);
        (is_above ? area_above : area_below) += sample.area_m2;
    }
    CHECK(area_below > 1.0);
    CHECK(area_above == test::approx(area_below).epsilon(1e-4));
}

TEST_CASE("slices: a full turn and steep views see all of a sphere around the sonar") {
    Scene scene = test::empty_scene();
    test::add_sphere(scene, {0, 0, 0}, 3.0F, test::add_material(scene, 0.5F), 128);
    View view = fan_view();
    view.azimuth_rad = 2.0 * pi;
    view.elevation_rad = pi;
    CHECK(area_of(seen(scene, view, {})) == test::approx(36.0 * pi).epsilon(0.01));
    // Latitudes within +-30 degrees: 2 pi R^2 (2 sin 30).
    view.elevation_rad = radians(60.0);
    CHECK(area_of(seen(scene, view, {})) == test::approx(18.0 * pi).epsilon(0.01));
}

TEST_CASE("slices: the same answer for the same question, and where coordinates are large") {
    const Pose pose = pitched(15.0, {-2.4, 0.4, 1.5});
    const Scene here = test::tank();
    const auto engine = make_slices_engine(here, Caster(here));
    for (const View& view : {fan_view(), cone_view(), sides_view()}) {
        const Samples first = engine->visible_surface(view, pose);
        engine->visible_surface(fan_view(), pitched(40.0, {0, 0, 2}));
        const Samples again = engine->visible_surface(view, pose);
        REQUIRE(first.items.size() == again.items.size());
        CHECK(std::memcmp(first.items.data(), again.items.data(),
                          first.items.size() * sizeof(Sample)) == 0);
        Scene there = test::tank();
        there.origin += Eigen::Vector3d(5e5, 5e6, -50.0);
        const Pose moved = pitched(15.0, Eigen::Vector3d(-2.4, 0.4, 1.5) + there.origin);
        CHECK(area_of(seen(there, view, moved)) ==
              test::approx(area_of(seen(here, view, pose))).epsilon(1e-3));
    }
}

TEST_CASE("slices: rays see the same tank") {
    const Scene scene = test::tank();
    const auto slices = make_slices_engine(scene, Caster(scene));
    const auto rays = make_rays_engine(scene);
    for (View view : {fan_view(), cone_view(), sides_view()}) {
        view.relative_l1 = 0.01;
        const Pose pose = pitched(15.0, {-2.4, 0.4, 1.5});
        CHECK(filled(slices->visible_surface(view, pose)) /
                  filled(rays->visible_surface(view, pose)) ==
              test::approx(1.0).epsilon(0.03));
    }
}

TEST_CASE("slices: three planes that cross in one slice are each seen where they are nearest") {
    // Planes through (5, y, 0) that lean by -1, 0 and 1: the outer two are nearer above and below.
    Scene scene = test::empty_scene();
    std::array<std::uint32_t, 3> material;
    for (int k = 0; k < 3; ++k) {
        const auto lean = static_cast<float>(k - 1);
        material[k] = test::add_material(scene, 0.3F + 0.1F * static_cast<float>(k));
        test::add_quad(scene, {5 - 4 * lean, -9, -4}, {5 - 4 * lean, 9, -4}, {5 + 4 * lean, 9, 4},
                       {5 + 4 * lean, -9, 4}, material[k]);
    }
    std::array<double, 3> area{};
    for (const Sample& sample : seen(scene, fan_view(), {}).items) {
        const auto k = std::ranges::find(material, sample.material) - material.begin();
        area[k] += sample.area_m2;
        // The plane that leans towards the sonar above z = 0 has normal.z > 0.
        if (k != 1) CHECK(sample.position.z() * static_cast<float>(1 - k) > -1e-4F);
    }
    CHECK(area[1] < 1e-4);
    CHECK(area[0] > 1.0);
    CHECK(area[2] / area[0] == test::approx(1.0).epsilon(1e-4));
}

TEST_CASE("slices: a finer goal asks for more slices") {
    const Scene scene = test::tank();
    const auto engine = make_slices_engine(scene, Caster(scene));
    const Pose pose = pitched(15.0, {-2.4, 0.4, 1.5});
    std::size_t samples = 0;
    for (const double goal : {0.1, 0.03, 0.01}) {
        View view = fan_view();
        view.relative_l1 = goal;
        const Samples visible_now = engine->visible_surface(view, pose);
        CHECK(visible_now.items.size() > samples);
        samples = visible_now.items.size();
    }
}

TEST_SUITE_END();
