#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "product/picture.h"

namespace sonarsim {

/// Soundings of less quality do not enter a map.
inline constexpr double map_quality = 0.5;

/// The most cells that a map has.
inline constexpr double most_map_cells = 1 << 24;

/// The ground that the soundings of a map cover.
struct SoundingBounds {
    Eigen::Vector2d min = Eigen::Vector2d::Zero();  ///< world x, y, m
    Eigen::Vector2d max = Eigen::Vector2d::Zero();
    std::uint64_t count = 0;

    void add(const Eigen::Vector3d& position);
};

/// Mean height of the soundings in each cell of a north-up grid: row 0 has the greatest y, column 0
/// the least x. Cells begin at multiples of their size, so that grids of one size fit together.
struct Bathymetry {
    double cell_m = 0.0;
    double west_m = 0.0;   ///< world x of the left edge
    double north_m = 0.0;  ///< world y of the upper edge
    int columns = 0;
    int rows = 0;
    std::vector<double> sum;           ///< [rows, columns], of world z
    std::vector<std::uint32_t> count;  ///< [rows, columns]

    void add(const Eigen::Vector3d& position);
    /// [rows, columns], m; NaN where no sounding fell.
    std::vector<float> mean_z() const;
};

/// An empty grid over the bounds. `cell_m` 0 chooses the size of a cell: 1, 2 or 5 times a power of
/// ten, with four soundings to a cell on average, were they evenly spread. A grid has at most 2^24
/// cells; cells are larger than asked for where it takes that.
Bathymetry make_bathymetry(const SoundingBounds& bounds, double cell_m);

/// The map as a picture: colour by depth, relief (stretched)
/// shaded by light from the north-west, a scale bar
/// and the depths of the colours. What was not seen is dark. At most 4,096 pixels a side.
Picture draw_bathymetry(const Bathymetry& bathymetry);

}  // namespace sonarsim
