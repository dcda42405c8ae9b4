#include "input/scene/gltf/load.h"
#include "input/scene/gltf/surface_of.h"
#include "input/scene/placing/bottom.h"
#include "input/scene/seabed/seabed.h"
#include "support/statistics.h"

using namespace sonarsim;
using sonarsim::test::ks_p_value;

namespace {

SeabedRule bare_rule(double half_m) {
    SeabedRule rule;
    rule.cell_m = 0.25;
    rule.seed = 21;
    rule.window = {-half_m, -half_m, half_m, half_m};
    return rule;
}

/// The area in which the rocks of a bed lie.
double area_of_heights(const Seabed& bed) {
    const double cell = bed.grid.cell_m;
    return (bed.grid.columns - 1) * cell * (bed.grid.rows - 1) * cell;
}

}  // namespace

TEST_CASE("rocks are a Poisson process with sizes of a power law") {
    SeabedRule rule = bare_rule(30.0);
    rule.rocks = BedRocks{0.7, {0.1, 2.0}, 2.4, {0.1, 0.5}};
    const Seabed bed = make_seabed(rule);
    const double expected = 0.7 * area_of_heights(bed);
    CHECK(std::abs(static_cast<double>(bed.rocks.size()) - expected) < 4.0 * std::sqrt(expected));
    std::vector<double> diameters;
    std::vector<double> buried;
    std::vector<double> x;
    std::vector<double> y;
    for (const Rock& rock : bed.rocks) {
        diameters.push_back(rock.diameter_m);
        buried.push_back(rock.buried);
        x.push_back(rock.T_world_shape.translation().x());
        y.push_back(rock.T_world_shape.translation().y());
    }
    // P(below D) = (a^-q - D^-q) / (a^-q - b^-q).
    const auto law = [](double d) {
        const auto at = [](double z) { return std::pow(z, -2.4); };
        return (at(0.1) - at(d)) / (at(0.1) - at(2.0));
    };
    CHECK(ks_p_value(diameters, law) > 1e-4);
    CHECK(ks_p_value(buried, [](double u) { return (u - 0.1) / 0.4; }) > 1e-4);
    const double half = 0.5 * (bed.grid.columns - 1) * bed.grid.cell_m;
    const auto even = [&](double at) { return (at + half) / (2.0 * half); };
    CHECK(ks_p_value(x, even) > 1e-4);
    CHECK(ks_p_value(y, even) > 1e-4);
    // Counts of squares of 5 m vary as Poisson's do: the index of dispersion of n squares has the
    // deviation sqrt(2 / n).
    Eigen::Array<double, 121, 1> counts = Eigen::Array<double, 121, 1>::Zero();
    for (std::size_t i = 0; i < x.size(); ++i) {
        const int column = static_cast<int>((x[i] + 27.5) / 5.0);
        const int row = static_cast<int>((y[i] + 27.5) / 5.0);
        if (std::abs(x[i]) < 27.5 && std::abs(y[i]) < 27.5) counts[row * 11 + column] += 1.0;
    }
    const double variance = (counts - counts.mean()).square().mean();
    CHECK(std::abs(variance / counts.mean() - 1.0) < 4.0 * std::sqrt(2.0 / 121.0));
}

TEST_CASE("rocks lie in the bed to their share, and their shapes fit a ball of their diameter") {
    SeabedRule rule = bare_rule(20.0);
    rule.z_m = -5.0;
    rule.ripples = BedRipples{0.3, 2.0, 0.4};
    rule.rocks = BedRocks{0.3, {0.05, 4.0}, 1.0, {0.25, 0.25}};
    const Seabed bed = make_seabed(rule);
    REQUIRE(bed.rocks.size() > 100);
    PlacedFile placed_bed{.file = "scene.seabed", .z_up = true};
    placed_bed.seabed = std::make_shared<const Seabed>(bed);
    SceneFiles files;
    const Bottom bottom(surface_of(placed_bed, files, std::vector<std::string>{"seabed"}));
    for (const Rock& rock : bed.rocks) {
        const Surface placed = moved(bed.rock_shapes[rock.shape], rock.T_world_shape);
        const Eigen::Vector3d middle = rock.T_world_shape.translation();
        double farthest = 0.0;
        for (const Eigen::Vector3d& vertex : placed.vertices)
            farthest = std::max(farthest, (vertex - middle).norm());
        CHECK(farthest == test::approx(0.5 * rock.diameter_m));
        const Eigen::AlignedBox3d box = box_of(placed);
        const double bed_z = *bottom.highest(middle.head<2>());
        CHECK((bed_z - box.min().z()) / box.sizes().z() == test::approx(0.25).epsilon(1e-3));
    }
    // Outwards, for the engines that care.
    for (const Surface& shape : bed.rock_shapes) {
        for (std::size_t t = 0; t < shape.triangles.size(); ++t) {
            const auto c = corners_of(shape, t);
            CHECK((c[1] - c[0]).cross(c[2] - c[0]).dot(c[0] + c[1] + c[2]) > 0.0);
        }
    }
}

TEST_CASE("sediments cover their shares, in patches of their size") {
    SeabedRule rule = bare_rule(30.0);
    rule.cell_m = 0.125;
    rule.sediments = {{"mud", 1.0}, {"sand", 2.0}, {"gravel", 1.0}};
    rule.patch_m = 20.0;
    std::array<double, 3> shares{};
    double crossings = 0.0;
    double length_m = 0.0;
    constexpr int beds = 8;
    for (int b = 0; b < beds; ++b) {
        rule.seed = static_cast<std::uint64_t>(b);
        const Seabed bed = make_seabed(rule);
        for (const std::uint8_t sediment : bed.sediments)
            shares[sediment] += 1.0 / (beds * static_cast<double>(bed.sediments.size()));
        for (std::size_t i = 0; i + 1 < bed.sediments.size(); ++i) {
            const int step = bed.sediments[i + 1] - bed.sediments[i];
            const bool same_row = (i + 1) % static_cast<std::size_t>(bed.grid.columns) != 0;
            crossings += same_row && step != 0;
        }
        length_m += bed.grid.rows * (bed.grid.columns - 1) * rule.cell_m;
    }
    // 8 beds have 900 independent places: 4 deviations of 1.4 and 1.7 %.
    CHECK(std::abs(shares[0] - 0.25) < 0.058);
    CHECK(std::abs(shares[1] - 0.5) < 0.067);
    // Rice: a limit at 0.674 deviations is crossed exp(-0.674^2 / 2) / patch times a metre each
    // way, 2.68 times as often by the finer waves of the borders.
    const double expected = 2.0 * 2.0 * 0.797 / 20.0 * 2.68;
    CHECK(crossings / length_m == test::approx(expected).epsilon(0.12));
}

TEST_CASE("a part of a bed is the same bed, bit by bit, and another seed makes another") {
    SeabedRule rule = bare_rule(12.0);
    rule.z_m = -20.0;
    rule.roughness = BedRoughness{1e-4, 3.25, 2.0};
    rule.ripples = BedRipples{0.03, 1.0, 0.5};
    rule.sediments = {{"mud", 1.0}, {"sand", 2.0}};
    rule.rocks = BedRocks{1.0, {0.1, 2.0}, 2.4, {0.1, 0.5}};
    const Seabed whole = make_seabed(rule);
    CHECK(make_seabed(rule).heights == whole.heights);
    rule.window = {-3.03, 1.2, 4.0, 5.0};
    const Seabed part = make_seabed(rule);
    CHECK(part.heights.size() < whole.heights.size() / 4);
    bool same = true;
    for (int row = 0; row < part.grid.rows; ++row) {
        for (int column = 0; column < part.grid.columns; ++column) {
            const std::size_t in_whole =
                whole.grid.cell_at(part.grid.x_m(column), part.grid.y_m(row));
            const std::size_t in_part =
                part.grid.cell_at(part.grid.x_m(column), part.grid.y_m(row));
            same = same && whole.heights[in_whole] == part.heights[in_part] &&
                   whole.sediments[in_whole] == part.sediments[in_part];
        }
    }
    CHECK(same);
    CHECK(part.rocks.size() > 20);
    for (const Rock& rock : part.rocks) {
        const auto same_rock = [&](const Rock& other) {
            return other.diameter_m == rock.diameter_m && other.buried == rock.buried &&
                   other.shape == rock.shape &&
                   other.T_world_shape.matrix() == rock.T_world_shape.matrix();
        };
        CHECK(std::ranges::any_of(whole.rocks, same_rock));
    }
    rule.seed += 1;
    CHECK(make_seabed(rule).heights != part.heights);
}
