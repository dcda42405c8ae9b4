#include "scene/seabed/seabed.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

/// With two triangles each, a scene then takes about 12 GB.
constexpr double most_cells_of_bed = 33554432.0;

/// The cells from `low` to `high` along one axis, with a margin: the first, and the one after the
/// last. A bed of a size has no cells beyond it; if the two do not meet, all of it is taken.
std::array<double, 2> cells_within(double low, double high, double cell_m, double size_m) {
    constexpr double margin = 2.0;
    const double first = std::floor(low / cell_m) - margin;
    const double last = std::ceil(high / cell_m) + margin;
    if (size_m == 0.0) return {first, last};
    const double count = std::floor(size_m / cell_m + 1e-9);
    const double from = std::max(first, 0.0);
    const double to = std::min(last, count);
    if (to - from < 2.0) return {0.0, count};
    return {from, to};
}

BedGrid grid_of_rule(const SeabedRule& rule) {
    const std::array<double, 2> size = rule.size_m.value_or(std::array{0.0, 0.0});
    const auto& w = rule.window;
    const auto x = cells_within(w[0], w[2], rule.cell_m, size[0]);
    const auto y = cells_within(w[1], w[3], rule.cell_m, size[1]);
    const double columns = x[1] - x[0];
    const double rows = y[1] - y[0];
    if (columns < 2.0 || rows < 2.0) {
        throw InputError(rule.place, "size_m has fewer than 2 x 2 cells of cell_m; make it larger");
    }
    if (columns * rows > most_cells_of_bed) {
        throw InputError(
            rule.place,
            fmt::format("the mission needs {:.0f} x {:.0f} heights of the seabed, and at most 2^25 "
                        "have room; raise cell_m, or shorten the trajectory or the ranges",
                        columns, rows));
    }
    return {rule.cell_m, static_cast<std::int64_t>(x[0]), static_cast<std::int64_t>(y[1]) - 1,
            static_cast<int>(columns), static_cast<int>(rows)};
}

/// The heights of the bed without anything random.
std::vector<double> smooth_heights(const BedGrid& grid, const SeabedRule& rule) {
    std::vector<double> out;
    out.reserve(grid.size());
    for (int row = 0; row < grid.rows; ++row) {
        const double along_y = rule.slope[1] * (grid.y_m(row) - rule.origin_m[1]);
        for (int column = 0; column < grid.columns; ++column)
            out.push_back(rule.z_m + along_y +
                          rule.slope[0] * (grid.x_m(column) - rule.origin_m[0]));
    }
    return out;
}

}  // namespace

Seabed make_seabed(const SeabedRule& rule) {
    Seabed bed;
    bed.grid = grid_of_rule(rule);
    bed.origin_m = rule.origin_m;
    bed.class_name = rule.class_name;
    std::vector<double> heights = smooth_heights(bed.grid, rule);
    if (rule.waves) {
        add_ripples(bed.grid, *rule.waves, BedDraw::waves, BedDraw::wave_patches, rule.seed,
                    heights);
    }
    if (rule.ripples) {
        add_ripples(bed.grid, *rule.ripples, BedDraw::ripples, BedDraw::ripple_patches, rule.seed,
                    heights);
    }
    if (rule.roughness) add_roughness(bed.grid, *rule.roughness, rule.seed, heights);
    bed.heights.reserve(heights.size());
    for (const double z : heights)
        bed.heights.push_back(static_cast<float>(z));
    return bed;
}

}  // namespace sonarsim
