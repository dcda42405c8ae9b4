#include "input/scene/placing/taken_ground.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace sonarsim {

namespace {

bool is_free(const Hull& room, double spacing_m, const std::vector<Hull>& taken) {
    return std::ranges::none_of(taken, [&](const Hull& other) {
        const double distance = distance_between(room, other, spacing_m);
        return distance <= 0.0 || distance < spacing_m;
    });
}

std::pair<std::int64_t, std::int64_t> cell_at(const Eigen::Vector2d& point, double width_m) {
    const Eigen::Vector2d cell = (point / width_m).array().floor();
    return {static_cast<std::int64_t>(cell.x()), static_cast<std::int64_t>(cell.y())};
}

}  // namespace

void TakenGround::add(Hull hull) {
    if (hull.empty()) return;
    constexpr double min_width_m = 1e-3;  // the numbers of narrower cells would be too large
    const Eigen::AlignedBox2d box = box_of(hull);
    const int exponent = std::ilogb(std::max(box.sizes().maxCoeff(), min_width_m)) + 1;
    levels_[exponent][cell_at(box.center(), std::ldexp(1.0, exponent))].push_back(std::move(hull));
}

bool TakenGround::has_room(const Hull& room, double spacing_m) const {
    const Eigen::AlignedBox2d box = box_of(room);
    for (const auto& [exponent, cells] : levels_) {
        const double width_m = std::ldexp(1.0, exponent);
        // A hull reaches half a cell beyond the middle of its box; the rest is for rounding.
        const double reach_m = spacing_m + 0.51 * width_m + 1e-3;
        const auto [west, south] = cell_at(box.min().array() - reach_m, width_m);
        const auto [east, north] = cell_at(box.max().array() + reach_m, width_m);
        for (auto column = cells.lower_bound({west, south}); column != cells.end();) {
            const auto [x, y] = column->first;
            if (x > east) break;
            if (y < south) {
                column = cells.lower_bound({x, south});
            } else if (y > north) {
                column = cells.lower_bound({x + 1, south});
            } else {
                if (!is_free(room, spacing_m, column->second)) return false;
                ++column;
            }
        }
    }
    return true;
}

}  // namespace sonarsim
