#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "input/mission/instrument.h"

namespace sonarsim {

/// The integers of `bits` bits that the instrument delivers. The powers are relative to full scale
/// and clipped at 1. A is the root of a power and M the greatest integer; `offset` times M is
/// subtracted, down to 0:
///
///     gamma     M A^gamma
///     log       M (1 + 20 log10(A) / dynamic_range_db), 0 below
///     linear    M A
std::vector<std::uint16_t> companded(std::span<const float> powers, const ReceiverConfig& receiver);

}  // namespace sonarsim
