#include "scene/seabed/point_process.h"

#include <cmath>

#include "core/elementary.h"

namespace sonarsim {

namespace {

constexpr double points_per_tile = 8.0;
/// The counter of a tile's number of points; its points are counted from 0.
constexpr std::uint32_t tile_count_counter = 0xFFFFFFFFU;

/// The number of points of a tile, by inversion of Poisson's distribution.
std::uint32_t count_of_tile(std::uint32_t tile_x, std::uint32_t tile_y, PhiloxKey key) {
    const PhiloxBlock block = philox({tile_x, tile_y, tile_count_counter, 0}, key);
    const double u = unit_double(block.x0, block.x1);
    double probability = exponential(-points_per_tile);
    double sum = probability;
    std::uint32_t count = 0;
    constexpr std::uint32_t never_reached = 100;  // its probability is 1e-70
    while (u >= sum && count < never_reached) {
        ++count;
        probability *= points_per_tile / count;
        sum += probability;
    }
    return count;
}

}  // namespace

std::vector<BedPoint> poisson_points(const BedArea& area, double density_per_m2, PhiloxKey key) {
    std::vector<BedPoint> out;
    if (density_per_m2 <= 0.0) return out;
    const double tile_m = std::sqrt(points_per_tile / density_per_m2);
    const auto tile_of = [&](double x) {
        return static_cast<std::int64_t>(std::floor(x / tile_m));
    };
    for (std::int64_t j = tile_of(area[1]); j <= tile_of(area[3]); ++j) {
        for (std::int64_t i = tile_of(area[0]); i <= tile_of(area[2]); ++i) {
            const auto tile_x = static_cast<std::uint32_t>(i);
            const auto tile_y = static_cast<std::uint32_t>(j);
            const std::uint32_t count = count_of_tile(tile_x, tile_y, key);
            for (std::uint32_t n = 0; n < count; ++n) {
                const PhiloxBlock block = philox({tile_x, tile_y, n, 0}, key);
                const double x =
                    (static_cast<double>(i) + unit_double(block.x0, block.x1)) * tile_m;
                const double y =
                    (static_cast<double>(j) + unit_double(block.x2, block.x3)) * tile_m;
                if (x < area[0] || x >= area[2] || y < area[1] || y >= area[3]) continue;
                out.push_back({x, y, tile_x, tile_y, n});
            }
        }
    }
    return out;
}

}  // namespace sonarsim
