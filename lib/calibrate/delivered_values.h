#pragma once

#include <optional>
#include <vector>

#include "calibrate/bootstrap.h"
#include "recording/recording.h"

namespace sonarsim {

/// The number of bits: log2(full_value / step + 1), where the step is the greatest one that all
/// values are whole multiples of. Nothing for values that are not whole, or where this is no whole
/// number.
std::optional<int> bits_of(const std::vector<RecordedPing>& pings, double full_value);

/// The units of an offset's interval. Patches of one range share its trend, so ranges are: there
/// are few, and whether there is an offset at all shows in places.
enum class OffsetUnits { ranges, places };

/// The offset that a receiver with a power law takes from its values, as a share of full_value: v =
/// M A^g - o. The standard deviation of A^g is proportional to its mean, so that of v is b (mean +
/// o): a line through the deviations of patches by their means, whose errors are proportional to
/// the mean. The deviations are those of one range, which no gain by range adds to. Nothing for
/// fewer than 24 patches or patches of one level. `places` of a patch grid: all if empty.
std::optional<Bounded> fit_offset(const std::vector<RecordedPing>& pings, double full_value,
                                  const std::vector<bool>& places = {},
                                  OffsetUnits units = OffsetUnits::ranges);

}  // namespace sonarsim
