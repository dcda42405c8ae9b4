#include "support/draws.h"
#include "support/maps.h"

TEST_CASE("a footprint has its materials by area, and each its mean factor") {
    // Texels of 0.5 m; footprints of 0.5 to 3 m, of any direction, against a lattice of points.
    Draws draws(2);
    const TexelFrame frame = square_frame(16, 8.0);
    Scene scene;
    scene.instances = {"floor"};
    std::vector<std::uint16_t> choices;
    std::vector<float> factors;
    for (int k = 0; k < 256; ++k) {
        const int choice = draws.whole(0, 2);
        choices.push_back(choice == 2 ? MaterialTexels::own : static_cast<std::uint16_t>(choice));
        factors.push_back(draws.between(0, 4));
    }
    lay(scene, material_texels(frame, {3, 5}, [&](int r, int c) { return choices[16 * r + c]; }),
        strengths(frame, [&](int r, int c) { return factors[16 * r + c]; }));
    double worst = 0.0;
    std::vector<MaterialShare> shares;
    for (int trial = 0; trial < 100; ++trial) {
        const double turn = draws.between(0, 6.3F);
        const double length_m = draws.between(0.25F, 1.5F);
        const double width_m = draws.between(0.02F, 0.1F);
        GroundFootprint footprint;
        footprint.centre.x() = draws.between(-4.5F, 4.5F);
        footprint.centre.y() = draws.between(-4.5F, 4.5F);
        footprint.u = length_m * Eigen::Vector2d(std::cos(turn), std::sin(turn));
        footprint.v = width_m * Eigen::Vector2d(-std::sin(turn), std::cos(turn));
        if (draws.half()) std::swap(footprint.u, footprint.v);
        scene.maps->shares_over(0, 7, footprint, shares);
        std::array<double, 8> area{}, power{};
        constexpr int n = 60;
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                const Eigen::Vector2d p = footprint.centre +
                                          ((2.0 * i + 1.0) / n - 1.0) * footprint.u +
                                          ((2.0 * j + 1.0) / n - 1.0) * footprint.v;
                const MappedPoint point = scene.maps->at(0, 7, p);
                area[point.material] += 1.0 / (n * n);
                power[point.material] += static_cast<double>(point.strength) / (n * n);
            }
        }
        double whole = 0.0;
        for (const MaterialShare& share : shares) {
            whole += share.area;
            worst = std::max({worst, std::fabs(share.area - area[share.material]),
                              0.25 * std::fabs(share.power - power[share.material])});
        }
        CHECK(std::fabs(whole - 1.0) < 1e-5);
        const auto alike = scene.maps->alike_over(0, 7, footprint);
        if (!alike) continue;
        CHECK(shares.size() == 1);
        CHECK(shares.front().material == alike->material);
        CHECK(std::fabs(shares.front().power - static_cast<double>(alike->strength)) < 1e-5);
    }
    CHECK(worst < 0.06);
}
