#pragma once

#include <optional>
#include <span>

namespace sonarsim {

/// The bin in which the bottom first echoes, in a column of range bins from near to far; nothing
/// when all of it is dark.
///
/// It is a leading edge: where the running mean over three bins, which a single bright speckle
/// cannot lift far, first reaches half of the level at which the bottom echoes. That level is what
/// the running mean exceeds in the share `brighter` of all bins: with 0 its maximum, which suits a
/// single beam; with 0.1 a few strong targets on the bottom do not raise it, which suits a swath.
/// If that is 0, the maximum counts.
std::optional<int> first_return(std::span<const float> column, double brighter);

}  // namespace sonarsim
