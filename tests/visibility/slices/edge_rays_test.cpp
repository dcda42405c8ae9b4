#include "visibility/slices/edge_rays.h"

#include <doctest/doctest.h>

#include <cmath>
#include <vector>

#include "core/units.h"
#include "support/approx.h"
#include "support/scenes.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("slices");

namespace {

/// One beam of 40 bins of 10 cm from 0 to 4 m, 1 m above the floor z = -1.
View over_floor() {
    return {.azimuth_rad = radians(20.0),
            .elevation_rad = radians(120.0),
            .range_min_m = 0.0,
            .range_max_m = 4.0,
            .range_bins = 40,
            .beams = 1,
            .relative_l1 = 0.01};
}

/// The place on the floor, straight ahead, at a range in bins.
float ahead_at(double bins) {
    return static_cast<float>(std::sqrt(0.01 * bins * bins - 1.0));
}

/// A strip of floor, 20 cm wide, between two places ahead.
Scene strip_of_floor(float from, float to) {
    Scene scene = test::empty_scene();
    test::add_quad(scene, {from, -0.1F, -1.0F}, {to, -0.1F, -1.0F}, {to, 0.1F, -1.0F},
                   {from, 0.1F, -1.0F}, test::add_material(scene, 1.0F));
    return scene;
}

/// The same as a sample, so narrow that its ranges are those of its middle line.
Samples sample_of_floor(float from, float to) {
    Samples samples;
    Sample sample{};
    sample.position = {0.5F * (from + to), 0.0F, -1.0F};
    sample.edge_u = {0.5F * (to - from), 0.0F, 0.0F};
    sample.edge_v = {0.0F, 0.001F, 0.0F};
    sample.normal = {0.0F, 0.0F, 1.0F};
    sample.height_m = 1.0F;
    sample.area_m2 = 1.0F;
    samples.items.push_back(sample);
    samples.beam_begin = {0, 1};
    return samples;
}

struct Settled {
    std::vector<EdgeBin> edges;
    Samples samples;
    SampledImage image;
};

/// Floor between two ranges, in bins, settled for a sample between two others.
Settled settle(double floor_from, double floor_to, double sample_from, double sample_to) {
    const Scene scene = strip_of_floor(ahead_at(floor_from), ahead_at(floor_to));
    Samples samples = sample_of_floor(ahead_at(sample_from), ahead_at(sample_to));
    const LocalPose pose = local_pose(Pose{}, scene.origin);
    std::vector<EdgeBin> edges = settle_edge_bins(Caster(scene), over_floor(), pose,
                                                  image_of(scene, over_floor(), samples), samples);
    SampledImage image = image_of(scene, over_floor(), samples);
    return {std::move(edges), std::move(samples), std::move(image)};
}

}  // namespace

TEST_CASE("slices: rays empty bins that a sample fills by mistake") {
    // The floor ends within bin 24, and the sample 0.02 bins further, in bin 25; then the same at
    // the near end.
    const Settled far = settle(22.5, 24.99, 22.5, 25.01);
    CHECK(far.edges[25] == EdgeBin::dark);
    CHECK(far.image.area[24] > 0.0F);
    CHECK(far.image.area[25] == 0.0F);
    const Settled near = settle(22.01, 24.5, 21.99, 24.5);
    CHECK(near.edges[21] == EdgeBin::dark);
    CHECK(near.image.area[21] == 0.0F);
    CHECK(near.image.area[22] > 0.0F);
    CHECK(share_in_dark_bins(near.image, near.edges) == 0.0);
}

TEST_CASE("slices: rays fill bins that a sample only just misses") {
    // The floor ends 0.02 bins within bin 25, and the sample 0.001 bins before it.
    const Settled far = settle(22.5, 25.02, 22.5, 24.999);
    CHECK(far.edges[25] == EdgeBin::filled);
    CHECK(far.image.area[25] > 0.0F);
    CHECK(far.image.area[26] == 0.0F);
    const Settled near = settle(21.98, 24.5, 22.001, 24.5);
    CHECK(near.edges[21] == EdgeBin::filled);
    CHECK(near.image.area[21] > 0.0F);
}

TEST_CASE("slices: right ends stay where they are, and other bins are not asked") {
    const Settled right = settle(22.5, 25.05, 22.5, 25.05);
    CHECK(right.edges[25] == EdgeBin::filled);
    CHECK(bins_of(over_floor(), right.samples.items.front()).to ==
          test::approx(25.05).epsilon(1e-4));
    CHECK(right.edges[24] == EdgeBin::not_tested);
    CHECK(right.edges[30] == EdgeBin::not_tested);
}

TEST_CASE("slices: a sample that lies within a bin without surface is removed") {
    // The second sample has a hundredth of the area of the first, behind the floor's end.
    const Scene scene = strip_of_floor(ahead_at(22.5), ahead_at(24.9));
    Samples samples = sample_of_floor(ahead_at(22.5), ahead_at(24.9));
    samples.items.push_back(sample_of_floor(ahead_at(25.2), ahead_at(25.7)).items.front());
    samples.items.back().area_m2 = 0.01F;
    samples.beam_begin = {0, 2};
    settle_edge_bins(Caster(scene), over_floor(), local_pose(Pose{}, scene.origin),
                     image_of(scene, over_floor(), samples), samples);
    CHECK(samples.items.size() == 1);
    CHECK(samples.beam_begin == std::vector<std::uint32_t>{0, 1});
}

TEST_SUITE_END();
