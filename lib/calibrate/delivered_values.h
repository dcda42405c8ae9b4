#pragma once

#include <optional>
#include <vector>

#include "calibrate/bootstrap.h"
#include "recording/recording.h"

namespace sonarsim {

/// The number of bits: log2(full_value / step + 1), where the step is the greatest common divisor
/// of all values. Nothing if a value or the number of bits is not whole.
std::optional<int> bits_of(const std::vector<RecordedPing>& pings, double full_value);

/// The units of the bootstrap for an offset. Patches of one range share its trend, so ranges are
/// the units. They are few, so the existence of an offset is tested with places as units.
enum class OffsetUnits { ranges, places };

/// The offset that a receiver with a power law subtracts from its values, as a share of full_value:
/// v = M A^g - o. The standard deviation of A^g is proportional to its mean, so the standard
/// deviation of v is b (mean + o). A line is fitted to the patches' deviations against their means,
/// with errors proportional to the mean. The deviations are taken within one range, so a gain by
/// range does not add to them. Nothing for fewer than 24 patches or patches of one level. `places`
/// of a patch grid: all if empty.
std::optional<Bounded> fit_offset(const std::vector<RecordedPing>& pings, double full_value,
                                  const std::vector<bool>& places = {},
                                  OffsetUnits units = OffsetUnits::ranges);

}  // namespace sonarsim
