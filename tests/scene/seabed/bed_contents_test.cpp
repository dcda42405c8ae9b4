#include "input/scene/gltf/load.h"
#include "input/scene/placing/bottom.h"
#include "input/scene/seabed/bed_model.h"
#include "support/seabed.h"
#include "support/statistics.h"

namespace {

SeabedRule bare_rule(double half_m) {
    SeabedRule rule;
    rule.cell_m = 0.25;
    rule.seed = 21;
    rule.window = {-half_m, -half_m, half_m, half_m};
    return rule;
}

}  // namespace

TEST_CASE("rocks are a Poisson process with sizes of a power law") {
    SeabedRule rule = bare_rule(30.0);
    rule.rocks = BedRockConfig{0.7, {0.1, 2.0}, 2.4, {0.1, 0.5}};
    const Seabed bed = make_seabed(rule);
    // The rocks lie between the heights, in a square.
    const double half = 0.5 * (bed.grid.columns - 1) * bed.grid.cell_m;
    const double expected = 0.7 * 4.0 * half * half;
    CHECK(std::abs(static_cast<double>(bed.rocks.size()) - expected) < 4.0 * std::sqrt(expected));
    std::vector<double> diameters, buried, x, y;
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
    const auto even = [&](double at) { return (at + half) / (2.0 * half); };
    CHECK(ks_p_value(x, even) > 1e-4);
    CHECK(ks_p_value(y, even) > 1e-4);
    // Counts of squares of 5 m are Poisson's: the index of n squares has the deviation sqrt(2 / n).
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
    rule.ripples = BedRippleConfig{0.3, 2.0, 23.0};
    rule.rocks = BedRockConfig{0.3, {0.05, 4.0}, 1.0, {0.25, 0.25}};
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
        CHECK(farthest == approx(0.5 * rock.diameter_m));
        const Eigen::AlignedBox3d box = box_of(placed);
        const double bed_z = *bottom.highest(middle.head<2>());
        CHECK((bed_z - box.min().z()) / box.sizes().z() == approx(0.25).epsilon(1e-3));
    }
    // Outwards, for the engines that care.
    for (const Surface& shape : bed.rock_shapes) {
        for (std::size_t t = 0; t < shape.triangles.size(); ++t) {
            const auto c = corners_of(shape, t);
            CHECK((c[1] - c[0]).cross(c[2] - c[0]).dot(c[0] + c[1] + c[2]) > 0.0);
        }
    }
}

TEST_CASE("sediments cover their shares, in patches of all sizes") {
    SeabedRule rule = bare_rule(30.0);
    rule.cell_m = 0.125;
    rule.sediments = {{"mud", 1.0}, {"sand", 2.0}, {"gravel", 1.0}};
    rule.patch_m = 2.0;
    constexpr std::array<int, 4> lags{1, 8, 16, 32};  // 0.125, 1, 2 and 4 m
    std::array<double, 4> products{};
    std::array<double, 3> shares{};
    double squares = 0.0;
    double crossings = 0.0;
    double pairs = 0.0;
    constexpr int beds = 8;
    for (int b = 0; b < beds; ++b) {
        rule.seed = static_cast<std::uint64_t>(b);
        const Seabed bed = make_seabed(rule);
        const std::vector<std::uint8_t>& cells = bed.sediments.cells;
        const Eigen::Map<const Eigen::ArrayXXf> values(bed.sediments.values.data(),
                                                       bed.grid.columns, bed.grid.rows);
        for (const std::uint8_t sediment : cells)
            shares[sediment] += 1.0 / (beds * static_cast<double>(cells.size()));
        for (std::size_t i = 0; i + 1 < cells.size(); ++i) {
            const int step = cells[i + 1] - cells[i];
            const bool same_row = (i + 1) % static_cast<std::size_t>(bed.grid.columns) != 0;
            crossings += same_row && step != 0;
        }
        pairs += bed.grid.rows * (bed.grid.columns - 1);
        squares += static_cast<double>(values.square().mean());
        for (std::size_t k = 0; k < lags.size(); ++k) {
            const auto count = values.rows() - lags[k];
            products[k] +=
                static_cast<double>((values.topRows(count) * values.bottomRows(count)).mean());
        }
    }
    // 8 beds have some 500 independent places of the longest waves: 4 deviations of 1.9 and 2.2 %.
    CHECK(std::abs(shares[0] - 0.25) < 0.077);
    CHECK(std::abs(shares[1] - 0.5) < 0.09);
    const auto correlation = [&](double lag_m) {
        double variance = 0.0;
        double sum = 0.0;
        for (double wave_m = 16.0; wave_m >= 4.0 * rule.cell_m; wave_m *= 0.5) {
            const double power = std::pow(std::min(wave_m / rule.patch_m, 1.0), 1.5);
            variance += power;
            sum += power * std::exp(-0.5 * std::pow(2.0 * pi * lag_m / wave_m, 2.0));
        }
        return sum / variance;
    };
    for (std::size_t k = 0; k < lags.size(); ++k) {
        CAPTURE(lags[k]);
        CHECK(std::abs(products[k] / squares - correlation(lags[k] * rule.cell_m)) < 0.1);
    }
    CHECK(products[2] / squares > 0.1);  // one wavelength would leave 1e-9
    // Neighbours of the correlation c lie on both sides of 0 with the probability acos(c) / pi, and
    // of a limit at 0.674 deviations exp(-0.674^2 / 2) times as often.
    const double expected = 2.0 * 0.797 * std::acos(correlation(rule.cell_m)) / pi;
    CHECK(crossings / pairs == approx(expected).epsilon(0.12));
}

TEST_CASE("sediments border where their field crosses a limit, and leave the bed's shape") {
    SeabedRule rule = bare_rule(12.0);
    rule.roughness = BedRoughnessConfig{0.003, 3.25, 2.0};
    rule.patch_m = 5.0;
    const Seabed plain = make_seabed(rule);
    rule.sediments = {{"mud", 4.0}, {"silt", 1.0}, {"sand", 3.0}, {"gravel", 4.0}};
    const Seabed bed = make_seabed(rule);
    REQUIRE(bed.heights == plain.heights);
    const BedGround ground = ground_of(bed);
    const auto& vertices = ground.vertices;  // clang 14 captures no structured bindings
    const auto& corners = ground.corners;
    const std::vector<BedMixture> mixtures = mixtures_of(bed);
    REQUIRE(corners.size() == 4 + mixtures.size());
    CHECK(mixtures[5].name == "silt + 40 % sand");
    CHECK(mixtures[6].name == "sand + 40 % silt");
    const auto sediment_of = [&](std::size_t i) {
        return i < 4 ? i : mixtures[i - 4].first + (mixtures[i - 4].share > 0.5 ? 1 : 0);
    };
    const auto vertex = [&](std::uint32_t i) {
        return Eigen::Vector3d(vertices[3 * i], vertices[3 * i + 1], vertices[3 * i + 2]);
    };
    std::array<double, 4> areas{};
    double volume = 0.0;
    using Edge = std::pair<std::uint32_t, std::uint32_t>;
    std::map<Edge, std::size_t> edges;  // from, to; its sediment
    float last_mean = -1e9F;
    for (std::size_t group = 0; group < corners.size(); ++group) {
        const std::size_t m = sediment_of(group);
        float sum = 0.0F;
        float whole = 0.0F;  // corners that are heights
        for (std::size_t i = 0; i < corners[group].size(); i += 3) {
            const std::uint32_t* c = &corners[group][i];
            for (std::size_t k = 0; k < 3; ++k) {
                if (c[k] >= bed.heights.size()) continue;
                sum += bed.sediments.values[c[k]];
                whole += 1.0F;
            }
            const Eigen::Vector3d up =
                (vertex(c[1]) - vertex(c[0])).cross(vertex(c[2]) - vertex(c[0]));
            CHECK(up.z() < -1e-4);  // rows go south
            areas[m] -= 0.5 * up.z();
            volume -= up.z() * (vertex(c[0]) + vertex(c[1]) + vertex(c[2])).z() / 6.0;
            for (const Edge& edge : {Edge(c[0], c[1]), Edge(c[1], c[2]), Edge(c[2], c[0])})
                CHECK(edges.emplace(edge, m).second);
        }
        if (group < 4 || whole == 0.0F) continue;
        // Shares of a mixture rise across a border.
        if ((group - 4) % (2 * border_mixtures) > 0) CHECK(sum / whole > last_mean);
        last_mean = sum / whole;
    }
    const double columns = bed.grid.columns - 1;
    const double rows = bed.grid.rows - 1;
    double open = 0.0;
    double border = 0.0;
    double turned = 0.0;
    for (const auto& [edge, sediment] : edges) {
        const Eigen::Vector3d along = vertex(edge.second) - vertex(edge.first);
        const auto other = edges.find({edge.second, edge.first});
        if (other == edges.end()) open += along.head<2>().norm();
        if (other == edges.end() || other->second == sediment) continue;
        const double eighths = std::atan2(along.y(), along.x()) / (0.25 * pi);
        border += along.head<2>().norm();
        if (std::abs(eighths - std::round(eighths)) > 0.1) turned += along.head<2>().norm();
    }
    CHECK(open == approx(2.0 * (columns + rows)).epsilon(1e-6));
    CHECK(turned > 0.7 * border);  // 80 % if all directions are as frequent
    // The same volume below, and the crossings on the surface between heights.
    const BedGround plain_ground = ground_of(plain);
    const auto& plain_vertices = plain_ground.vertices;
    const auto& plain_corners = plain_ground.corners;
    double plain_volume = 0.0;
    for (std::size_t i = 0; i < plain_corners[0].size(); i += 3) {
        for (std::size_t k = 0; k < 3; ++k)
            plain_volume +=
                static_cast<double>(plain_vertices[3 * plain_corners[0][i + k] + 2]) / 6.0;
    }
    CHECK(volume == approx(plain_volume).epsilon(1e-5));
    // The area in which the linear field is in each band, by 21 places of each triangle.
    std::array<double, 4> expected{};
    for (std::size_t i = 0; i < plain_corners[0].size(); i += 3) {
        const auto at = [&](std::size_t k) {
            return bed.sediments.values[plain_corners[0][i + k]];
        };
        for (int u = 0; u < 6; ++u) {
            for (int v = 0; u + v < 6; ++v) {
                const float value = at(0) +
                                    (static_cast<float>(u) + 1.0F / 3.0F) / 6.0F * (at(1) - at(0)) +
                                    (static_cast<float>(v) + 1.0F / 3.0F) / 6.0F * (at(2) - at(0));
                const auto limit = std::ranges::lower_bound(bed.sediments.limits, value);
                expected[static_cast<std::size_t>(limit - bed.sediments.limits.begin())] +=
                    0.5 / 21.0;
            }
        }
    }
    for (std::size_t m = 0; m < areas.size(); ++m)
        CHECK(areas[m] == approx(expected[m]).epsilon(0.01));
}

TEST_CASE("a part of a bed is the same bed, bit by bit, and another seed makes another") {
    SeabedRule rule = bare_rule(12.0);
    rule.z_m = -20.0;
    rule.roughness = BedRoughnessConfig{0.003, 3.25, 2.0};
    rule.ripples = BedRippleConfig{0.03, 1.0, 29.0};
    rule.sediments = {{"mud", 1.0}, {"sand", 2.0}};
    rule.rocks = BedRockConfig{1.0, {0.1, 2.0}, 2.4, {0.1, 0.5}};
    const Seabed whole = make_seabed(rule);
    CHECK(make_seabed(rule).heights == whole.heights);
    rule.window = {-3.03, 1.2, 4.0, 5.0};
    const Seabed part = make_seabed(rule);
    CHECK(part.heights.size() < whole.heights.size() / 4);
    const auto along = part.grid.west - whole.grid.west;
    const auto down = whole.grid.north - part.grid.north;
    const auto check_same = [&](const auto& in_part, const auto& in_whole) {
        for (int row = 0; row < part.grid.rows; ++row) {
            const auto begin = in_part.begin() + std::ptrdiff_t{row} * part.grid.columns;
            CHECK(std::equal(begin, begin + part.grid.columns,
                             in_whole.begin() + (down + row) * whole.grid.columns + along));
        }
    };
    check_same(part.heights, whole.heights);
    check_same(part.sediments.cells, whole.sediments.cells);
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
