#include "visibility/slices/check_beams.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "support/approx.h"
#include "support/sanitized.h"
#include "support/scenes.h"
#include "visibility/slices/clusters.h"
#include "visibility/slices/fixtures.h"

using namespace sonarsim;
using test::fan_view;

namespace {

/// A fan that looks at rods at random places before a wall.
Scene random_rods(std::mt19937& random) {
    Scene scene = test::empty_scene();
    const std::uint32_t rock = test::add_material(scene, 0.5F);
    test::add_quad(scene, {9, -8, -4}, {9, 8, -4}, {9, 8, 4}, {9, -8, 4}, rock);
    std::uniform_real_distribution<float> any(0.0F, 1.0F);
    for (int k = 0; k < 40; ++k) {
        const float x = 4.0F + 4.0F * any(random);
        const float y = 8.0F * any(random) - 4.0F;
        const float thick = 0.01F + 0.04F * any(random);
        const float lean = 2.0F * any(random) - 1.0F;
        test::add_quad(scene, {x, y, -2}, {x, y + thick, -2}, {x + 0.5F, y + lean + thick, 2},
                       {x + 0.5F, y + lean, 2}, rock);
    }
    return scene;
}

/// A view of a scene that is to be swept.
struct UnsweptView {
    View view = fan_view();
    ClusterMesh mesh;
    SlicesPing ping;
    std::vector<SliceFrame> frames;
    SlicesImage image;

    explicit UnsweptView(const Scene& scene)
        : mesh(make_clusters(scene)),
          ping{mesh, scene, view, {Eigen::Matrix3f::Identity(), {0, 0, 0}}},
          frames(slice_frames(view, 1)),
          image(view) {}

    UnsweptView(const UnsweptView&) = delete;
    UnsweptView& operator=(const UnsweptView&) = delete;
};

/// A swept view, whose beams are not checked yet.
struct SweptView : UnsweptView {
    std::deque<SweptFrame> swept;

    explicit SweptView(const Scene& scene) : UnsweptView(scene) {
        for (const SliceFrame& frame : frames)
            swept.emplace_back(ping, frame, image);
        image.errors.finish();
    }

    std::size_t uncertain() const {
        std::size_t count = 0;
        for (const SweptFrame& frame : swept)
            count += frame.uncertain().size();
        return count;
    }
};

Sample sample_of(std::uint32_t instance) {
    Sample sample{};
    sample.instance = instance;
    return sample;
}

}  // namespace

TEST_SUITE_BEGIN("slices");

TEST_CASE("slices: the first draw estimates the distance of all beams without bias") {
    // The mean over n scenes of the estimate less the truth is normal, nearly. Its variance is that
    // of the differences over n. 4 standard deviations: 1 of 16,000.
    std::mt19937 random(11);
    const int scenes = test::sanitized ? 15 : 100;
    double sum = 0.0;
    double squares = 0.0;
    double truth = 0.0;
    for (int i = 0; i < scenes; ++i) {
        const Scene scene = random_rods(random);
        UnsweptView all(scene);
        sweep_and_check(all.ping, all.frames, all.image);
        SweptView some(scene);
        CHECK(all.image.checked.size() == some.uncertain());
        BeamErrors& errors = some.image.errors;
        check_drawn(some.swept, std::numeric_limits<double>::max(), errors);
        CHECK(some.image.checked.size() < all.image.checked.size());
        const double of_all = all.image.errors.of_checked();
        const double change = errors.of_checked() + errors.of_others() - of_all;
        sum += change;
        squares += change * change;
        truth += of_all;
    }
    CHECK(std::fabs(sum) < 4.0 * std::sqrt(squares));
    CHECK(std::sqrt(squares) < 0.3 * truth);  // else the test could hardly fail
}

TEST_CASE("slices: checks in the sweep and checks of kept slices give the same") {
    std::mt19937 random(13);
    for (int i = 0; i < (test::sanitized ? 2 : 10); ++i) {
        const Scene scene = random_rods(random);
        UnsweptView all(scene);
        sweep_and_check(all.ping, all.frames, all.image);
        SweptView kept(scene);
        for (SweptFrame& frame : kept.swept) {
            for (std::size_t k = 0; k < frame.uncertain().size(); ++k)
                frame.check(k, 1.0);
        }
        const BeamErrors& a = all.image.errors;
        const BeamErrors& b = kept.image.errors;
        CHECK(a.of_checked() == test::approx(b.of_checked()).epsilon(1e-12));
        CHECK(a.edge_bins() == test::approx(b.edge_bins()).epsilon(1e-12));
        REQUIRE(all.image.checked == kept.image.checked);
        const auto& one = all.image.checked_samples.items();
        const auto& other = kept.image.checked_samples.items();
        REQUIRE(one.size() == other.size());
        const auto same = [](const Sample& x, const Sample& y) {
            return x.position == y.position && x.area_m2 == y.area_m2;
        };
        CHECK(std::ranges::equal(one, other, same));
    }
}

TEST_CASE("slices: beams are drawn until the estimate meets the goal, or checks cannot meet it") {
    std::mt19937 random(12);
    std::size_t coarse = 0;
    std::size_t fine = 0;
    for (int i = 0; i < 10; ++i) {
        const Scene scene = random_rods(random);
        for (const double goal : {0.1, 0.05, 0.03, 0.02, 0.001}) {
            CAPTURE(goal);
            SweptView one(scene);
            const BeamErrors& errors = one.image.errors;
            check_drawn(one.swept, goal, one.image.errors);
            const std::size_t checks = one.image.checked.size();
            const bool met = estimated_error(errors) <= goal;
            CHECK((met || checks == one.uncertain() || likely_error_if_checked(errors) > goal));
            if (goal == 0.1) coarse += checks;
            if (goal == 0.02) fine += checks;
        }
    }
    CHECK(coarse < fine);
}

TEST_CASE("slices: samples of checked beams replace those of the scan, in the order of beams") {
    SlicesImage image(fan_view());
    Samples& samples = image.samples;
    samples.items = {sample_of(1), sample_of(2), sample_of(3)};
    samples.beam_begin = {0, 2, 3, 3, 3};
    // Beam 2 was empty; two frames share it. Beam 0 gets one sample.
    image.checked = {2, 0, 2};
    const auto add = [&](std::initializer_list<std::uint32_t> instances) {
        for (const std::uint32_t instance : instances)
            image.checked_samples.items().push_back(sample_of(instance));
        image.checked_samples.end_row();
    };
    add({21, 22});
    add({11});
    add({23});
    replace_checked(true, image);
    CHECK(samples.beam_begin == std::vector<std::uint32_t>{0, 1, 2, 5, 5});
    std::vector<std::uint32_t> instances;
    for (const Sample& sample : samples.items)
        instances.push_back(sample.instance);
    CHECK(instances == std::vector<std::uint32_t>{11, 3, 21, 22, 23});
    REQUIRE(samples.compared.size() == 2);
    CHECK(samples.compared[0].beam == 0);
    CHECK(samples.compared[0].one.size() == 2);
    CHECK(samples.compared[0].other.size() == 1);
    CHECK(samples.compared[1].beam == 2);
    CHECK(samples.compared[1].one.empty());
    CHECK(samples.compared[1].other.size() == 3);
}

TEST_SUITE_END();
