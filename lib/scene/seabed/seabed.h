#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/error.h"
#include "scene/seabed/bed_grid.h"
#include "scene/seabed/ripples.h"
#include "scene/seabed/roughness.h"

namespace sonarsim {

/// The numbers that make a bed, and the part of it that is made.
struct SeabedRule {
    std::uint64_t seed = 0;
    double cell_m = 1.0;
    std::optional<std::array<double, 2>> size_m = {};  ///< x, y from (0, 0); none: no end
    /// The part that is made, in the coordinates of the bed: least x and y, largest x and y.
    std::array<double, 4> window{};
    std::array<double, 2> origin_m{};  ///< point of the bed that is the world's (0, 0)
    double z_m = 0.0;                  ///< height of the smooth bed there
    std::array<double, 2> slope{};     ///< rise per metre along x and y
    std::optional<BedRoughness> roughness = {};
    std::optional<BedRipples> ripples = {};
    std::optional<BedRipples> waves = {};
    std::string material = {};  ///< "": none
    std::string class_name = {};
    Location place = {};  ///< in the mission, for messages
};

/// A bed, or a part of one.
struct Seabed {
    BedGrid grid;
    std::array<double, 2> origin_m{};  ///< point of the bed that is the world's (0, 0)
    std::vector<float> heights;        ///< world z of the cells, in the order of the grid
    std::string class_name;
};

/// Makes a part of a bed. The same rule makes the same heights in every part. InputError at the
/// rule's place for a part with more than 2^25 heights, or fewer than 2 x 2.
Seabed make_seabed(const SeabedRule& rule);

}  // namespace sonarsim
