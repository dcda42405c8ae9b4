#pragma once

#include "calibrate/law_fit.h"
#include "calibrate/noise_fit.h"
#include "mission/instrument.h"
#include "recording/recording.h"

namespace sonarsim {

/// The beams whose noise exceeds that of the fan, from straight ahead on to both sides. Noise that
/// all elements share acts like a wave from straight ahead, and shows in the main lobe and the side
/// lobes. None if the beam straight ahead does not stand out.
AheadBeams ahead_beams(const Recording& recording, const LawFit& law, const NoiseFit& noise);

/// The level of the noise that all elements share, relative to the noise of a beam, dB. The beam at
/// the sine u receives the share |D(u)|^2 of this noise, D being the pattern of the array.
/// `width_deg`: of the beams. A value below -50: none found.
Bounded common_mode(const Recording& recording, const LawFit& law, const NoiseFit& noise,
                    const BeamConfig& beam, const Bounded& width_deg);

}  // namespace sonarsim
