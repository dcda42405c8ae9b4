#pragma once

#include <span>

#include "core/random.h"
#include "simulate/calibrated/echo_grid.h"

namespace sonarsim {

/// The form in which mean powers are added to a cell of a grid.
enum class PowerForm {
    power,     ///< they are added to the power in the cell
    amplitude  ///< a complex normal amplitude of that power is added
};

/// Adds the mean powers of a column's bins. Bins are read and written up to a multiple of 8. Powers
/// below 0 count as 0. `gain`: a factor on the powers of amplitudes, whose draws are a function of
/// the key, the bin and the column.
void add_drawn(PowerForm form, std::span<const float> powers, float gain, int column, PhiloxKey key,
               EchoGrid& grid);

/// Turns the powers of a grid into independent complex amplitudes of `gain` times these mean
/// powers.
void draw_speckle(EchoGrid& grid, float gain, PhiloxKey key);

}  // namespace sonarsim
