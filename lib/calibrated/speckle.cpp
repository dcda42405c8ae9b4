#include "calibrated/speckle.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "calibrated/normals.h"

namespace sonarsim {

void draw_speckle(EchoGrid& grid, float gain, PhiloxKey key) {
    std::array<std::uint32_t, lanes_at_once> a, b;
    Lanes re, im;
    // The real and the imaginary part each have variance 1; halved for unit mean power.
    const float half = 0.5F * gain;
    for (int c = 0; c < grid.columns(); ++c) {
        float* const values = grid.column(c);
        for (int row = 0; row < grid.rows(); row += lanes_at_once) {
            const int count = std::min(lanes_at_once, grid.rows() - row);
            float any = 0.0F;
            for (int lane = 0; lane < count; ++lane)
                any += values[std::ptrdiff_t{2} * (row + lane)];
            if (any == 0.0F) continue;
            for (int lane = 0; lane < lanes_at_once; ++lane) {
                a[lane] = static_cast<std::uint32_t>(row + lane);
                b[lane] = static_cast<std::uint32_t>(c);
            }
            philox_pairs(a.data(), b.data(), lanes_at_once, key);
            complex_normals(a.data(), re, im);
            for (int lane = 0; lane < count; ++lane) {
                float* const cell = values + static_cast<std::ptrdiff_t>(2) * (row + lane);
                const float amplitude = std::sqrt(half * cell[0]);
                cell[0] = amplitude * re[lane];
                cell[1] = amplitude * im[lane];
            }
        }
    }
}

}  // namespace sonarsim
