#include "trace/doppler_loss.h"

#include <algorithm>
#include <cmath>

#include "core/elementary.h"
#include "core/units.h"

namespace sonarsim {

double passed_by_filter(const DopplerLoss& loss, double recedes_m_s) {
    const double half_turn = pi * loss.turns_s_per_m * recedes_m_s;
    const double tone = half_turn == 0.0 ? 1.0 : sincos(half_turn).sin / half_turn;
    const double sweep = std::max(1.0 - std::fabs(loss.band_s_per_m * recedes_m_s), 0.0);
    return tone * tone * sweep * sweep;
}

}  // namespace sonarsim
