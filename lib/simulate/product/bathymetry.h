#pragma once

#include <Eigen/Geometry>
#include <cstdint>

#include "simulate/product/picture.h"

namespace sonarsim {

/// The least quality of a sounding in a map.
inline constexpr double map_quality = 0.5;

/// The ground that a map covers, and the number of its points.
struct GroundBounds {
    Eigen::AlignedBox2d box;  ///< world x, y, m
    std::uint64_t count = 0;

    void add(const Eigen::Vector3d& position) {
        box.extend(position.head<2>());
        ++count;
    }
};

/// Weighted means on a north-up grid, the heights of soundings or the levels of side-scans: row 0
/// has the greatest y, column 0 the least x. Cells begin at multiples of their size.
struct GroundGrid {
    double cell_m = 0.0;
    double west_m = 0.0;        ///< world x of the left edge
    double north_m = 0.0;       ///< world y of the upper edge
    double first_column = 0.0;  ///< number of the left column; a cell k covers [k, k + 1) cell_m
    double first_row = 0.0;     ///< number of the upper row along y
    int columns = 0;
    int rows = 0;
    /// [rows, columns] Sums of weights, and of values times them.
    std::vector<double> weight, sum;

    /// Adds the value z at x, y of the world.
    void add(const Eigen::Vector3d& point, double more_weight = 1.0);
    /// The means [rows, columns]; NaN in cells without any.
    std::vector<float> mean() const;
};

/// An empty grid over the bounds. With `cell_m` 0 the cell size is 1, 2 or 5
/// times a power of ten, chosen so that a cell has four evenly spread soundings on average. Cells
/// are larger than the key says if the grid would exceed 2^24 cells.
GroundGrid make_ground_grid(const GroundBounds& bounds, double cell_m);

/// The number of cells that have soundings.
std::int64_t filled_cells(const GroundGrid& grid);

/// The size by which those cells of a grid that have soundings, `count` in all, hold four each. The
/// box of the soundings may hold much ground without any.
double cell_of_soundings(const GroundGrid& grid, std::uint64_t count);

/// Draws the map: colours by depth, exaggerated relief shaded by light from the north-west, a scale
/// bar and a legend. Cells without soundings are dark. At most 4,096 pixels a side.
Picture draw_bathymetry(const GroundGrid& bathymetry);

}  // namespace sonarsim
