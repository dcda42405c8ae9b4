#include "simulate/paper/streaks.h"

#include "simulate/sonar/sonar.h"
#include "simulate/visibility/rays/rays_engine.h"
#include "support/test.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE_BEGIN("ping");

TEST_CASE("a row becomes a streak when its share at normal incidence reaches the threshold") {
    RowAreas areas(4);
    areas.all = {1.0F, 1.0F, 1.0F, 0.0F};
    const std::vector<float> normal{0.5F, 0.25F, 0.125F, 0.0F};
    for (std::size_t i = 0; i < normal.size(); ++i)
        areas.normal.begins[i + 1].weight = normal[i];
    const std::vector<float> image{0.5F, 1.5F, 0.2F, -0.5F, 0.3F, 2.0F, 0.4F, 0.4F};
    std::vector<float> added = image;
    CHECK(add_streaks(added, areas, {StreakMode::add, 0.25F, 0.99F}) == 2);
    // 1 - (1 - I)^2 of I in [0, 1]: 0.75, 1 (1.5 clamped), 0.36, 0 (-0.5 clamped).
    const std::vector<float> expected{0.75F, 1.0F, 0.36F, 0.0F, 0.3F, 2.0F, 0.4F, 0.4F};
    for (std::size_t k = 0; k < image.size(); ++k)
        CHECK(std::fabs(added[k] - expected[k]) < 1e-6);
    std::vector<float> reduced = image;
    CHECK(add_streaks(reduced, areas, {StreakMode::reduce, 0.25F, 0.99F}) == 2);
    CHECK(reduced[0] == 0.25F);
    CHECK(reduced[1] == 1.0F);
    CHECK(reduced[5] == 2.0F);
}

TEST_SUITE_END();
