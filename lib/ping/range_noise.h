#pragma once

#include "core/random.h"
#include "ping/echoes.h"

namespace sonarsim {

/// [7-8]: every scatterer cell draws w from the exponential distribution of mean `lambda_m`; its
/// echoes come w later, and, where `fades`, weaker by exp(-w / lambda).
void add_range_noise(Echoes& echoes, float lambda_m, bool fades, PhiloxKey key);

}  // namespace sonarsim
