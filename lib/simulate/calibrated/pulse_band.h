#pragma once

#include "input/mission/instrument.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// The compressed pulse of range_taps(), for the power of noise and of echoes of surface. Its
/// spectrum is a band of width B with the weights w of a line array, and its half-power width in
/// range is the factor k (0.886 for uniform weights) times c / (2 B).
struct PulseBand {
    double sweep_hz = 0.0;  ///< B
    /// The bandwidth of the noise: its power over its spectrum. The matched filter of a pulse of
    /// length T and energy E gives the ratio E / N0 of echo to white noise; weights lose the factor
    /// mean(w^2) / mean(w)^2. So the bandwidth is this factor over T, with T = 1 / B for a pulse
    /// without a code.
    double noise_hz = 0.0;
    /// The equivalent length of the pulse: the integral of its square. An echo of surface has the
    /// energy of this length of surface.
    double length_m = 0.0;
};

/// A pulse with `resolution_m` 0 has the resolution of a bin.
PulseBand pulse_band(const PulseConfig& pulse, double bin_m, double sound_speed_m_s);

}  // namespace sonarsim
