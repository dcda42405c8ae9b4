#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/seabed/bed_grid.h"
#include "scene/seabed/point_process.h"
#include "scene/surface.h"

namespace sonarsim {

/// Tufts of leaves that stand on a bed, such as sea grass.
struct BedPlants {
    double density_per_m2 = 0.0;       ///< tufts in a patch
    std::array<double, 2> height_m{};  ///< uniform
    double share = 1.0;                ///< share of the bed
    double patch_m = 5.0;
    std::string material = {};  ///< "": that of the bed
    std::string class_name = {};
};

/// A tuft.
struct Plant {
    double x_m = 0.0;  ///< m of the bed
    double y_m = 0.0;
    double height_m = 0.0;
    BedPoint point;  ///< for the draws of its leaves
};

/// The tufts in an area of the bed, which the grid covers.
std::vector<Plant> plants_in(const BedArea& area, const BedGrid& grid, const BedPlants& plants,
                             std::uint64_t seed);

/// Adds the leaves of a tuft that stands at a point of the world: narrow upright triangles that
/// lean away from its middle by up to 35 degrees.
void add_leaves(const Plant& plant, const Eigen::Vector3d& foot, std::uint64_t seed,
                Surface& surface);

}  // namespace sonarsim
