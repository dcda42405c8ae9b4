#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "input/mission/seabed_keys.h"
#include "input/scene/seabed/relief.h"
#include "input/scene/seabed/rocks.h"
#include "input/scene/surface.h"

namespace sonarsim {

/// The sediments of a grid, as indices into a list. A point has the index of as many limits as its
/// value exceeds.
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
