#pragma once

#include <vector>

#include "calibrated/line_array.h"

namespace sonarsim {

/// The echo of a point along range: amplitudes at whole bins from `-reach` to `reach`. Echoes are
/// first divided between the two nearest bins in proportion to their closeness, then filtered with
/// these taps. Together the two are the linear spline that is nearest to the pulse.
struct RangeTaps {
    int reach = 0;
    std::vector<float> taps;  ///< 2 reach + 1
    /// Scalloping correction: mean power over positions within a bin / power at the bin's centre.
    float scalloping_gain = 1.0F;
};

/// The pulse after compression, of half-power width `resolution_bins`; a band with a taper has the
/// shape of the beam of a line array with the same taper. `squared`: of powers, not of amplitudes.
RangeTaps range_taps(double resolution_bins, double side_lobe_db, bool squared);

/// The filter along range that gives white noise of the bins the band of that pulse: taps at whole
/// bins from -reach to reach, with a sum of squares of 1. Noise passes the receiver's filter alone,
/// whose response has the band of the pulse, so its correlation between bins is the pulse
/// correlated with itself. A band wider than one cycle per bin folds; folded often it is white, and
/// the only tap is 1.
std::vector<float> noise_taps(double resolution_bins, double side_lobe_db);

}  // namespace sonarsim
