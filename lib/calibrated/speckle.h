#pragma once

#include "calibrated/echo_grid.h"
#include "core/random.h"

namespace sonarsim {

/// Turns the powers of a grid into independent complex amplitudes of `gain` times these mean
/// powers. A cell's draw depends on its row, its column and the key alone.
void draw_speckle(EchoGrid& grid, float gain, PhiloxKey key);

}  // namespace sonarsim
