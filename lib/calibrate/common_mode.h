#pragma once

#include "calibrate/law_fit.h"
#include "calibrate/noise_fit.h"
#include "mission/instrument.h"
#include "recording/recording.h"

namespace sonarsim {

/// The beams whose noise exceeds that of the fan, from straight ahead on to both sides. Noise that
/// all elements share acts like a wave from straight ahead, and shows in the main lobe and the side
/// lobes. None if it does not stand out straight ahead.
AheadBeams ahead_beams(const Recording& recording, const LawFit& law, const NoiseFit& noise);

/// The noise that all elements share, over that of a beam. The beam at sine u receives |D(u)|^2 of
/// it, D the pattern of the array. `width` is that of the beams with its interval. Value below -50:
/// none seen.
Bounded common_mode(const Recording& recording, const LawFit& law, const NoiseFit& noise,
                    const BeamConfig& beam, const Bounded& width_deg);

}  // namespace sonarsim
