#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "simulate/ping/sonar.h"
#include "simulate/trace/ping.h"

namespace sonarsim {

// A row of a side-scan waterfall runs from port at range_max over nadir to starboard at range_max,
// in columns as wide as a range bin. It has blank columns between nadir and range_min, where the
// sonar does not listen, so that slant range is linear in the column on both sides.

/// The beams of a side-scan ping.
struct Side {
    static constexpr int starboard = 0, port = 1;
};

/// The number of columns between nadir and range_min on each side: range_min in bins, rounded.
int blank_columns(const SonarConfig& config);

/// The slant range of a column less its distance from nadir, at most half a bin to either side of
/// 0: range_min may be no multiple of a bin.
double column_offset_m(const SonarConfig& config);

/// The number of columns of the whole row.
int waterfall_columns(const SonarConfig& config);

/// The bin of a side-scan ping, [range bins, 2] like Ping::intensity, that each column shows; -1
/// where the sonar does not listen.
std::vector<std::int32_t> waterfall_bins(const SonarConfig& config);

/// Slant range of the first bottom return in a beam, m: the middle of its bin
/// (first_return_of_swath()). Nothing if the side is dark.
std::optional<double> first_return_m(const Sonar& sonar, const Ping& ping, int beam);

}  // namespace sonarsim
