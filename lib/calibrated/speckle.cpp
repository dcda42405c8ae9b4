#include "calibrated/speckle.h"

#include <algorithm>
#include <array>

#include "calibrated/normals.h"
#include "core/lanes.h"

namespace sonarsim {

namespace {

/// Draws the amplitudes of bins from `row` on, as many as are drawn together. `half`: half of the
/// gain, since the real and the imaginary part of a draw each have variance 1.
void draw_bins(float* cells, int row, int column, float half, PhiloxKey key) {
    float* const later = cells + std::ptrdiff_t{2} * lanes;
    const Floats8 power = real_parts(cells);
    const Floats8 later_power = real_parts(later);
    if (((power != 0.0F).bits() | (later_power != 0.0F).bits()) == 0U) return;
    const std::array<Complexes8, 2> normals = column_normals(row, column, key);
    const auto put = [&](Floats8 of, const Complexes8& normal, float* to) {
        const Floats8 amplitude = sqrt(half * of);
        store_complex(amplitude * normal.re, amplitude * normal.im, to);
    };
    put(power, normals[0], cells);
    put(later_power, normals[1], later);
}

}  // namespace

void draw_speckle(EchoGrid& grid, float gain, PhiloxKey key) {
    const float half = 0.5F * gain;
    const int whole = grid.rows() / drawn_together * drawn_together;
    const int left = grid.rows() - whole;
    for (int c = 0; c < grid.columns(); ++c) {
        float* const values = grid.column(c);
        for (int row = 0; row < whole; row += drawn_together)
            draw_bins(values + std::ptrdiff_t{2} * row, row, c, half, key);
        if (left == 0) continue;
        std::array<float, std::size_t{2} * drawn_together> last{};
        float* const end = values + std::ptrdiff_t{2} * whole;
        std::copy_n(end, 2 * left, last.begin());
        draw_bins(last.data(), whole, c, half, key);
        std::copy_n(last.begin(), 2 * left, end);
    }
}

}  // namespace sonarsim
