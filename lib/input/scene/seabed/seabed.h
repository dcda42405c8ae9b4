#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "input/mission/seabed_keys.h"
#include "input/scene/seabed/relief.h"
#include "input/scene/surface.h"

namespace sonarsim {

/// A rock, in the world.
struct Rock {
    Eigen::Affine3d T_world_shape;  ///< turned about the vertical, scaled by `diameter_m`
    double diameter_m = 0.0;        ///< ball around its middle
    double buried = 0.0;
    std::uint32_t shape = 0;  ///< index into rock_shapes()
};

/// Shapes of rocks: balls of diameter 1 cut by random planes, each with 20, 80, 320 triangles.
std::vector<Surface> rock_shapes(std::uint64_t seed);

/// The rocks whose middles lie in an area of the bed, [least, largest), without their height: z of
/// the transform is 0. They are a Poisson process, drawn tile by tile of the endless plane, so that
/// an area has the same rocks, in the same order, whatever else is made. Their diameters follow the
/// power law between the two limits. Rocks that cover more cells have more triangles.
std::vector<Rock> rocks_in(const Eigen::AlignedBox2d& area, const BedRockConfig& rocks,
                           double cell_m, std::uint64_t seed);

/// The sediments of a grid, as indices into a list: the number of limits that a value exceeds.
struct BedSediments {
    std::vector<std::uint8_t> cells;  ///< at the middles of the cells, in the order of the grid
    std::vector<float> values;        ///< likewise; none of a single sediment
    std::vector<float> limits;        ///< rising
    float mixed = 0.0F;  ///< sediments mix where a value is nearer to a limit than this
};

/// The mixtures on each side of a border.
inline constexpr std::size_t border_mixtures = 2;

/// A bed, or a part of one.
struct Seabed {
    BedGrid grid;
    std::vector<float> heights;          ///< world z of the cells, in the order of the grid
    std::vector<std::string> materials;  ///< the bed's; "" is none
    BedSediments sediments;              ///< indices into `materials`
    std::string class_name;
    std::vector<Surface> rock_shapes;
    std::vector<Rock> rocks;
    std::string rock_material;
};

/// The class of the rocks, for labels.
inline constexpr const char* rock_class = "rock";

/// "rock_1", the node of the first rock.
std::string rock_name(std::size_t index);

/// Two sediments at their border. "sand + 20 % mud" has the label of sand.
struct BedMixture {
    std::string name;
    std::size_t first;  ///< index into Seabed::materials; the other is the next
    double share;       ///< that the other has
};

/// The mixtures of each border in turn, from the first sediment to the next.
std::vector<BedMixture> mixtures_of(const Seabed& bed);

/// The names of all materials that a bed names.
std::vector<std::string> materials_of(const Seabed& bed);

/// The heights within `window`. InputError as make_seabed().
BedGrid grid_of(const SeabedConfig& config, const Eigen::AlignedBox2d& window);

/// Makes the part of a bed within `window`. The same keys and seed make the same bed in every part,
/// except for the numbers of the rocks. InputError at the section's place for a part with more than
/// 2^25 heights, fewer than 2 x 2, or more than 50,000 rocks.
Seabed make_seabed(const SeabedConfig& config, std::uint64_t seed,
                   const Eigen::AlignedBox2d& window);

}  // namespace sonarsim
