#include <doctest/doctest.h>

#include <cmath>

#include "sonar/sonar.h"
#include "support/sanitized.h"
#include "support/scenes.h"
#include "support/sonars.h"
#include "visibility/octree/leaf_samples.h"
#include "visibility/octree/octree_engine.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("visibility");

// The octree must not show hidden surface, neither just behind the limb of a surface nor through
// the gaps between the patches of nearer surface.

namespace {

constexpr float sphere_radius_m = 0.5F;

/// The share of nonzero pixels that lie beyond the limb of a sphere `distance_m` ahead. Every line
/// that touches the sphere is sqrt(d^2 - R^2) long, so the limb has that range in all beams. A leaf
/// at the limb extends beyond it by half its edge.
double lit_beyond_limb(float distance_m, double leaf_m) {
    Scene scene = test::empty_scene();
    test::add_sphere(scene, {distance_m, 0.1F, 0.05F}, sphere_radius_m,
                     test::add_material(scene, 0.8F), 256);
    SonarConfig config = test::small_imaging();
    config.range_bins = 512;
    const Sonar sonar = test::noise_free(config);
    const Ping ping =
        render_ping(sonar, scene, *make_octree_engine(scene, {leaf_m}), Pose{}, {1, 0});
    const double centre_m = Eigen::Vector3f(distance_m, 0.1F, 0.05F).norm();
    const double limb_m = std::sqrt(centre_m * centre_m - sphere_radius_m * sphere_radius_m);
    double occupied = 0.0;
    double beyond = 0.0;
    for (std::size_t k = 0; k < ping.intensity.size(); ++k) {
        if (ping.intensity[k] == 0.0F) continue;
        occupied += 1.0;
        beyond += sonar.range_edges_m[k / ping.beams] > limb_m + 0.5 * leaf_m;
    }
    REQUIRE(occupied > 0.0);
    return beyond / occupied;
}

/// An upright square across the boresight, of material 0.
void add_plate(Scene& scene, float x, float half_size) {
    const float h = half_size;
    test::add_quad(scene, {x, -h, -h}, {x, h, -h}, {x, h, h}, {x, -h, h}, 0);
}

Sample sample_at(const Eigen::Vector3f& position, const Eigen::Vector3f& normal) {
    Sample sample{};
    sample.position = position;
    sample.normal = normal;
    sample.height_m = -normal.dot(position);
    sample.area_m2 = 1.0F;
    return sample;
}

std::size_t seen(const Scene& scene, const Sample& sample, float thickness_m) {
    const Caster caster(scene);
    const LocalPose pose{Eigen::Matrix3f::Identity(), Eigen::Vector3f::Zero()};
    return in_sight(caster, pose, 10.0F, std::vector{sample}, std::vector{thickness_m}).size();
}

}  // namespace

TEST_CASE("octree limb: a sphere ends at its limb, however small the leaves" *
          doctest::skip(test::sanitized)) {
    // Measured: 0 to 1.5 %, from leaves across the limb.
    for (const float distance_m : {2.0F, 4.0F, 8.0F}) {
        for (const double leaf_m : {0.08, 0.04, 0.02, 0.01}) {
            CAPTURE(distance_m);
            CAPTURE(leaf_m);
            CHECK(lit_beyond_limb(distance_m, leaf_m) < 0.02);
        }
    }
}

TEST_CASE("octree sight lines: a plate hides what lies behind it, by as little as a thickness") {
    Scene scene = test::empty_scene();
    test::add_material(scene, 0.5F);
    add_plate(scene, 5.0F, 1.0F);
    const Eigen::Vector3f towards(-1, 0, 0);
    CHECK(seen(scene, sample_at({5.0F, 0, 0}, towards), 0.0F) == 1);
    CHECK(seen(scene, sample_at({4.9F, 0, 0}, towards), 0.0F) == 1);
    CHECK(seen(scene, sample_at({5.001F, 0.3F, 0}, towards), 0.0F) == 0);
    CHECK(seen(scene, sample_at({5.001F, 0.3F, 0}, towards), 0.002F) == 1);
    CHECK(seen(scene, sample_at({6.0F, 3.0F, 0}, towards), 0.0F) == 1);
}

TEST_CASE("octree sight lines: no part of a plane hides another, however flat it is seen") {
    for (const float height_m : {1.0F, 1e-3F, 1e-5F}) {
        Scene scene = test::empty_scene();
        test::add_floor(scene, 30.0F, -height_m, test::add_material(scene, 0.5F), 20);
        for (const float x : {0.5F, 3.1F, 9.7F}) {
            CAPTURE(height_m);
            CHECK(seen(scene, sample_at({x, 0.3F, -height_m}, {0, 0, 1}), 0.0F) == 1);
        }
    }
}

TEST_SUITE_END();
