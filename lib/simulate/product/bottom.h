#pragma once

#include <optional>
#include <span>

namespace sonarsim {

/// The bin of the bottom's first return in a column of range bins from near to far; nothing when
/// the column is dark. It is the leading edge: the first bin at which the running mean over three
/// bins, which suppresses single bright speckles, reaches half of its maximum.
std::optional<int> first_return(std::span<const float> column);

/// The bin of the bottom's first return on one side of a side-scan ping; nothing if none stands
/// out.
///
/// A beam that points to the side receives little from straight below, and before the bottom are
/// the ring-down and noise, so that a share of the maximum does not tell. The logarithms of the
/// running mean are compared in two windows that meet, each a 64th or a 32nd of the column: the
/// bottom is the first rise to at least twice the value that exceeds five deviations of chance, and
/// its edge lies half way up, in logarithms. A rise behind which the column falls back within two
/// to four windows is of a thing in the water, and counts only if no other follows. A bottom in the
/// first half window has no water before it. `water_surface`: the bin at which the water's surface
/// above the sonar is due, if it scatters; a rise within two windows of it does not count, and
/// one beyond is of the bottom from six times the value on, else there is none.
std::optional<int> first_return_of_swath(std::span<const float> column,
                                         std::optional<int> water_surface = {});

}  // namespace sonarsim
