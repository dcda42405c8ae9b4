#pragma once

#include <cstdint>

namespace sonarsim {

/// Two sets of rays that sample the same surface independently of each other. Where neighbouring
/// columns disagree, the first set has the middle strip of a column and the second its two edge
/// strips. Surface that only one of two neighbouring rays of a column met belongs to the first set
/// or the second, by the number of that ray. All other surface was met by both sets.
enum class RaySet : std::uint8_t { both, first, second, middle_strip, edge_strips };
constexpr int ray_sets = 5;

}  // namespace sonarsim
