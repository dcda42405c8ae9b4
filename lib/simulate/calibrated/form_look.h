#pragma once

#include <span>

#include "simulate/calibrated/model.h"

namespace sonarsim {

/// Forms the image of one ping: [range bins, beams] powers after the gain into `ping.intensity`,
/// which must be 0 before, and the counts. The numbered steps are sections 1 to 5 of
/// docs/calibrated.md. `mean`: of the size of the image, receives it without noise and without the
/// draws of amplitudes; empty: not needed.
void form_look(const CalibratedModel& model, const TracedPing& traced, const FormContext& context,
               std::span<float> mean, Ping& ping);

}  // namespace sonarsim
