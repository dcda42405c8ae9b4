#pragma once

#include <string>

#include "compare/compare.h"

namespace sonarsim {

/// A picture of a comparison, SVG: the levels by range of both, and below the standardised
/// difference of each figure with the borders of 95 %.
std::string comparison_svg(const Comparison& comparison);

}  // namespace sonarsim
