#pragma once

#include "simulate/calibrated/model.h"

namespace sonarsim {

/// Forms the image of one look of a receiver, at its own samples: [samples, beams] powers after the
/// gain into `ping.intensity`, which must be 0 before, and the counts. The numbered steps are
/// sections 1 to 5 of docs/calibrated.md.
void form_look(const CalibratedModel& model, const TracedPing& traced, const FormContext& context,
               Ping& ping);

}  // namespace sonarsim
