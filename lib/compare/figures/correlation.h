#pragma once

#include <span>

#include "compare/figures/patches.h"

namespace sonarsim {

/// The correlation of amplitudes that lie `lag` ranges apart in a patch; NaN where they are all
/// equal.
double range_correlation(std::span<const float> amplitudes, PatchSize size, int lag);

/// The same of amplitudes that lie `lag` beams apart.
double beam_correlation(std::span<const float> amplitudes, PatchSize size, int lag);

/// The correlation of two patches, of one place in two pings.
double ping_correlation(std::span<const float> one, std::span<const float> other);

}  // namespace sonarsim
