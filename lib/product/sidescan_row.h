#pragma once

#include <optional>
#include <vector>

#include "ping/ping.h"
#include "ping/sonar.h"

namespace sonarsim {

/// A side-scan ping as a row of the waterfall: port from range_max to range_min, then starboard
/// from range_min to range_max; 2 x range_bins values.
std::vector<float> sidescan_row(const Ping& ping);

/// Slant range of the first bottom return on either side, m: the middle of its bin
/// (first_return() in product/bottom.h). Nothing where a side is dark.
struct FirstReturns {
    std::optional<double> port_m;
    std::optional<double> starboard_m;
};
FirstReturns first_returns(const Sonar& sonar, const Ping& ping);

}  // namespace sonarsim
