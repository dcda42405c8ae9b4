#pragma once

#include "mission/instrument.h"

namespace sonarsim {

/// The compressed pulse of range_taps(), for the power of noise and of echoes of surface. Its
/// spectrum is a band of width B with the weights w of a line array, and its half-power width in
/// range is the factor k (0.886 for uniform weights) times c / (2 B).
struct PulseBand {
    double sweep_hz = 0.0;  ///< B
    /// The power of noise is this times its spectrum. The matched filter of a pulse of length T and
    /// energy E has the ratio E / N0 to white noise, and weights lose the factor mean(w^2) /
    /// mean(w)^2. So this is that factor over T, where T is 1 / B for a pulse without a code.
    double noise_hz = 0.0;
    /// The echo of surface has the energy of this length of it: the integral of the squared pulse.
    double length_m = 0.0;
};

/// A pulse of resolution 0 has that of a range bin.
PulseBand pulse_band(const PulseConfig& pulse, double bin_m, double sound_speed_m_s);

}  // namespace sonarsim
