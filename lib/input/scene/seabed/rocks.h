#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "input/mission/seabed_keys.h"
#include "input/scene/surface.h"

namespace sonarsim {

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
std::vector<Rock> rocks_in(const Eigen::AlignedBox2d& area, const BedRockConfig& rocks,
                           double cell_m, std::uint64_t seed);

}  // namespace sonarsim
