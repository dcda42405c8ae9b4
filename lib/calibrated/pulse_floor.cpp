#include "calibrated/pulse_floor.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "calibrated/decibel.h"
#include "core/lanes.h"

namespace sonarsim {

namespace {

constexpr double no_floor_db = -300.0;

void add_powers_of(const EchoGrid& amplitudes, int column, float gain, std::span<float> powers) {
    const float* const cells = amplitudes.column(column);
    for (std::ptrdiff_t row = 0; row < amplitudes.rows(); ++row) {
        const float re = cells[2 * row];
        const float im = cells[2 * row + 1];
        powers[row] += gain * std::fma(re, re, im * im);
    }
}

/// The sums over `reach` bins to either side, times a share. `sums` may have more bins.
void spread(const PulseFloor& floor, std::span<const float> powers, std::span<float> sums) {
    const int rows = static_cast<int>(powers.size());
    double sum = 0.0;
    for (int row = -floor.reach; row < rows; ++row) {
        const int enters = row + floor.reach;
        const int leaves = row - floor.reach - 1;
        if (enters < rows) sum += powers[enters];
        if (leaves >= 0) sum -= powers[leaves];
        if (row >= 0) sums[row] = floor.share * static_cast<float>(std::max(sum, 0.0));
    }
}

}  // namespace

PulseFloor pulse_floor(const PulseConfig& pulse, double bin_m, double sound_speed_m_s) {
    if (pulse.floor_db <= no_floor_db) return {};
    const double reach = 0.5 * sound_speed_m_s * pulse.duration_s / bin_m;
    const int bins = static_cast<int>(std::min(reach + 0.5, 1e6));
    if (bins == 0) return {};
    return {.reach = bins,
            .share = static_cast<float>(power_of_db(pulse.floor_db) / (2.0 * bins + 1.0))};
}

void add_pulse_floor(const PulseFloor& floor, PowerForm form, float gain, PhiloxKey key,
                     const EchoGrid* coherent, EchoGrid& grid) {
    const int padded = (grid.rows() + lanes - 1) / lanes * lanes;
    std::vector<float> powers(grid.rows());
    std::vector<float> sums(padded, 0.0F);
    for (int column = 0; column < grid.columns(); ++column) {
        std::ranges::fill(powers, 0.0F);
        if (form == PowerForm::amplitude) {
            add_powers_of(grid, column, gain, powers);
        } else {
            const float* const cells = grid.column(column);
            for (std::ptrdiff_t row = 0; row < grid.rows(); ++row)
                powers[row] = std::max(cells[2 * row], 0.0F);
        }
        if (coherent != nullptr) add_powers_of(*coherent, column, gain, powers);
        spread(floor, powers, sums);
        add_drawn(form, sums, 1.0F, column, key, grid);
    }
}

}  // namespace sonarsim
