#include "visibility/slices/quad_samples.h"

#include <doctest/doctest.h>

#include <random>
#include <vector>

#include "support/scenes.h"
#include "visibility/slices/clusters.h"
#include "visibility/slices/drawn_quads.h"
#include "visibility/slices/fixtures.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("slices");

namespace {

View view_of(ViewShape shape) {
    View view = test::fan_view();
    view.shape = shape;
    // A fine goal, so that most quadrilaterals are cut along w, and some across.
    view.relative_l1 = 0.003;
    if (shape == ViewShape::cone) {
        view.azimuth_rad = view.elevation_rad = radians(60.0);
        view.beams = 1;
    }
    return view;
}

/// A long grazing patch that is short along w: it is divided across alone.
Quad grazing_quad(float w) {
    const Eigen::Vector3f normal(0.0F, 0.954F, 0.3F);
    Quad quad{};
    quad.height_m = 0.3F;
    quad.low = {-0.10F, w, w + 0.004F};
    quad.high = {-0.06F, w, w + 0.004F};
    quad.u = quad.low.u;
    quad.w = w;
    quad.q_u = -normal.y() / quad.height_m;
    quad.q_w = -normal.z() / quad.height_m;
    quad.q = quad.q_u * quad.u + quad.q_w * w;
    quad.range_m = {0.0F, 1e4F};
    return quad;
}

/// Passes quadrilaterals on together, or each by itself.
std::vector<Sample> samples_of(const std::vector<Quad>& quads, const FrameScan& scan,
                               const View& view, bool together) {
    std::vector<Sample> out;
    QuadSampler sampler(scan, patch_limits(view), out);
    for (const Quad& quad : quads) {
        sampler.add(quad);
        if (!together) sampler.flush();
    }
    sampler.flush();
    return out;
}

}  // namespace

TEST_CASE("slices: samples of many quadrilaterals are those of each, in their order") {
    Scene scene = test::empty_scene();
    test::add_quad(scene, {3, -2, -1}, {3, 2, -1}, {3, 2, 1}, {3, -2, 1},
                   test::add_material(scene, 0.3F));
    const ClusterMesh mesh = make_clusters(scene);
    for (const ViewShape shape : {ViewShape::fan, ViewShape::cone}) {
        const View view = view_of(shape);
        const SliceFrame frame = slice_frames(view, 1).front();
        const FrameScan scan(mesh, scene, frame, local_pose(Pose{}, scene.origin), 12.0F);
        REQUIRE(!scan.scene().facets.empty());
        std::mt19937 random(4);
        for (int run = 0; run < 60; ++run) {
            std::vector<Quad> quads;
            for (int k = 0; k <= run % 20; ++k) {
                Quad quad = test::draw_quad(random);
                if (k % 3 == 0) quad = grazing_quad(0.001F * static_cast<float>(k));
                quads.push_back(quad);
            }
            const std::vector<Sample> alone = samples_of(quads, scan, view, false);
            const std::vector<Sample> together = samples_of(quads, scan, view, true);
            REQUIRE(alone.size() == together.size());
            CHECK(alone.size() >= quads.size());
            for (std::size_t k = 0; k < alone.size(); ++k) {
                CHECK(alone[k].position == together[k].position);
                CHECK(alone[k].edge_u == together[k].edge_u);
                CHECK(alone[k].area_m2 == together[k].area_m2);
            }
        }
    }
}

TEST_SUITE_END();
