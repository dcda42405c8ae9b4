#include "visibility/slices/adaptive_slices.h"

#include <doctest/doctest.h>

#include "support/scenes.h"
#include "visibility/slices/clusters.h"
#include "visibility/slices/fixtures.h"
#include "visibility/slices/slice_frames.h"

using namespace sonarsim;
using test::fan_view;

namespace {

/// The number of slices that a fan needed, and the remaining error.
struct Walk {
    std::size_t slices = 0;
    SliceError sum;
};

Walk walk(const Scene& scene, double max_share) {
    const View view = fan_view();
    const ClusterMesh mesh = make_clusters(scene);
    const LocalPose pose{Eigen::Matrix3f::Identity(), Eigen::Vector3f::Zero()};
    Walk out;
    for (const SliceFrame& frame : slice_frames(view, 1)) {
        FrameScan scan(mesh, scene, frame, pose, static_cast<float>(view.range_max_m));
        AdaptiveSlices agreeing(view, scene.materials, scan);
        while (agreeing.scan_next(max_share))
            out.slices += agreeing.slices().size();
        out.sum.difference += agreeing.sum().difference;
        out.sum.signal += agreeing.sum().signal;
    }
    return out;
}

/// A wall, where slices agree, and leaning rods in front of half of it, where they do not.
Scene wall_and_rods() {
    Scene scene = test::empty_scene();
    const std::uint32_t rock = test::add_material(scene, 0.5F);
    test::add_quad(scene, {9, -8, -4}, {9, 8, -4}, {9, 8, 4}, {9, -8, 4}, rock);
    for (int k = 0; k < 12; ++k) {
        const float x = 5.0F + 0.3F * static_cast<float>(k * 5 % 7);
        const float y = 0.4F + 0.25F * static_cast<float>(k);
        test::add_quad(scene, {x, y, -2}, {x, y + 0.05F, -2}, {x + 0.8F, y + 0.65F, 2},
                       {x + 0.8F, y + 0.6F, 2}, rock);
    }
    return scene;
}

}  // namespace

TEST_SUITE_BEGIN("slices");

TEST_CASE("slices: neighbours differ by the given share of the signal at most") {
    const Scene scene = wall_and_rods();
    for (const double share : {0.01, 0.03}) {
        CAPTURE(share);
        const Walk all = walk(scene, share);
        CHECK(all.slices > walk(scene, 2.0 * share).slices);
        CHECK(all.sum.difference <= share * all.sum.signal);
        CHECK(all.sum.difference > 0.1 * share * all.sum.signal);
    }
    // On a wall alone all slices agree, so the number is the initial one.
    Scene wall = test::empty_scene();
    test::add_quad(wall, {9, -8, -4}, {9, 8, -4}, {9, 8, 4}, {9, -8, 4},
                   test::add_material(wall, 0.5F));
    std::size_t least = 0;
    for (const SliceFrame& frame : slice_frames(fan_view(), 1))
        least += frame.slices.size();
    CHECK(walk(wall, 0.01).slices == least);
}

TEST_SUITE_END();
