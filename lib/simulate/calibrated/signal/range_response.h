#pragma once

#include "input/mission/instrument.h"
#include "simulate/calibrated/signal/line_array.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// The echo of a point along range: amplitudes at whole bins from `-reach` to `reach`. Echoes are
/// first divided between the two nearest bins in proportion to their closeness, then filtered with
/// these taps. Both steps together give the linear spline that is nearest to the pulse.
struct RangeTaps {
    int reach = 0;
    std::vector<float> taps;  ///< 2 reach + 1
    /// Scalloping correction: mean power over positions within a bin / power at the bin's centre.
    float scalloping_gain = 1.0F;
};

/// The pulse after compression, of half-power width `resolution_bins`; a band with a taper has the
/// shape of the beam of a line array with the same taper.
RangeTaps range_taps(double resolution_bins, double side_lobe_db);

/// The taps that give mean powers, where those of amplitudes give amplitudes that are drawn by
/// cell: their squares, with the correction.
RangeTaps power_taps(RangeTaps amplitudes);

/// The filter along range that gives white noise the spectrum of noise after the matched filter of
/// this pulse: taps at whole bins from -reach to reach, with a sum of squares of 1. If S is the
/// spectrum of the transmitted signal, the matched filter has the conjugate of S, and the
/// compressed pulse has |S|^2. White noise after the filter has the power spectrum |S|^2, too. So
/// the correlation of noise l bins apart is the amplitude of the compressed pulse l bins off its
/// peak (e.g. Turin, "An introduction to matched filters", 1960). A band wider than one cycle per
/// bin aliases. If it aliases often, the noise is white and the only tap is 1.
std::vector<float> noise_taps(double resolution_bins, double side_lobe_db);

/// The compressed pulse of range_taps(), for the power of noise and of echoes of surface. Its
/// spectrum is a band of width B with the weights w of a line array, and its half-power width in
/// range is the factor k (0.886 for uniform weights) times c / (2 B).
struct PulseBand {
    double sweep_hz = 0.0;  ///< B
    double pulse_s = 0.0;   ///< length of the transmitted pulse
    /// The bandwidth of the noise: its power over its spectrum. The matched filter of a pulse of
    /// length T and energy E gives the ratio E / N0 of echo to white noise; weights lose the factor
    /// mean(w^2) / mean(w)^2. So the bandwidth is this factor over T, T = 1 / B without a code.
    double noise_hz = 0.0;
    /// The integral of the pulse's square: surface of this length has the energy of an echo.
    double length_m = 0.0;
};

/// A pulse with `resolution_m` 0 has the resolution of a bin.
PulseBand pulse_band(const PulseConfig& pulse, double bin_m, double sound_speed_m_s);

}  // namespace sonarsim
