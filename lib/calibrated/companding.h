#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mission/instrument.h"

namespace sonarsim {

/// The integers that the instrument delivers, of `bits` bits, with M the greatest. They follow from
/// the powers over full scale, clipped at 1; A is the root of the power:
///
///     gamma     M A^gamma
///     log       M (1 + 20 log10(A) / dynamic_range_db), 0 below
///     linear    M A
std::vector<std::uint16_t> companded(std::span<const float> powers, const ReceiverConfig& receiver);

}  // namespace sonarsim
