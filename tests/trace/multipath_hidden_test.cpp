#include "simulate/trace/multipath.h"
#include "simulate/visibility/rays/rays_engine.h"
#include "support/bounces.h"
#include "support/patches.h"

using namespace sonarsim;
using namespace sonarsim::test;

// The sonar sees the second point of a bounce or not: the tracer decides it to within rounding.

namespace {

/// A corner of two walls.
Scene corner() {
    Scene scene = empty_scene();
    const std::uint32_t m = add_material(scene, 0.6F);
    add_quad(scene, {0, 2, -3}, {5, 2, -3}, {5, 2, 3}, {0, 2, 3}, m);
    add_quad(scene, {5, -9, -3}, {5, 2, -3}, {5, 2, 3}, {5, -9, 3}, m);
    return scene;
}

}  // namespace

TEST_SUITE_BEGIN("ping");

TEST_CASE("what hides the second point hides it in a scene of any size") {
    // A corner of two walls, with a screen before where the sound of one meets the other, from a
    // scene of half a millimetre to one of tens of kilometres.
    for (const float scale : {1e-4F, 1.0F, 6000.0F}) {
        CAPTURE(scale);
        Scene scene = corner();
        add_quad(scene, {1, -1, -1}, {1, 0.3F, -1}, {1, 0.3F, 1}, {1, -1, 1}, 0);
        View view = fan(100.0, 12.0);
        const MultipathCounts expected = find(scene, view, clusters_of(0)).counts;
        for (Eigen::Vector3f& p : scene.vertices)
            p *= scale;
        view.range_min_m *= scale;
        view.range_max_m *= scale;
        const MultipathCounts n = find(scene, view, clusters_of(0)).counts;
        CHECK(n.hidden > 100);
        // A few lie on an edge, where rounding decides.
        CHECK(std::fabs(static_cast<double>(n.hidden) - static_cast<double>(expected.hidden)) < 5);
        CHECK(std::fabs(static_cast<double>(n.bounces) - static_cast<double>(expected.bounces)) <
              5);
    }
}

TEST_CASE("what hides the second point hides it however near it is") {
    // The port wall y = 2 has a sample at (4, 2, 0), whose sound meets the front wall x = 5 at
    // y = 1.5, or a little below: the trace starts 0.45 mm off the wall. A fin of 1 cm at y
    // = 1.4985 stands 3.5 mm before that point for the sonar, and is passed by the sound from port.
    Scene scene = corner();
    const View view = fan(100.0, 12.0);
    const Sample sample = [] {
        Sample s = point_facing({4, 2, 0}, 1.0);
        s.normal = {0, -1, 0};
        return s;
    }();
    Samples samples;
    samples.items = {sample};
    const int beam = beam_of(view, sample.position);
    samples.beam_begin.assign(view.beams + 1, 0);
    std::fill(samples.beam_begin.begin() + beam + 1, samples.beam_begin.end(), 1U);
    const auto hidden = [&] {
        MultipathCounts counts;
        const Pose here;
        const auto engine = make_rays_engine(scene);
        find_bounces(clusters_of(0),
                     {.view = view, .scene = scene, .engine = *engine, .T_world_sensor = here},
                     samples, counts);
        CHECK(counts.bounces + counts.hidden == 1);
        return counts.hidden == 1;
    };
    CHECK(!hidden());
    add_quad(scene, {4.99F, 1.4985F, -1}, {5, 1.4985F, -1}, {5, 1.4985F, 1}, {4.99F, 1.4985F, 1},
             0);
    CHECK(hidden());
}

TEST_CASE("rounding hides nothing, wherever the sonar is and however large the triangles are") {
    // In a corner of two walls all that is met is seen. At 30 km from the scene's origin floats are
    // 2 mm apart; walls of 40 km have corners that far away from the sonar. Nothing is parallel to
    // an axis, where there would be less to round.
    const Eigen::Quaterniond R = rotation_from_rpy(0.3, -0.2, 0.5);
    const auto bounces = [&](const Eigen::Vector3d& at, float size, int turn) {
        Scene scene = empty_scene();
        const std::uint32_t m = add_material(scene, 0.6F);
        add_quad(scene, {5 - size, 2, -size}, {5, 2, -size}, {5, 2, size}, {5 - size, 2, size}, m);
        add_quad(scene, {5, 2 - size, -size}, {5, 2, -size}, {5, 2, size}, {5, 2 - size, size}, m);
        for (Eigen::Vector3f& p : scene.vertices)
            p = (R * p.cast<double>() + at).cast<float>();
        const Pose pose{R * rotation_from_rpy(0.2, -0.1, radians(-20.0 + 12.0 * turn)), at};
        const MultipathCounts n = find(scene, fan(120.0, 30.0), clusters_of(0), pose).counts;
        CHECK(n.hidden == 0);
        return static_cast<double>(n.bounces);
    };
    for (int turn = 0; turn < 8; ++turn) {
        const double home = bounces(Eigen::Vector3d::Zero(), 30.0F, turn);
        REQUIRE(home > 1000.0);
        for (const double far : {0.0, 300.0, 30'000.0}) {
            for (const float size : {30.0F, 40'000.0F}) {
                CAPTURE(far);
                CAPTURE(size);
                CHECK(bounces({far, -far, 0.3 * far}, size, turn) > 0.98 * home);
            }
        }
    }
}

TEST_SUITE_END();
