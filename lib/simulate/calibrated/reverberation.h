#pragma once

#include "input/mission/instrument.h"
#include "simulate/calibrated/speckle.h"

namespace sonarsim {

/// Sound that arrives behind an echo over many paths: in the sonar's housing, among waves, grains
/// and walls. The energy of this tail is `share` times the echo's, and it falls by 60 dB in T60:
///
///     r_k = d r_(k-1) + (1 - d) share p_(k-1),    d = 10^(-6 t / T60), t = 2 dr / c per bin,
///
/// with p the power of an echo and r that of the tail, one recursion along range (Kuttruff, Room
/// Acoustics, for the exponential law).
struct Reverberation {
    float share = 0.0F;  ///< 0: none
    float decay = 0.0F;  ///< d

    Reverberation() = default;
    Reverberation(const ReceiverConfig& receiver, double bin_m, double sound_speed_m_s);
};

/// Adds the tails of a grid's echoes, before the pulse. Amplitudes are drawn for each ping.
void add_reverberation(const Reverberation& tail, PowerForm form, PhiloxKey key, EchoGrid& grid);

}  // namespace sonarsim
