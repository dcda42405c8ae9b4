#pragma once

#include <cstdint>

namespace sonarsim {

/// Two sets of rays that sample the same surface independently of each other. Where neighbouring
/// columns disagree, the middle strip of a column is the first set and its two edge strips are the
/// second. Surface that only one of two neighbouring rays of a column met belongs to the first set
/// or the second, by the number of that ray. All other surface was met by both sets.
enum class RaySet : std::uint8_t { both, first, second };
constexpr int ray_sets = 3;

}  // namespace sonarsim
