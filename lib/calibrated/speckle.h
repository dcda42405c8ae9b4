#pragma once

#include "calibrated/echo_grid.h"
#include "core/random.h"

namespace sonarsim {

/// Turns the powers of a grid into independent complex amplitudes of `gain` times these mean
/// powers. A cell's draw belongs to its row, its column and the key.
void draw_speckle(EchoGrid& grid, float gain, PhiloxKey key);

}  // namespace sonarsim
