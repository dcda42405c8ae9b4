#pragma once

#include <array>
#include <vector>

#include "calibrate/log_statistics.h"
#include "calibrate/patches.h"
#include "mission/instrument.h"

namespace sonarsim {

// A receiver that makes one value of several samples changes ln P. The samples of a bin are
// correlated by the pulse, and there is no closed form for the largest of them. So these numbers
// are simulated: the pulse's taps filter a white sequence, which is combined as in the model. A
// result is the closed form for single samples plus the simulated difference between combined and
// single samples.

/// The statistics of values. `taps`: the pulse at steps of the samples.
LogStatistics sampled_statistics(const ReceiverConfig& receiver, const std::vector<double>& taps);

/// The correlations of ln P 1 to patch_lags bins apart.
std::array<double, patch_lags> sampled_range_correlations(const ReceiverConfig& receiver,
                                                          const std::vector<double>& taps);

}  // namespace sonarsim
