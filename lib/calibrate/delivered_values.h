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

/// The units of an offset's interval. Patches of one range share its trend, so ranges are the
/// units. They are few, so the existence of an offset is tested with places as units.
enum class OffsetUnits { ranges, places };

/// The offset that a receiver with a power law subtracts from its values, as a share of full_value:
/// v = M A^g - o. The standard deviation of A^g is proportional to its mean, so that of v is b
/// (mean + o): a line through the deviations of patches by their means, whose errors are
/// proportional to the mean. The deviations are taken within one range, so a gain by range does not
/// add to them. Nothing for fewer than 24 patches or patches of one level. `places` of a patch
/// grid: all if empty.
std::optional<Bounded> fit_offset(const std::vector<RecordedPing>& pings, double full_value,
                                  const std::vector<bool>& places = {},
                                  OffsetUnits units = OffsetUnits::ranges);

}  // namespace sonarsim
