#pragma once

#include "simulate/calibrated/model.h"

namespace sonarsim {

/// The use of an image without speckle: it is written, or it scales the ranks of detected samples,
/// for which larger pieces of surface suffice.
enum class MeanFor { image, ranks };

/// Forms the image of one ping: [range bins, beams] powers after the gain into `ping.intensity`,
/// which must be 0 before, and the counts. The numbered steps are sections 1 to 5 of
/// docs/calibrated.md. `use` matters without speckle only.
void form_look(const CalibratedModel& model, const TracedPing& traced, const FormContext& context,
               MeanFor use, Ping& ping);

}  // namespace sonarsim
