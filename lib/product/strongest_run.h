#pragma once

#include <span>

namespace sonarsim {

/// A run of bins, [begin, end), that stands out of a beam.
struct StrongRun {
    int begin = 0;
    int end = 0;          ///< equal to begin where nothing stands out
    double contrast = 0;  ///< sum over the run of (value - mean of the beam) / sqrt(length)
    double rival = 0;     ///< the greatest contrast of a run elsewhere, 0 where there is none
};

/// The run of the greatest contrast. In white noise its square is the likelihood ratio of a surface
/// of constant brightness, of unknown place and length, against none.
StrongRun strongest_run(std::span<const double> beam);

}  // namespace sonarsim
