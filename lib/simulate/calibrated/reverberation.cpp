#include "simulate/calibrated/reverberation.h"

#include <cmath>
#include <cstddef>
#include <vector>

#include "core/elementary.h"
#include "core/lanes.h"
#include "simulate/calibrated/decibel.h"

namespace sonarsim {

namespace {

// A tail this far below the echo in the same bin changes it by at most a grey, and is left out.
constexpr float negligible = 0.003F;

}  // namespace

Reverberation::Reverberation(const ReceiverConfig& receiver, double bin_m, double sound_speed_m_s) {
    if (!(receiver.reverberation_s > 0.0)) return;
    share = static_cast<float>(power_of_db(receiver.reverberation_db));
    const double bin_s = 2.0 * bin_m / sound_speed_m_s;
    decay = static_cast<float>(power(10.0, -6.0 * bin_s / receiver.reverberation_s));
}

void add_reverberation(const Reverberation& tail, PowerForm form, PhiloxKey key, EchoGrid& grid) {
    if (!(tail.share > 0.0F)) return;
    const float gain = (1.0F - tail.decay) * tail.share;
    const int padded = (grid.rows() + lanes - 1) / lanes * lanes;
    std::vector<float> powers(static_cast<std::size_t>(padded));
    for (int c = 0; c < grid.columns(); ++c) {
        const float* const cells = grid.column(c);
        for (int row = 0; row < grid.rows(); ++row) {
            const float re = cells[std::ptrdiff_t{2} * row];
            const float im = cells[std::ptrdiff_t{2} * row + 1];
            powers[row] = form == PowerForm::power ? re : std::fma(re, re, im * im);
        }
        float reverberant = 0.0F;
        for (int row = 0; row < grid.rows(); ++row) {
            const float echo = powers[row];
            powers[row] = reverberant > negligible * echo ? reverberant : 0.0F;
            reverberant = std::fma(tail.decay, reverberant, gain * echo);
        }
        add_drawn(form, powers, 1.0F, c, key, grid);
    }
}

}  // namespace sonarsim
