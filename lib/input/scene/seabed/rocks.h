#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "input/scene/seabed/bed_grid.h"
#include "input/scene/surface.h"

namespace sonarsim {

/// Rocks that lie on a bed.
struct BedRocks {
    double density_per_m2 = 0.0;
    std::array<double, 2> diameter_m{};
    double exponent = 3.0;           ///< rocks above D are as frequent as D^-exponent
    std::array<double, 2> buried{};  ///< share of a rock's height, uniform
    std::string material = {};       ///< "": that of the bed
};

/// A rock, in the world.
struct Rock {
    Eigen::Affine3d T_world_shape;  ///< turned about the vertical, scaled by `diameter_m`
    double diameter_m = 0.0;        ///< ball around its middle
    double buried = 0.0;
    std::uint32_t shape = 0;  ///< index into rock_shapes()
};

/// The shapes of a bed's rocks: balls of diameter 1 that random planes cut. There are several, each
/// with 20, 80 and 320 triangles, in this order.
std::vector<Surface> rock_shapes(std::uint64_t seed);

/// The rocks whose middles lie in an area of the bed, [least, largest), without their height: z of
/// the transform is 0. They are a Poisson process, drawn tile by tile of the endless plane, so that
/// an area has the same rocks, in the same order, whatever else is made. Their diameters follow the
/// power law between the two limits. Rocks that cover more cells have more triangles.
std::vector<Rock> rocks_in(const BedArea& area, const BedRocks& rocks, double cell_m,
                           std::uint64_t seed);

}  // namespace sonarsim
