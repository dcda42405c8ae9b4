#pragma once

#include <span>

#include "calibrated/echo_grid.h"
#include "core/random.h"

namespace sonarsim {

/// The form in which mean powers are added to a cell of a grid.
enum class PowerForm {
    power,     ///< they are added to the power in the cell
    amplitude  ///< a complex normal amplitude of that power is added
};

/// Adds the mean powers of a column's bins, as many as there are up to a multiple of 8. Powers
/// below 0 count as 0. `gain`: the factor of draw_speckle() for amplitudes, which the key draws for
/// each bin of each column.
void add_drawn(PowerForm form, std::span<const float> powers, float gain, int column, PhiloxKey key,
               EchoGrid& grid);

}  // namespace sonarsim
