#include "calibrated/echo_grid.h"

#include <algorithm>
#include <cmath>

namespace sonarsim {

namespace {

constexpr std::size_t floats_per_line = 16;

std::size_t stride_of(int rows, std::size_t front) {
    // One bin behind the last as well, then whole cache lines, of an odd number: with a power of
    // two all columns would compete for the same places of the cache.
    const std::size_t lines = (front + 2 * (rows + 1)) / floats_per_line + 1;
    return (lines | 1U) * floats_per_line;
}

}  // namespace

EchoGrid::EchoGrid(int rows, int columns)
    : rows_(rows),
      columns_(columns),
      stride_(stride_of(rows, front)),
      values_(stride_ * columns + floats_per_line) {}

std::size_t EchoGrid::smear(const RangeTaps& taps) {
    const std::size_t length = 2 * static_cast<std::size_t>(rows_);
    const std::size_t beside = 2 * static_cast<std::size_t>(taps.reach);
    std::vector<float> padded(length + 2 * beside);
    float* const middle = padded.data() + beside;
    std::size_t lit = 0;
    for (int c = 0; c < columns_; ++c) {
        float* const __restrict values = column(c);
        std::copy_n(values, length, middle);
        int echoes = 0;
        for (std::size_t i = 0; i < length; i += 2)
            echoes += values[i] != 0.0F || values[i + 1] != 0.0F ? 1 : 0;
        lit += echoes;
        if (echoes == 0) continue;
        std::fill_n(values, length, 0.0F);
        for (std::size_t t = 0; t < taps.taps.size(); ++t) {
            const float tap = taps.taps[t];
            const float* const __restrict shifted = padded.data() + 2 * t;
            for (std::size_t i = 0; i < length; ++i)
                values[i] = std::fma(tap, shifted[i], values[i]);
        }
    }
    return lit;
}

}  // namespace sonarsim
