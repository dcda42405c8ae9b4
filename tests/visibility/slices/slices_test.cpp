#include "visibility/slices/fixtures.h"

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

/// The solid angle that the samples fill.
double filled(const Samples& samples) {
    double sum = 0.0;
    for (const Sample& sample : samples.items) {
        const double r = sample.position.norm();
        sum += sample.area_m2 * (sample.height_m / r) / (r * r);
    }
    return sum;
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
    for (int j = 0; j < view.beams; ++j) {
        CAPTURE(j);
        CHECK(area_of(coarse.beam(j)) / area_of(fine.beam(j)) == test::approx(1.0).epsilon(1e-4));
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

TEST_CASE("slices: a cone sees a disc, however narrow it is and whatever it is cut into") {
    // A plane at d across the boresight: pi (d tan(opening / 2))^2.
    for (const double opening_deg : {60.0, 0.3, 0.1, 0.01}) {
        View view = cone_view();
        view.azimuth_rad = view.elevation_rad = radians(opening_deg);
        const double radius = 4.0 * std::tan(radians(0.5 * opening_deg));
        // At 0.01 degrees, the surface within 1e-5 rad of the axis and rounding are missing.
        const double error = opening_deg < 0.1 ? 0.2 : opening_deg < 1.0 ? 5e-3 : 5e-4;
        for (const int n : {1, 40}) {
            if (n > 1 && opening_deg < 1.0) continue;
            CHECK(area_of(seen(wall(4.0F, n), view, {})) ==
                  test::approx(pi * radius * radius).epsilon(error));
        }
    }
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

TEST_CASE("slices: two wide beams have the surface of rods that stand in each of them") {
    // Beams of 150 degrees. The reference has 64 beams in place of each.
    std::mt19937 random(5);
    std::uniform_real_distribution<float> any(0.0F, 1.0F);
    View view = fan_view();
    view.beams = 2;
    view.azimuth_rad = radians(300.0);
    View narrow = view;
    narrow.beams = 128;
    for (int k = 0; k < 8; ++k) {
        Scene scene = test::empty_scene();
        const std::uint32_t rock = test::add_material(scene, 0.5F);
        for (int rod = 0; rod < 60; ++rod) {
            const float turn = 6.2F * any(random) - 3.1F;
            const float range = 3.0F + 6.0F * any(random);
            test::add_pole(scene, {range * std::cos(turn), range * std::sin(turn), -0.3F}, 0.05F,
                           0.6F, rock, 6);
        }
        const Samples image = seen(scene, view, Pose{}, 0);
        const Samples reference = seen(scene, narrow, Pose{}, 2);
        for (const int beam : {0, 1}) {
            CAPTURE(beam);
            double expected = 0.0;
            for (int j = 64 * beam; j < 64 * beam + 64; ++j)
                expected += test::area_of(reference.beam(j));
            CHECK(test::area_of(image.beam(beam)) == test::approx(expected).epsilon(0.07));
        }
    }
}

TEST_SUITE_END();
