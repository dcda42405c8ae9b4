#pragma once

#include <optional>
#include <span>

namespace sonarsim {

/// The bin of the bottom's first return in a column of range bins from near to far; nothing when
/// the column is dark. It is the leading edge: the first bin at which the running mean over three
/// bins, which suppresses single bright speckles, reaches half of its maximum.
std::optional<int> first_return(std::span<const float> column);

}  // namespace sonarsim
