#pragma once

#include "simulate/calibrated/model.h"
#include "simulate/calibrated/speckle/speckle.h"

namespace sonarsim {

/// Adds the echoes of the water's volume to a grid. `gain`: as in draw_speckle(), for amplitudes.
/// `mean`: a grid that receives their powers; null: none.
void add_water(const CalibratedModel& model, const TracedPing& traced, const FormContext& context,
               PowerForm form, float gain, EchoGrid& grid, EchoGrid* mean);

}  // namespace sonarsim
