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

}  // namespace sonarsim
