#pragma once

#include <array>
#include <vector>

#include "calibrate/log_statistics.h"
#include "calibrate/patches.h"
#include "mission/instrument.h"

namespace sonarsim {

// A receiver that makes one value of several samples changes ln P. The samples of a bin are
// correlated by the pulse, and there is no closed form for the largest of them. So these numbers
// are drawn: a white sequence behind the pulse's taps, combined as the model combines it. Each
// drawn number is corrected by what the same draws give for single samples, for which the closed
// form is known.

/// The statistics of values, `taps` the pulse at steps of the samples.
LogStatistics sampled_statistics(const ReceiverConfig& receiver, const std::vector<double>& taps);

/// The correlations of ln P 1 to patch_lags bins apart.
std::array<double, patch_lags> sampled_range_correlations(const ReceiverConfig& receiver,
                                                          const std::vector<double>& taps);

}  // namespace sonarsim
