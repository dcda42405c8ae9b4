#pragma once

#include <string>

#include "compare/compare.h"

namespace sonarsim {

/// A picture of a comparison, SVG: the levels by range of both, and below them the standardised
/// difference of each figure with its 95 % limits.
std::string comparison_svg(const Comparison& comparison);

}  // namespace sonarsim
