#include "visibility/slices/point_image.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "support/approx.h"
#include "support/draws.h"
#include "support/scenes.h"
#include "visibility/angles.h"
#include "visibility/slices/fixtures.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("slices");

namespace {

constexpr double wall_m = 2.05;
constexpr double half_opening = 0.6;

/// A cone of 100 bins of 4 cm.
View cone_at_wall() {
    return {.azimuth_rad = 2.0 * half_opening,
            .elevation_rad = 2.0 * half_opening,
            .range_min_m = 0.0,
            .range_max_m = 4.0,
            .range_bins = 100,
            .beams = 1,
            .relative_l1 = 0.01,
            .shape = ViewShape::cone};
}

/// A wall across the boresight at the distance h. Its mean echo between the ranges r and R is the
/// mean of h / s over the ring's area, 2 pi s ds: 2 h (R - r) / (R^2 - r^2) = 2 h / (R + r).
SampledImage image_of_wall() {
    SampledImage image{std::vector<float>(100), std::vector<float>(100)};
    const double farthest = wall_m / std::cos(half_opening);
    for (int bin = 0; bin < 100; ++bin) {
        const double low = std::max(0.04 * bin, wall_m);
        const double high = std::min(0.04 * (bin + 1), farthest);
        if (!(low < high)) continue;
        image.area[bin] = 1.0F;
        image.echo[bin] = static_cast<float>(2.0 * wall_m / (low + high));
    }
    return image;
}

Scene scene_of_wall() {
    Scene scene = test::empty_scene();
    const auto x = static_cast<float>(wall_m);
    test::add_quad(scene, {x, -3.0F, -3.0F}, {x, 3.0F, -3.0F}, {x, 3.0F, 3.0F}, {x, -3.0F, 3.0F},
                   test::add_material(scene, 1.0F));
    return scene;
}

PointImage points_to(const Scene& scene) {
    return {scene, make_clusters(scene), Caster(scene), cone_at_wall(),
            local_pose(Pose{}, scene.origin)};
}

}  // namespace

TEST_CASE("slices: the image by points is that of a wall") {
    // Its noise is a quarter of the goal of 1 %. If x is normal with the variance s^2, the root of
    // max(x^2 - s^2, 0) has a mean of 0.3 s.
    const std::vector<EdgeBin> edges(100, EdgeBin::not_tested);
    CHECK(points_to(scene_of_wall()).error_of(image_of_wall(), edges) < 0.001);
}

TEST_CASE("slices: the image by points shows errors of single bins") {
    const PointImage points = points_to(scene_of_wall());
    SampledImage image = image_of_wall();
    double signal = 0.0;
    for (std::size_t k = 0; k < image.area.size(); ++k)
        signal += static_cast<double>(image.intensity(k));
    std::vector<EdgeBin> edges(100, EdgeBin::not_tested);
    // Bin 55 is twice as bright, bin 56 is missing, and bin 10 is filled by mistake.
    const auto wrong =
        static_cast<double>(image.intensity(55)) + static_cast<double>(image.intensity(56)) + 1.0;
    image.echo[55] *= 2.0F;
    image.area[56] = 0.0F;
    image.area[10] = 1.0F;
    image.echo[10] = 1.0F;
    CHECK(points.error_of(image, edges) == test::approx(wrong / signal).epsilon(0.02));
    // A bin that rays found filled is right where there are no points.
    edges[10] = EdgeBin::filled;
    CHECK(points.error_of(image, edges) == test::approx((wrong - 1.0) / signal).epsilon(0.02));
}

TEST_CASE("slices: the image by points has slivers") {
    // A strip before the wall fills bin 25 by a ten thousandth of a bin's depth. It is seen at
    // right angles, so its echo is that of a wall.
    Scene scene = scene_of_wall();
    const float x = 1.04F - 4e-6F;
    test::add_quad(scene, {x, 0.0F, 0.0F}, {x, 1e-4F, 0.0F}, {x, 1e-4F, 2e-3F}, {x, 0.0F, 2e-3F},
                   test::add_material(scene, 1.0F));
    SampledImage image = image_of_wall();
    double signal = 1.0;
    for (std::size_t k = 0; k < image.area.size(); ++k)
        signal += static_cast<double>(image.intensity(k));
    const std::vector<EdgeBin> edges(100, EdgeBin::not_tested);
    const PointImage points = points_to(scene);
    CHECK(points.error_of(image, edges) == test::approx(1.0 / signal).epsilon(0.05));
    image.area[25] = 1e-7F;
    image.echo[25] = 1e-7F;
    CHECK(points.error_of(image, edges) < 0.001);
}

TEST_CASE("slices: pieces of triangles lie in one bin each, and leave nothing out") {
    View view = test::fan_view();
    test::Draws draws(2911);
    for (int n = 0; n < 50; ++n) {
        // Corners in view, so that all of the triangle is: this view is convex but for its ranges.
        Scene scene = test::empty_scene();
        std::array<Eigen::Vector3d, 3> corners;
        for (Eigen::Vector3d& corner : corners) {
            const double range = static_cast<double>(draws.between(2.0F, 11.0F));
            const double azimuth = static_cast<double>(draws.between(-0.5F, 0.5F));
            const double elevation = static_cast<double>(draws.between(-0.15F, 0.15F));
            corner = range * direction_of(azimuth, elevation);
        }
        test::add_quad(scene, corners[0].cast<float>(), corners[1].cast<float>(),
                       corners[2].cast<float>(), corners[2].cast<float>(),
                       test::add_material(scene, 1.0F));
        const double area = 0.5 * (corners[1] - corners[0]).cross(corners[2] - corners[0]).norm();
        const auto pieces =
            bin_pieces(make_clusters(scene), view, local_pose(Pose{}, scene.origin));
        REQUIRE(pieces);
        double sum = 0.0;
        for (std::size_t k = 0; k < pieces->bins.size(); ++k) {
            const int beam = static_cast<int>(pieces->bins[k]) / view.range_bins;
            const int bin = static_cast<int>(pieces->bins[k]) % view.range_bins;
            for (std::uint32_t i = pieces->begin[k]; i < pieces->begin[k + 1]; ++i) {
                const BinPiece& piece = pieces->pieces[i];
                sum += static_cast<double>(piece.area_m2);
                for (const Eigen::Vector3f& corner : piece.corners) {
                    const auto p = corner.cast<double>().eval();
                    const double at = (p.norm() - view.range_min_m) / view.bin_m() - bin;
                    const double across =
                        (std::atan2(p.y(), p.x()) / view.azimuth_rad + 0.5) * view.beams - beam;
                    CHECK(std::fabs(at - 0.5) < 0.52);
                    CHECK(std::fabs(across - 0.5) < 0.52);
                }
            }
        }
        CHECK(sum == test::approx(area).epsilon(1e-4));
    }
}

TEST_CASE("slices: triangles that touch the view's border from outside have no pieces") {
    // One corner is on the border of the outermost beam within rounding; the others lie up to ten
    // beams beyond it.
    const View view = test::fan_view();
    const double beam_rad = view.azimuth_rad / view.beams;
    test::Draws draws(3011);
    for (int n = 0; n < 100; ++n) {
        Scene scene = test::empty_scene();
        const double side = n % 2 == 0 ? 1.0 : -1.0;
        std::array<Eigen::Vector3d, 3> corners;
        for (std::size_t k = 0; k < corners.size(); ++k) {
            const double range = static_cast<double>(draws.between(2.0F, 9.0F));
            const double elevation = static_cast<double>(draws.between(-0.05F, 0.05F));
            const auto beyond = static_cast<double>(k == 0 ? draws.between(-5e-5F, 5e-5F)
                                                           : draws.between(0.5F, 10.0F));
            const double azimuth = side * (0.5 * view.azimuth_rad + beyond * beam_rad);
            corners[k] = range * direction_of(azimuth, elevation);
        }
        test::add_quad(scene, corners[0].cast<float>(), corners[1].cast<float>(),
                       corners[2].cast<float>(), corners[2].cast<float>(),
                       test::add_material(scene, 1.0F));
        const auto pieces =
            bin_pieces(make_clusters(scene), view, local_pose(Pose{}, scene.origin));
        REQUIRE(pieces);
        double sum = 0.0;
        for (const BinPiece& piece : pieces->pieces)
            sum += static_cast<double>(piece.area_m2);
        // Within 1e-4 beams of a corner, a triangle of 40 m^2 has less than 1e-6 m^2.
        CHECK(sum < 1e-6);
    }
}

TEST_SUITE_END();
