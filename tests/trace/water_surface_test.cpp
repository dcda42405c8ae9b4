#include "simulate/trace/multipath.h"
#include "simulate/visibility/rays/rays_engine.h"
#include "support/bounces.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE("ping") {
    TEST_CASE("water surface: the second bottom echo of an echosounder") {
        // Sound goes down, up to the surface d above, down to the bottom h below, and up: half of
        // that, 2 h + d, is the range at nadir. Off nadir by an angle a, in the unfolded world, the
        // second point lies x = (3 h + 2 d) tan a aside, so that the range is
        // ((3 h + 2 d) / cos a + sqrt(h^2 + x^2)) / 2.
        constexpr double h = 5.0;
        constexpr double d = 2.0;
        Scene scene = floor_scene(50.0F, 0.0F, 0.25F, 4);
        scene.water_surface = {h + d, 0.9F};
        const View view{radians(30.0), radians(30.0), 0.5, 20.0, 400, 1, 0.03, ViewShape::cone};
        const Pose down{rotation_from_rpy(0.0, radians(90.0), 0.0), {0.0, 0.0, h}};
        for (const int epsilon : {0, 5}) {
            const auto found = find(scene, view, clusters_of(epsilon), down);
            REQUIRE(found.bounces.size() > 10);
            float nearest = 1e9F;
            for (const BouncePath& b : found.bounces) {
                const Eigen::Vector3d p = found.samples.items[b.sample].position.cast<double>();
                // x along the boresight is down: the angle off nadir is that off x.
                const double tangent = std::hypot(p.y(), p.z()) / p.x();
                const double way = 3.0 * h + 2.0 * d;
                const double range =
                    0.5 * (way * std::sqrt(1.0 + tangent * tangent) + std::hypot(h, way * tangent));
                CHECK(std::fabs(b.range_m - range) < 1e-3);
                nearest = std::min(nearest, b.range_m);
                // R_b, R_s, R_b and the cosine of a mirror: q . v of the last leg.
                CHECK(b.intensity < 0.25F * 0.9F * 0.25F + 1e-6F);
            }
            CHECK(std::fabs(nearest - (2.0 * h + d)) < 0.02);
        }
        // Without a surface nothing comes back, and a sonar above it hears nothing of it.
        scene.water_surface.reset();
        CHECK(find(scene, view, clusters_of(0), down).bounces.empty());
        scene.water_surface = {1.0, 0.9F};
        CHECK(find(scene, view, clusters_of(0), down).bounces.empty());
    }

    TEST_CASE("water surface: the ghost of a wall in the surface") {
        // The sonar looks along x, level, at a wall at x = 6; the surface is 1 m above. Sound goes
        // over the wall to the surface and straight back: the mirror image of the sonar in the
        // wall is at (12, 0, 0), and p is where the line from there meets the surface.
        Scene scene = empty_scene();
        const std::uint32_t wall = add_material(scene, 0.5F);
        add_quad(scene, {6, -9, -9}, {6, 9, -9}, {6, 9, 9}, {6, -9, 9}, wall, 4);
        scene.water_surface = {1.0, 0.8F};
        View view = fan(60.0, 60.0);
        view.range_max_m = 12.0;
        const auto found = find(scene, view, clusters_of(0), {});
        int ghosts = 0;
        for (const BouncePath& b : found.bounces) {
            const Eigen::Vector3d p_i = found.samples.items[b.sample].position.cast<double>();
            const Eigen::Vector3d image(12, 0, 0);
            const Eigen::Vector3d r = p_i - image;
            if (!(r.z() > 0.05)) continue;
            const Eigen::Vector3d p = image + (1.0 / r.z()) * r;
            if (p.x() > 5.99) continue;  // on the far side of the wall
            const double range = 0.5 * ((p - image).norm() + p.norm());
            if (std::fabs(b.range_m - range) > 1e-3) continue;  // an echo over the mirror
            ++ghosts;
            const double cosine =
                -(r - 2.0 * r.z() * Eigen::Vector3d::UnitZ()).normalized().dot(p.normalized());
            CHECK(std::fabs(b.intensity / (0.5 * 0.8 * cosine) - 1.0) < 1e-3);
        }
        CHECK(ghosts > 20);
    }
}
