#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "input/scene/seabed/bed_grid.h"

namespace sonarsim {

/// A material and its share of the bed.
struct BedSediment {
    std::string material;
    double share = 1.0;
};

/// The size of the bays of a border, as a share of the size of the patches.
inline constexpr double bays_per_patch = 0.1;

/// The sediment of each cell, as an index. A smooth field is cut into as many bands as there are
/// sediments: each has its share of the bed, and borders on those before and after it in the list.
/// The field's waves are `patch_m` long, with the smaller ones of the bays on them.
std::vector<std::uint8_t> sediments_of(const BedGrid& grid, const std::vector<BedSediment>& list,
                                       double patch_m, std::uint64_t seed);

}  // namespace sonarsim
