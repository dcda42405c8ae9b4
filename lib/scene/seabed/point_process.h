#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/random.h"

namespace sonarsim {

/// A part of a bed: least x and y, largest x and y, m of the bed.
using BedArea = std::array<double, 4>;

/// A point of a Poisson process, and the counter of its further draws.
struct BedPoint {
    double x_m = 0.0;
    double y_m = 0.0;
    std::uint32_t tile_x = 0;
    std::uint32_t tile_y = 0;
    std::uint32_t number = 0;  ///< within its tile
};

/// The points of a Poisson process that lie in an area, [least, largest). They are drawn tile by
/// tile of the endless plane, so that an area has the same points, in the same order, whatever else
/// is generated. The size of the tiles depends only on the density.
std::vector<BedPoint> poisson_points(const BedArea& area, double density_per_m2, PhiloxKey key);

/// A uniform number in [0, 1) of a point; each `which` from 1 on gives an independent one.
inline double draw_of(const BedPoint& point, std::uint32_t which, PhiloxKey key) {
    const PhiloxBlock block = philox({point.tile_x, point.tile_y, point.number, which}, key);
    return unit_double(block.x0, block.x1);
}

/// The same in a range.
inline double draw_in(const std::array<double, 2>& range, const BedPoint& point,
                      std::uint32_t which, PhiloxKey key) {
    return range[0] + (range[1] - range[0]) * draw_of(point, which, key);
}

}  // namespace sonarsim
