#include "simulate/trace/clusters.h"

#include "support/bounces.h"
#include "support/patches.h"
#include "support/sonars.h"

// The sonar sees the second point of a bounce or not: the tracer decides it to within rounding.

namespace {

Scene rough_seafloor() {
    Scene scene = floor_scene(20.0F, 0.0F, 0.4F, 200);
    for (Eigen::Vector3f& vertex : scene.vertices) {
        const double x = vertex.x();
        const double y = vertex.y();
        vertex.z() = static_cast<float>(
            0.5 * std::sin(0.9 * x + 0.2 * y) + 0.3 * std::sin(1.7 * y + 0.5 * x) +
            0.12 * std::sin(3.1 * x - 2.3 * y) + 0.01 * std::sin(31.0 * x) * std::sin(37.0 * y));
    }
    return scene;
}

/// A corner of two walls.
Scene corner() {
    Scene scene = rectangle_scene({0, 2, -3}, {5, 2, 3}, 0.6F);
    add_rectangle(scene, {5, -9, -3}, {5, 2, 3}, 0);
    return scene;
}

}  // namespace

TEST_CASE("clusters keep their limits, and every sample is in one") {
    const View view = fan(60.0, 12.0);
    const Found found = find(tank(), view, clusters_of(0), tank_poses()[0]);
    const Samples& samples = found.samples;
    const float cosine = static_cast<float>(std::cos(radians(15.0)));
    const Clusters clusters = cluster_samples(view, samples, {5, cosine});
    CHECK(clusters.size() < samples.items.size() / 2);
    std::set<std::uint32_t> visible;
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        const auto members = clusters.of(c);
        const Sample& first = samples.items[members[0]];
        for (const std::uint32_t i : members) {
            const Sample& s = samples.items[i];
            CHECK(visible.insert(i).second);
            CHECK(s.normal.dot(first.normal) >= cosine);
            CHECK(std::fabs(s.position.norm() - first.position.norm()) < 5.0 * view.bin_m());
            CHECK(std::abs(beam_of(view, s.position) - beam_of(view, first.position)) < 5);
        }
    }
    CHECK(std::ranges::count_if(samples.items, [&](const Sample& s) {
              return s.position.norm() < view.range_max_m;
          }) == std::ssize(visible));
}

TEST_CASE("clusters light the bins that the exact method lights") {
    struct Tally {
        int exact = 0, missed = 0, wrong = 0;
        std::uint64_t rays = 0, exact_rays = 0;
    };
    SonarConfig config = small_imaging();
    config.range_bins = 512;
    config.azimuth_bins = 256;
    // Poses by rule, not by choice, and the bins of all of them together. Single poses do worse: of
    // the 43 that see multipath in the tank, k = 6, 28 and 48 have 7, 14 and 5 % of false bins.
    const auto compare = [&](const Scene& scene, const std::function<double(int)>& z_m) {
        Tally tally;
        const auto engine = make_rays_engine(scene);
        for (int k = 0; k < 60; ++k) {
            const Pose pose{rotation_from_rpy(0.0, radians(6.0 + 4.0 * (k % 5)), radians(37.0 * k)),
                            {2.5 * std::sin(1.3 * k), 1.8 * std::cos(2.1 * k), z_m(k)}};
            const auto by = [&](MultipathMethod method) {
                config.multipath = {method, 5, 5.0};
                return render_ping(noise_free(config), scene, *engine, pose, {}, multipath_alone);
            };
            const Ping exact = by(MultipathMethod::exact);
            const Ping cluster = by(MultipathMethod::cluster);
            for (std::size_t i = 0; i < exact.intensity.size(); ++i) {
                const bool is = cluster.intensity[i] > 0.0F;
                const bool should = exact.intensity[i] > 0.0F;
                tally.exact += should;
                tally.missed += should && !is;
                tally.wrong += is && !should;
            }
            tally.rays += cluster.counts.multipath.rays;
            tally.exact_rays += exact.counts.multipath.rays;
        }
        return tally;
    };
    const Tally in_tank = compare(tank(), [](int) { return 1.5; });
    config.range_max_m = 15.0;
    const Tally at_sea = compare(rough_seafloor(), [](int k) { return 1.3 + 0.35 * (k % 4); });
    for (const Tally& tally : {in_tank, at_sea}) {
        CHECK(tally.exact > 200);
        CHECK(tally.missed < 0.05 * tally.exact);
        CHECK(tally.wrong < 0.05 * (tally.exact - tally.missed + tally.wrong));
        CHECK(2 * tally.rays < tally.exact_rays);
    }
}

TEST_CASE("what hides the second point hides it in a scene of any size") {
    // A corner of two walls, with a screen before where the sound of one meets the other, from a
    // scene of half a millimetre to one of tens of kilometres.
    for (const float scale : {1e-4F, 1.0F, 6000.0F}) {
        CAPTURE(scale);
        Scene scene = corner();
        add_rectangle(scene, {1, -1, -1}, {1, 0.3F, 1}, 0);
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
    Samples samples;
    samples.items = {point_facing({4, 2, 0}, 1.0)};
    samples.items[0].normal = {0, -1, 0};
    const int beam = beam_of(view, samples.items[0].position);
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
    add_rectangle(scene, {4.99F, 1.4985F, -1}, {5, 1.4985F, 1}, 0);
    CHECK(hidden());
}

TEST_CASE("rounding hides nothing, wherever the sonar is and however large the triangles are") {
    // In a corner of two walls all that is met is seen. At 30 km from the scene's origin floats are
    // 2 mm apart; walls of 40 km have corners that far away from the sonar. Nothing is parallel to
    // an axis, where there would be less to round.
    const Eigen::Quaterniond R = rotation_from_rpy(0.3, -0.2, 0.5);
    const auto bounces = [&](const Eigen::Vector3d& at, float size, int turn) {
        Scene scene = rectangle_scene({5 - size, 2, -size}, {5, 2, size}, 0.6F);
        add_rectangle(scene, {5, 2 - size, -size}, {5, 2, size}, 0);
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
                CAPTURE_ALL(far, size);
                CHECK(bounces({far, -far, 0.3 * far}, size, turn) > 0.98 * home);
            }
        }
    }
}
