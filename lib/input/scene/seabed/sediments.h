#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "input/mission/seabed_keys.h"
#include "input/scene/seabed/bed_grid.h"

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

/// The longest waves of the sediments' field, in patches. A rule.
inline constexpr double longest_wave = 8.0;

/// Cuts a random field into as many bands as there are sediments: each has its share of the bed,
/// and borders on those before and after it in the list. The field has octaves of waves, down to 4
/// cells. They have equal variance down to `patch_m`, so that patches join to large ones. Below,
/// amplitudes fall as wavelength^0.75: then borders have the dimension 1.25, as the coast of
/// Britain has it (Mandelbrot, Science 156 (1967), 636). Sediments mix over 0.1 to 0.6 `patch_m`,
/// by the seed (rule).
BedSediments sediments_of(const BedGrid& grid, const std::vector<BedSedimentConfig>& list,
                          double patch_m, std::uint64_t seed);

}  // namespace sonarsim
