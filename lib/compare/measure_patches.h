#pragma once

#include <string>

#include "compare/images.h"
#include "compare/measured.h"

namespace sonarsim {

/// The figures of patches in one zone: statistics and correlations of amplitudes without their
/// trend, and the level. `name` is that of the zone. A patch counts if its trend's standard
/// deviation is at most `most_trend` of its mean and no more than 3 % of its values lie at the two
/// ends of the scale.
void measure_zone(const RecordedImages& images, PatchSize size, RangeZone zone,
                  const std::string& name, double most_trend, Measurement& out);

}  // namespace sonarsim
