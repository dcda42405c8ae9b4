#pragma once

#include <optional>
#include <span>

namespace sonarsim {

/// The bin of the bottom's first return in a column of range bins from near to far; nothing when
/// the column is dark.
///
/// The return is detected at its leading edge: the first bin at which the running mean over three
/// bins reaches half of the bottom's level. The running mean suppresses single bright speckles. The
/// level is the quantile of the running mean that the share `brighter` of all bins exceeds: 0 gives
/// the maximum, which suits a single beam; with 0.1 a few strong targets on the bottom do not raise
/// the level, which suits a swath. If the quantile is 0, the maximum is used.
std::optional<int> first_return(std::span<const float> column, double brighter);

/// The bin of the bottom's first return on one side of a side-scan ping. A beam that points to the
/// side receives little from straight below, so the edge lies far below half of the bottom's level:
/// the threshold is the geometric mean of this level (0.1 of the bins are brighter) and that of the
/// water, at least a thousandth of the bottom's. The water's is the greatest running mean within
/// two thirds of the range at which first_return() finds the bottom, since noise grows with the
/// range. If this threshold is above a tenth of the bottom's level, as with much noise, the result
/// is that of first_return().
std::optional<int> first_return_of_swath(std::span<const float> column);

}  // namespace sonarsim
