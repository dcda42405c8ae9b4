#pragma once

#include <cstdint>
#include <string>

#include "core/random.h"
#include "input/mission/variation_keys.h"

namespace sonarsim {

/// Draws a value of a rule, or the factor of `scale`, and returns it as YAML text: for a variant, or with
/// Stream::ping_variation for a ping. Throws InputError at the rule's place when `within` is too
/// narrow.
std::string draw_value(const VaryConfig& rule, std::uint64_t seed, std::uint32_t rule_index,
                       std::uint32_t number, Stream stream = Stream::variation);

/// The share of a rule's normal draws that lie within `within`; 1 for a rule without `within`.
double share_within(const VaryConfig& rule);

}  // namespace sonarsim
