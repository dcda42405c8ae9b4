#include "simulate/calibrated/speckle.h"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "core/lanes.h"
#include "simulate/calibrated/normals.h"

namespace sonarsim {

namespace {

void add_to_eight(float* cells, Floats8 re, Floats8 im) {
    std::array<float, std::size_t{2} * lanes> added;
    store_complex(re, im, added.data());
    (Floats8::load(cells) + Floats8::load(added.data())).store(cells);
    (Floats8::load(cells + lanes) + Floats8::load(added.data() + lanes)).store(cells + lanes);
}

}  // namespace

void add_drawn(PowerForm form, std::span<const float> powers, float gain, int column, PhiloxKey key,
               EchoGrid& grid) {
    float* const cells = grid.column(column);
    const auto count = static_cast<int>(powers.size());
    // Half of the gain, since the real and the imaginary part of a draw each have variance 1.
    const float half_gain = 0.5F * gain;
    for (int row = 0; row < count; row += drawn_together) {
        const auto power_at = [&](int at) -> Floats8 {
            return at < count ? greatest(Floats8::load(powers.data() + at), 0.0F) : 0.0F;
        };
        const std::array<Floats8, 2> power{power_at(row), power_at(row + lanes)};
        if (((power[0] != 0.0F).bits() | (power[1] != 0.0F).bits()) == 0U) continue;
        std::optional<std::array<Complexes8, 2>> normals;
        if (form == PowerForm::amplitude) normals = column_normals(row, column, key);
        for (int k = 0; k < 2 && row + k * lanes < count; ++k) {
            float* const to = cells + std::ptrdiff_t{2} * (row + k * lanes);
            if (!normals) {
                add_to_eight(to, power[k], 0.0F);
                continue;
            }
            const Floats8 amplitude = sqrt(half_gain * power[k]);
            add_to_eight(to, amplitude * (*normals)[k].re, amplitude * (*normals)[k].im);
        }
    }
}

void draw_speckle(EchoGrid& grid, float gain, PhiloxKey key) {
    std::vector<float> powers((grid.rows() + lanes - 1) / lanes * lanes);
    for (int c = 0; c < grid.columns(); ++c) {
        float* const cells = grid.column(c);
        for (int row = 0; row < grid.rows(); ++row)
            powers[row] = cells[std::ptrdiff_t{2} * row];
        std::fill_n(cells, std::ptrdiff_t{2} * grid.rows(), 0.0F);
        add_drawn(PowerForm::amplitude, powers, gain, c, key, grid);
    }
}

}  // namespace sonarsim
