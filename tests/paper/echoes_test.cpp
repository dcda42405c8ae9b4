#include "simulate/paper/echoes.h"

#include "support/patches.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

Echoes echoes_of(const Eigen::Vector3f& centre, const Eigen::Vector3f& edge_u,
                 const Eigen::Vector3f& edge_v, float bin_m) {
    Sample sample = patch_of(centre, -centre.normalized(), edge_u, edge_v);
    sample.area_m2 = 0.5F;
    Material material;
    material.reflection = 0.25F;
    Echoes echoes;
    std::vector<std::uint32_t> ends;
    direct_echoes({&sample, 1}, {&material, 1}, bin_m, {}, echoes, &ends);
    return echoes;
}

}  // namespace

TEST_SUITE_BEGIN("ping");

TEST_CASE("echoes: a sample without edges is one echo without extent") {
    // The paper's literal leaves are points.
    const Echoes echoes = echoes_of({3, 0, 4}, {0, 0, 0}, {0, 0, 0}, 0.1F);
    REQUIRE(echoes.size() == 1);
    CHECK(echoes.range_m[0] == 5.0F);
    CHECK(echoes.half_m[0] == 0.0F);
    CHECK(echoes.weight[0] == 0.5F);
    CHECK(echoes.intensity[0] == 0.25F);
}

TEST_CASE("echoes: a piece reaches from its nearest to its farthest corner") {
    // Half edges along and across the line of sight, in bins so long that nothing is cut. Along,
    // range is linear: 5 -+ 0.2. Across it is sqrt(25 + s^2), which reaches from 5 to 5 + 0.3^2
    // / 10.
    for (const float along : {0.0F, 0.2F}) {
        for (const float across : {0.0F, 0.3F}) {
            const Echoes echoes = echoes_of({5, 0, 0}, {along, 0, 0}, {0, across, 0}, 10.0F);
            REQUIRE(echoes.size() == 1);
            const float nearest = echoes.range_m[0] - echoes.half_m[0];
            const float farthest = echoes.range_m[0] + echoes.half_m[0];
            CHECK(nearest == test::approx(5.0 - along).epsilon(1e-6));
            CHECK(farthest == test::approx(5.0 + along + 0.1 * across * across).epsilon(1e-6));
        }
    }
}

TEST_SUITE_END();
