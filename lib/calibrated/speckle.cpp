#include "calibrated/speckle.h"

#include <algorithm>
#include <array>

#include "calibrated/lanes.h"
#include "calibrated/normals.h"

namespace sonarsim {

namespace {

/// Draws the amplitudes of 8 bins from `row` on. `half`: half of the gain, since the real and the
/// imaginary part of a draw each have variance 1.
void draw_eight(float* cells, int row, int column, float half, PhiloxKey key) {
    const Floats8 power = real_parts(cells);
    if ((power != 0.0F).bits() == 0U) return;
    std::array<std::uint32_t, lanes_at_once> a, b;
    for (int lane = 0; lane < lanes_at_once; ++lane) {
        a[lane] = static_cast<std::uint32_t>(row + lane);
        b[lane] = static_cast<std::uint32_t>(column);
    }
    philox_pairs(a.data(), b.data(), lanes_at_once, key);
    Lanes re, im;
    complex_normals(a.data(), re, im);
    const Floats8 amplitude = sqrt(half * power);
    store_complex(amplitude * Floats8::load(re.data()), amplitude * Floats8::load(im.data()),
                  cells);
}

}  // namespace

void draw_speckle(EchoGrid& grid, float gain, PhiloxKey key) {
    const float half = 0.5F * gain;
    const int whole = grid.rows() / lanes_at_once * lanes_at_once;
    const int left = grid.rows() - whole;
    for (int c = 0; c < grid.columns(); ++c) {
        float* const values = grid.column(c);
        for (int row = 0; row < whole; row += lanes_at_once)
            draw_eight(values + std::ptrdiff_t{2} * row, row, c, half, key);
        if (left == 0) continue;
        std::array<float, std::size_t{2} * lanes_at_once> last{};
        float* const end = values + std::ptrdiff_t{2} * whole;
        std::copy_n(end, 2 * left, last.begin());
        draw_eight(last.data(), whole, c, half, key);
        std::copy_n(last.begin(), 2 * left, end);
    }
}

}  // namespace sonarsim
