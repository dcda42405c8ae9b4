#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "sonar/engine_settings.h"
#include "support/approx.h"
#include "hard/tools.h"
#include "visibility/rays/rays_engine.h"

using namespace sonarsim;

TEST_SUITE_BEGIN("hard");

namespace {

/// A view along the floor from `height_m` above it: every bin sees it.
HardTrial along_the_floor(double height_m) {
    HardTrial trial = over_floor(SonarKind::imaging);
    trial.T_world_vehicle = {rotation_from_rpy(0.0, 0.0, 0.1), {0.31, 0.17, height_m}};
    return trial;
}

}  // namespace

TEST_CASE("rays: a floor at ever smaller grazing angles fills every bin with R H / r") {
    const Scene scene = plain_floor();
    for (const double height_m : {2e-2, 2e-3, 2e-4, 2e-5}) {  // 0.1 to 0.0001 degrees at 10 m
        const HardTrial trial = along_the_floor(height_m);
        const std::vector<double>& edges = trial.sonar.range_edges_m;
        const std::vector<float> image = image_of(scene, trial, EngineKind::rays);
        double off = 0.0;
        double total = 0.0;
        const std::size_t beams = trial.sonar.settings.view.beams;
        for (std::size_t k = 0; k < image.size(); ++k) {
            const std::size_t i = k / beams;
            const double truth = 0.5 * height_m / (0.5 * (edges[i] + edges[i + 1]));
            off += std::fabs(image[k] - truth);
            total += truth;
        }
        CAPTURE(height_m);
        CHECK(off < 0.01 * total);
    }
}

TEST_CASE("rays: no sample at grazing incidence is longer than it is far away") {
    const Scene scene = plain_floor();
    const HardTrial trial = along_the_floor(2e-3);
    const Samples samples =
        make_rays_engine(scene)->visible_surface(trial.sonar.settings.view, trial.T_world_vehicle);
    float farthest = 0.0F;
    for (const Sample& sample : samples.items) {
        const float one = (sample.position - sample.edge_v).norm();
        const float other = (sample.position + sample.edge_v).norm();
        farthest = std::max({farthest, one, other});
        CHECK(std::max(one, other) < 2.001F * std::min(one, other));
        CHECK(sample.height_m == test::approx(2e-3).epsilon(1e-3));
    }
    CHECK(farthest > 10.0F);
}

TEST_SUITE_END();
