#include "simulate/product/mosaic.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "simulate/product/bottom.h"
#include "simulate/product/sidescan_row.h"

namespace sonarsim {

namespace {

/// The echo at a slant range, 0 beyond the row. `side`: 1 is port, -1 starboard.
float echo_at(const Sonar& sonar, std::span<const float> row, double slant_m, int side) {
    const auto half = static_cast<std::ptrdiff_t>(row.size() / 2);
    const double column_m = slant_m - column_offset_m(sonar.config);
    const auto bin = static_cast<std::ptrdiff_t>(column_m / sonar.settings.view.bin_m());
    if (bin >= half) return 0.0F;
    return row[static_cast<std::size_t>(side > 0 ? half - 1 - bin : half + bin)];
}

}  // namespace

std::optional<Swath> swath_of(const Sonar& sonar, const Pose& T_world_sensor,
                              std::span<const float> row) {
    const double bin_m = sonar.settings.view.bin_m();
    const std::size_t half = row.size() / 2;
    const auto blank = static_cast<std::size_t>(blank_columns(sonar.config));
    std::optional<double> altitude;
    for (const int side : {1, -1}) {
        std::vector<float> column;
        for (std::size_t k = blank; k < half; ++k)
            column.push_back(row[side > 0 ? half - 1 - k : half + k]);
        const std::optional<int> bin = first_return_of_swath(column);
        if (!bin) continue;
        const double range =
            (static_cast<double>(blank) + *bin + 0.5) * bin_m + column_offset_m(sonar.config);
        altitude = std::min(altitude.value_or(range), range);
    }
    // The sensor looks along x and has port along y.
    const Eigen::Vector3d port = T_world_sensor.rotation * Eigen::Vector3d::UnitY();
    const double level = port.head<2>().norm();
    if (!altitude || level < 1e-3) return std::nullopt;
    const double range_max = sonar.config.range_max_m;
    return Swath{
        .nadir_m = T_world_sensor.translation.head<2>(),
        .port = port.head<2>() / level,
        .altitude_m = *altitude,
        .reach_m = std::sqrt(std::max(0.0, range_max * range_max - *altitude * *altitude))};
}

void add_bounds(const Swath& swath, SoundingBounds& bounds) {
    for (const double side : {-1.0, 1.0}) {
        const Eigen::Vector2d end = swath.nadir_m + side * swath.reach_m * swath.port;
        bounds.add({end.x(), end.y(), 0.0});
    }
}

void rasterize(const Sonar& sonar, const Swath& swath, std::span<const float> row,
               Bathymetry& map) {
    // With two points per cell the line misses a cell only at its corners.
    const double step = 0.5 * map.cell_m;
    for (const int side : {1, -1}) {
        for (double ground = 0.5 * step; ground < swath.reach_m; ground += step) {
            const double slant = std::sqrt(ground * ground + swath.altitude_m * swath.altitude_m);
            const Eigen::Vector2d at = swath.nadir_m + side * ground * swath.port;
            map.add({at.x(), at.y(), echo_at(sonar, row, slant, side)});
        }
    }
}

}  // namespace sonarsim
