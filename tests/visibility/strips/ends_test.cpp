#include "support/draws.h"
#include "visibility/strips/fixtures.h"

TEST_CASE("strips: two materials that meet along an azimuth share the beam as they lie") {
    // A level floor of one material left of an azimuth and of another one right of it: at each
    // range the left part has the share of the beam left of that azimuth.
    const View view = fan_view(2.0, 60.0, 1);
    Draws draws(31);
    for (int k = 0; k < 40; ++k) {
        const float share = k == 0 ? 0.5F : draws.between(0.05F, 0.95F);
        CAPTURE(share);
        const double azimuth = view.azimuth_rad * (0.5 - static_cast<double>(share));
        const Eigen::Vector3f along = direction_of(azimuth, 0.0).cast<float>();
        const Eigen::Vector3f left(-along.y(), along.x(), 0.0F);
        Scene scene = empty_scene();
        const std::uint32_t hard = add_material(scene, 0.9F);
        const std::uint32_t soft = add_material(scene, 0.1F);
        const Eigen::Vector3f near(0.0F, 0.0F, -3.0F);
        const Eigen::Vector3f far = near + 30.0F * along;
        add_quad(scene, near, far, far + 30.0F * left, near + 30.0F * left, hard);
        add_quad(scene, near - 30.0F * left, far - 30.0F * left, far, near, soft);
        // In every other scene a wall stands beyond the floor.
        if (k % 2 == 1) add_rectangle(scene, {11, -9, -3}, {11, 9, 9}, add_material(scene, 0.5F));
        double hard_m2 = 0.0;
        double floor_m2 = 0.0;
        const Samples samples = visible(scene, view, Pose{});
        for (const Sample& sample : samples.items) {
            if (sample.material == hard) hard_m2 += sample.area_m2;
            if (sample.material <= soft) floor_m2 += sample.area_m2;
        }
        CHECK(std::fabs(hard_m2 / floor_m2 - static_cast<double>(share)) < 3e-3);
    }
}

TEST_CASE("strips: a corner that enters the view within a beam is seen") {
    // A leaf below the view whose tip, a fifth of a beam wide, reaches into it.
    const View view = fan_view(60.0, 2.0);
    Draws draws(32);
    for (int k = 0; k < 40; ++k) {
        CAPTURE(k);
        const float beam = 5.0F * static_cast<float>(view.azimuth_rad) / 64.0F;  // at 5 m
        const float low = -5.0F * static_cast<float>(radians(1.0));
        const float y = draws.between(-2.0F, 2.0F);
        const float height = 0.04F;
        const Eigen::Vector3f tip(5.0F, y, low + height);
        const Eigen::Vector3f a(5.0F, y - 5.0F * beam, low - 49.0F * height);
        const Eigen::Vector3f b(5.0F, y + 5.0F * beam, low - 49.0F * height);
        Scene scene = empty_scene();
        add_quad(scene, tip, a, b, b, add_material(scene, 0.5F));
        CHECK(area_of(visible(scene, view, Pose{})) > 0.0);
    }
}

TEST_CASE("strips: a corner of surface and the border of the view is seen") {
    // The farthest point in view: a leaf's leaning edge crosses the upper border within a beam.
    const View view = fan_view(60.0, 2.0);
    Draws draws(33);
    for (int k = 0; k < 40; ++k) {
        CAPTURE(k);
        const float left = draws.between(-1.5F, 1.5F);
        const float lean = draws.between(0.5F, 1.5F);
        const auto on_plane = [&](float y, float z) -> Eigen::Vector3f {
            return {5.0F + 4.0F * z + 2.0F * (y - left), y, z};
        };
        const auto on_edge = [&](float z) -> Eigen::Vector3f {
            return on_plane(left - lean * z, z);
        };
        Scene scene = empty_scene();
        add_quad(scene, on_edge(-0.3F), on_edge(0.3F), on_plane(left - 2.0F, 0.3F),
                 on_plane(left - 2.0F, -0.3F), add_material(scene, 0.5F));
        float low = 0.0F;
        float high = 0.3F;
        for (int step = 0; step < 40; ++step) {
            const Eigen::Vector3f at = on_edge(0.5F * (low + high));
            (std::asin(at.z() / at.norm()) < 0.5 * view.elevation_rad ? low : high) = at.z();
        }
        float farthest = 0.0F;
        for (const Sample& sample : visible(scene, view, Pose{}).items) {
            const Eigen::Vector3f to = sample.position.normalized();
            farthest =
                std::max(farthest, sample.position.norm() + std::fabs(sample.edge_u.dot(to)) +
                                       std::fabs(sample.edge_v.dot(to)));
        }
        CHECK(farthest > on_edge(low).norm() - 0.25F * static_cast<float>(view.bin_m()));
    }
}

TEST_CASE("strips: a cable ends in range where its corners do") {
    // Two cables that meet in a node, so that their mesh is one part.
    View view = fan_view(60.0, 2.0);
    view.range_bins = 1024;
    const auto bin = static_cast<float>(view.bin_m());
    Draws draws(33);
    for (int k = 0; k < 40; ++k) {
        CAPTURE(k);
        Scene scene = empty_scene();
        const std::uint32_t material = add_material(scene, 0.5F);
        const float y = draws.between(-2.0F, 2.0F);
        const Eigen::Vector3f node(7.0F, y, draws.between(-0.3F, 0.0F));
        const float length = draws.between(0.5F, 2.0F);
        const Eigen::Vector3f end =
            node + Eigen::Vector3f(length, draws.between(-0.5F, 0.5F), 0.3F);
        scene.instances.emplace_back("cables");
        for (const Eigen::Vector3f& to : {end, Eigen::Vector3f(5.0F, -y, -3.0F)})
            add_bar(scene, node, to, 0.02F, 6, true, material);
        float farthest = 0.0F;
        for (const Eigen::Vector3f& p : scene.vertices)
            farthest = std::max(farthest, p.norm());
        for (const Sample& sample : visible(scene, view, Pose{}).items) {
            for (const float u : {-1.0F, 1.0F}) {
                for (const float v : {-1.0F, 1.0F}) {
                    const Eigen::Vector3f corner =
                        sample.position + u * sample.edge_u + v * sample.edge_v;
                    CHECK(corner.norm() < farthest + 1.5F * bin);
                }
            }
        }
    }
}
