#pragma once

#include <span>

namespace sonarsim {

/// A surface return detected in a beam: the run of bins [begin, end).
struct DetectedReturn {
    int begin = 0;
    int end = 0;          ///< equal to begin if nothing was detected
    double contrast = 0;  ///< sum over the run of (value - mean of the beam) / sqrt(length)
    double rival = 0;     ///< the greatest contrast of a run elsewhere; 0: none
};

/// Finds the run of bins of the greatest contrast. In white noise of unit variance, half of its
/// square is the log of the likelihood ratio of a surface of constant brightness against no
/// surface.
DetectedReturn detect_return(std::span<const double> beam);

}  // namespace sonarsim
