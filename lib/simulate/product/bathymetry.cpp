#include "simulate/product/bathymetry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sonarsim {

namespace {

constexpr double soundings_per_cell = 4.0;
constexpr double finest_cell_m = 1e-6;  // the limit of range bins

}  // namespace

void SoundingBounds::add(const Eigen::Vector3d& position) {
    const Eigen::Vector2d p = position.head<2>();
    min = count == 0 ? p : Eigen::Vector2d(min.cwiseMin(p));
    max = count == 0 ? p : Eigen::Vector2d(max.cwiseMax(p));
    ++count;
}

std::optional<std::size_t> Bathymetry::cell_at(const Eigen::Vector2d& point) const {
    const double column = std::floor(point.x() / cell_m) - first_column;
    const double row = first_row - std::floor(point.y() / cell_m);
    if (!(column >= 0.0 && column < columns && row >= 0.0 && row < rows)) return std::nullopt;
    return static_cast<std::size_t>(row) * columns + static_cast<std::size_t>(column);
}

void Bathymetry::add(const Eigen::Vector3d& position) {
    const std::optional<std::size_t> cell = cell_at(position.head<2>());
    if (!cell) return;
    sum[*cell] += position.z();
    ++count[*cell];
}

std::vector<float> Bathymetry::mean_z() const {
    std::vector<float> mean(sum.size(), std::numeric_limits<float>::quiet_NaN());
    for (std::size_t k = 0; k < sum.size(); ++k) {
        if (count[k] > 0) mean[k] = static_cast<float>(sum[k] / count[k]);
    }
    return mean;
}

Bathymetry make_bathymetry(const SoundingBounds& bounds, double cell_m) {
    Bathymetry grid;
    if (bounds.count == 0) return grid;
    const Eigen::Vector2d size = bounds.max - bounds.min;
    const double area = std::max(size.x(), 1e-3) * std::max(size.y(), 1e-3);
    const double wanted = soundings_per_cell * area / static_cast<double>(bounds.count);
    grid.cell_m = std::max(cell_m > 0.0 ? cell_m : round_up_125(std::sqrt(wanted)), finest_cell_m);
    // The grid begins at a multiple of the cell size, which may add a cell on either side.
    while ((size.x() / grid.cell_m + 2.0) * (size.y() / grid.cell_m + 2.0) > max_map_cells)
        grid.cell_m = round_up_125(1.001 * grid.cell_m);
    grid.first_column = std::floor(bounds.min.x() / grid.cell_m);
    grid.first_row = std::floor(bounds.max.y() / grid.cell_m);
    grid.west_m = grid.first_column * grid.cell_m;
    grid.north_m = (grid.first_row + 1.0) * grid.cell_m;
    const double last_column = std::floor(bounds.max.x() / grid.cell_m);
    const double last_row = std::floor(bounds.min.y() / grid.cell_m);
    grid.columns = static_cast<int>(last_column - grid.first_column) + 1;
    grid.rows = static_cast<int>(grid.first_row - last_row) + 1;
    grid.sum.assign(static_cast<std::size_t>(grid.columns) * grid.rows, 0.0);
    grid.count.assign(grid.sum.size(), 0);
    return grid;
}

}  // namespace sonarsim
