#include "scene/seabed/hollows.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"

namespace sonarsim {

namespace {

/// An area with a margin, cut to the bed.
BedArea around(const BedArea& area, double margin_m, const BedArea& bed) {
    return {std::max(area[0] - margin_m, bed[0]), std::max(area[1] - margin_m, bed[1]),
            std::min(area[2] + margin_m, bed[2]), std::min(area[3] + margin_m, bed[3])};
}

/// (1 - t^2)^2 within t = 1.
double section(double t_squared) {
    const double rest = std::max(1.0 - t_squared, 0.0);
    return rest * rest;
}

/// Calls `lower` with the index and the place of each cell within `reach_m` of a point.
template <class Lower>
void for_each_cell_near(const BedGrid& grid, double x_m, double y_m, double reach_m,
                        const Lower& lower) {
    const auto cell = [&](double at) { return std::floor(at / grid.cell_m); };
    const auto within = [](double value, int count) {
        return static_cast<int>(std::clamp(value, 0.0, static_cast<double>(count)));
    };
    const auto west = static_cast<double>(grid.west);
    const auto north = static_cast<double>(grid.north);
    const int first = within(cell(x_m - reach_m) - west, grid.columns);
    const int last = within(cell(x_m + reach_m) - west + 1.0, grid.columns);
    const int top = within(north - cell(y_m + reach_m), grid.rows);
    const int end = within(north - cell(y_m - reach_m) + 1.0, grid.rows);
    for (int row = top; row < end; ++row) {
        for (int column = first; column < last; ++column) {
            const std::size_t i =
                static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
                static_cast<std::size_t>(column);
            lower(i, grid.x_m(column) - x_m, grid.y_m(row) - y_m);
        }
    }
}

}  // namespace

std::vector<Pockmark> pockmarks_in(const BedArea& area, const BedArea& bed,
                                   const BedPockmarks& pockmarks, std::uint64_t seed) {
    const PhiloxKey key = bed_key(seed, BedDraw::pockmarks);
    std::vector<Pockmark> out;
    for (const BedPoint& point : poisson_points(around(area, 0.5 * pockmarks.diameter_m[1], bed),
                                                pockmarks.density_per_m2, key)) {
        out.push_back({point.x_m, point.y_m, draw_in(pockmarks.diameter_m, point, 1, key),
                       draw_in(pockmarks.depth_m, point, 2, key)});
    }
    return out;
}

std::vector<Scar> scars_in(const BedArea& area, const BedArea& bed, const BedScars& scars,
                           std::uint64_t seed) {
    const PhiloxKey key = bed_key(seed, BedDraw::scars);
    std::vector<Scar> out;
    const double reach = 0.5 * (scars.length_m[1] + scars.width_m[1]);
    for (const BedPoint& point :
         poisson_points(around(area, reach, bed), scars.density_per_m2, key)) {
        out.push_back({point.x_m, point.y_m, draw_in(scars.direction_rad, point, 1, key),
                       draw_in(scars.length_m, point, 2, key),
                       draw_in(scars.width_m, point, 3, key),
                       draw_in(scars.depth_m, point, 4, key)});
    }
    return out;
}

void press(const BedGrid& grid, const Pockmark& pockmark, std::vector<double>& heights) {
    const double radius = 0.5 * pockmark.diameter_m;
    for_each_cell_near(
        grid, pockmark.x_m, pockmark.y_m, radius, [&](std::size_t i, double dx, double dy) {
            heights[i] -= pockmark.depth_m * section((dx * dx + dy * dy) / (radius * radius));
        });
}

void press(const BedGrid& grid, const Scar& scar, std::vector<double>& heights) {
    const SinCos direction = sincos(scar.direction_rad);
    const double half_width = 0.5 * scar.width_m;
    // Each end is half a pockmark as wide as the scar.
    const double straight = std::max(0.5 * scar.length_m - half_width, 0.0);
    for_each_cell_near(
        grid, scar.x_m, scar.y_m, straight + half_width, [&](std::size_t i, double dx, double dy) {
            const double along = direction.cos * dx + direction.sin * dy;
            const double across = direction.cos * dy - direction.sin * dx;
            const double beyond = std::max(std::fabs(along) - straight, 0.0);
            heights[i] -= scar.depth_m *
                          section((beyond * beyond + across * across) / (half_width * half_width));
        });
}

}  // namespace sonarsim
