#pragma once

#include <vector>

#include "simulate/calibrated/line_array.h"

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
/// shape of the beam of a line array with the same taper. `squared`: of powers, not of amplitudes.
RangeTaps range_taps(double resolution_bins, double side_lobe_db, bool squared);

/// The filter along range that gives white noise the spectrum of noise after the matched filter of
/// this pulse: taps at whole bins from -reach to reach, with a sum of squares of 1. If S is the
/// spectrum of the transmitted signal, the matched filter has the conjugate of S, and the
/// compressed pulse has |S|^2. White noise after the filter has the power spectrum |S|^2, too. So
/// the correlation of noise l bins apart is the amplitude of the compressed pulse l bins off its
/// peak (e.g. Turin, "An introduction to matched filters", 1960). A band wider than one cycle per
/// bin aliases. If it aliases often, the noise is white and the only tap is 1.
std::vector<float> noise_taps(double resolution_bins, double side_lobe_db);

}  // namespace sonarsim
