#pragma once

#include "calibrated/drawn_powers.h"
#include "mission/instrument.h"

namespace sonarsim {

/// The far side lobes of a coded pulse after its matched filter: errors of the transmitted signal
/// that the filter does not know leave a share of the energy of every echo spread evenly over the
/// length of the pulse, before and behind it; section 3 of docs/calibrated.md.
struct PulseFloor {
    int reach = 0;       ///< range bins to either side
    float share = 0.0F;  ///< energy of each of the 2 reach + 1 bins over the echo's; 0: none
};

/// Nothing (a share of 0) without `floor_db` or a code.
PulseFloor pulse_floor(const PulseConfig& pulse, double bin_m, double sound_speed_m_s);

/// Adds the far side lobes of the echoes in `grid`, and of the amplitudes in `coherent`, which may
/// be null, to `grid`. `gain`: of the lobes of amplitudes.
void add_pulse_floor(const PulseFloor& floor, PowerForm form, float gain, PhiloxKey key,
                     const EchoGrid* coherent, EchoGrid& grid);

}  // namespace sonarsim
