#pragma once

#include <vector>

#include "compare/figures/patches.h"
#include "compare/figures/zones.h"

namespace sonarsim {

/// The step between a bright region and a dark one, an object and its shadow or the water.
struct Edge {
    int range = 0;  ///< the middle of the window in which it was found
    int beam = 0;
    double width = 0.0;  ///< from 10 to 90 % of the rise, in bins along the step
};

/// The direction in which the level steps.
enum class StepAlong { range, bearing };

struct EdgeSearch {
    PatchSize window;
    RangeZone zone;           ///< windows lie within it
    float full_power = 0.0F;  ///< powers from here on are clipped; 0: none are
};

/// The edges of an image along one direction. The image is cut across that direction into strips as
/// wide as the window. The means of a strip's rows show where a level steps by 6 dB or more between
/// the outer quarters of a window about the step. The powers of that window, not smoothed along the
/// step, give its width: see width_of_step().
std::vector<Edge> edges_of(const ImageView& image, const EdgeSearch& search, StepAlong along);

/// Powers of a window, [along the step, across it].
struct StepWindow {
    std::vector<float> power;
    int along = 0;
    int across = 0;

    float at(int i, int j) const {
        return power[static_cast<std::size_t>(i) * static_cast<std::size_t>(across) +
                     static_cast<std::size_t>(j)];
    }
};

/// The width of a step, from 10 to 90 %, in bins; NaN if the window has none. Each row has two
/// values, the means of the halves of the window across the step. The mean power is
/// taken as d + (b - d) Phi((x - x0 - g y) / s), Phi the normal distribution's integral, with the
/// levels d and b, the place x0, the slant g and the width s all fitted at once by weighted least
/// squares. The equations of this fit have the mean 0 at the true values for speckle of any law and
/// any correlation, so that speckle does not bias the width as a choice of steep places would.
double width_of_step(const StepWindow& all);

}  // namespace sonarsim
