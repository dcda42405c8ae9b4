#include "input/scene/placing/standing.h"

#include "support/test.h"

namespace {

/// A grid of points on a closed surface, with two triangles a cell.
Surface surface_from(const std::function<Eigen::Vector3d(double, double)>& point) {
    constexpr std::uint32_t side = 48;
    Surface surface;
    for (std::uint32_t i = 0; i <= side; ++i) {
        for (std::uint32_t j = 0; j <= side; ++j)
            surface.vertices.push_back(point(double(i) / side, double(j) / side));
    }
    for (std::uint32_t i = 0; i < side; ++i) {
        for (std::uint32_t j = 0; j < side; ++j) {
            const std::uint32_t a = i * (side + 1) + j;
            const std::uint32_t b = a + side + 1;
            surface.triangles.push_back({a, b, b + 1});
            surface.triangles.push_back({a, b + 1, a + 1});
        }
    }
    return surface;
}

Surface tyre() {
    return surface_from([](double u, double v) {
        const double r = 0.25 + 0.08 * std::cos(2 * pi * v);
        return Eigen::Vector3d(r * std::cos(2 * pi * u), r * std::sin(2 * pi * u),
                               0.08 * std::sin(2 * pi * v));
    });
}

Surface ball() {
    return surface_from([](double u, double v) -> Eigen::Vector3d {
        const double r = std::sin(pi * v);
        return {r * std::cos(2 * pi * u), r * std::sin(2 * pi * u), std::cos(pi * v)};
    });
}

/// Along z, its ends closed: the first and last rows of points lie in the middle of the ends.
Surface drum() {
    return surface_from([](double u, double v) {
        const double r = v == 0.0 || v == 1.0 ? 0.0 : 0.3;
        const double z = std::clamp((v - 1.0 / 48) / (1 - 2.0 / 48), 0.0, 1.0);
        return Eigen::Vector3d(r * std::cos(2 * pi * u), r * std::sin(2 * pi * u), z);
    });
}

}  // namespace

TEST_CASE("standing: on a broad base, not on an edge or a point") {
    CHECK(rests_upright(tyre(), 2));
    CHECK_FALSE(rests_upright(tyre(), 0));
    CHECK_FALSE(rests_upright(tyre(), 1));
    CHECK(rests_upright(drum(), 2));
    CHECK_FALSE(rests_upright(drum(), 1));
    for (int axis = 0; axis < 3; ++axis)
        CHECK_FALSE(rests_upright(ball(), axis));
    CHECK_FALSE(rests_upright(Surface{}, 2));
}

TEST_CASE("standing: asks for up only where the format does not say it") {
    // As it is read with y up: the file's z lies along the world's -y.
    Surface lying = drum();
    for (Eigen::Vector3d& p : lying.vertices)
        p = Eigen::Vector3d(p.x(), -p.z(), p.y());
    CHECK(up_question({.file = "drum.stl"}, lying).ends_with("does its z point up? up: z"));
    CHECK(up_question({.file = "drum.stl", .z_up = true}, lying).empty());
    CHECK(up_question({.file = "drum.stl", .up_given = true}, lying).empty());
    // A sea floor of 20 m x 20 m with a relief of 2 m.
    Surface floor = surface_from([](double u, double v) -> Eigen::Vector3d {
        return {20 * u, -(1 + std::sin(5 * u) * std::cos(4 * v)), 20 * v};
    });
    CHECK(up_question({.file = "floor.ply"}, floor) ==
          "floor.ply stands on its edge with y up and would lie flat with z up: does its z "
          "point up? up: z");
    for (Eigen::Vector3d& p : floor.vertices)
        p = Eigen::Vector3d(p.x(), p.z(), -p.y());
    CHECK(up_question({.file = "floor.ply"}, floor).empty());
    CHECK(up_question({.file = "drum.glb"}, lying).empty());
    CHECK(up_question({.file = "drum.obj"}, drum()).empty());
    CHECK(up_question({.file = "ball.obj"}, ball()).empty());
}

TEST_CASE("units: a question where millimetres would fit the ranges") {
    const auto question = [](double length_m, double unit_m, auto kind) {
        return unit_question(length_m, unit_m, 10.0, kind);
    };
    CHECK(question(650.0, 1.0, long_object) == "650 m long: millimetres? units: mm");
    CHECK(question(650.0, 1e-3, long_object).empty());
    CHECK(question(15.0, 1.0, long_object).empty());  // a large object
    CHECK(question(2e4, 1.0, long_object).empty());   // 20 m would not fit, either
    CHECK(question(650.0, 1.0, long_place).empty());  // a large place
    CHECK(question(8000.0, 1.0, long_place) == "8000 m long: millimetres? units: mm");
    CHECK(question(6.5e-4, 1e-3, long_object) == "0.00065 m long: metres? units: m");
    CHECK(question(0.0, 1e-3, long_object).empty());
}
