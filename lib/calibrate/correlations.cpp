#include "calibrate/correlations.h"

#include <cmath>

namespace sonarsim {

Correlations correlations_of(const std::vector<PatchMoments>& patches,
                             const std::vector<std::size_t>& chosen,
                             const std::vector<double>& weights) {
    Correlations out;
    double variance = 0.0;
    for (const std::size_t k : chosen) {
        const PatchMoments& patch = patches[k];
        const double w = weights[static_cast<std::size_t>(patch.place)];
        variance += w * patch.variance;
        for (std::size_t lag = 0; lag < patch_lags; ++lag) {
            out.along_range[lag] += w * patch.along_range[lag];
            out.along_beams[lag] += w * patch.along_beams[lag];
        }
        ++out.patches;
    }
    for (std::size_t lag = 0; lag < patch_lags; ++lag) {
        out.along_range[lag] = 1.0 - out.along_range[lag] / variance;
        out.along_beams[lag] = 1.0 - out.along_beams[lag] / variance;
    }
    return out;
}

}  // namespace sonarsim
