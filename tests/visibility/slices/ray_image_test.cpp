#include "visibility/slices/ray_image.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/units.h"
#include "support/scenes.h"

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

/// The wall by rays, with this noise or less.
RayImage rays_to_wall(double noise) {
    Scene scene = test::empty_scene();
    const auto x = static_cast<float>(wall_m);
    test::add_quad(scene, {x, -3.0F, -3.0F}, {x, 3.0F, -3.0F}, {x, 3.0F, 3.0F}, {x, -3.0F, 3.0F},
                   test::add_material(scene, 1.0F));
    return {scene, Caster(scene), cone_at_wall(), local_pose(Pose{}, scene.origin), noise};
}

}  // namespace

TEST_CASE("slices: the image by rays is that of a wall") {
    const std::vector<EdgeBin> edges(100, EdgeBin::not_asked);
    const RayImage rays = rays_to_wall(0.001);
    CHECK(rays.noise() <= 0.001);
    CHECK(rays.error_of(image_of_wall(), edges) < 0.0005);
    // Less noise takes more rays.
    const RayImage more = rays_to_wall(0.2 * rays.noise());
    CHECK(more.rays() > rays.rays());
    CHECK(more.noise() < rays.noise());
}

TEST_CASE("slices: the image by rays shows errors of single bins") {
    const RayImage rays = rays_to_wall(0.001);
    SampledImage image = image_of_wall();
    double signal = 0.0;
    for (std::size_t k = 0; k < image.area.size(); ++k)
        signal += static_cast<double>(image.intensity(k));
    std::vector<EdgeBin> edges(100, EdgeBin::not_asked);
    // Bin 55 is twice as bright, bin 56 is missing, and bin 10 is filled by mistake.
    const auto wrong =
        static_cast<double>(image.intensity(55)) + static_cast<double>(image.intensity(56)) + 1.0;
    image.echo[55] *= 2.0F;
    image.area[56] = 0.0F;
    image.area[10] = 1.0F;
    image.echo[10] = 1.0F;
    CHECK(rays.error_of(image, edges) == doctest::Approx(wrong / signal).epsilon(0.02));
    // A bin that other rays found filled is right where these have none.
    edges[10] = EdgeBin::filled;
    CHECK(rays.error_of(image, edges) == doctest::Approx((wrong - 1.0) / signal).epsilon(0.02));
}

TEST_SUITE_END();
