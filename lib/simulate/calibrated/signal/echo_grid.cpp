#include "simulate/calibrated/signal/echo_grid.h"

#include <algorithm>
#include <cmath>

#include "core/lanes.h"

namespace sonarsim {

namespace {

constexpr std::size_t floats_per_line = 16;

std::size_t stride_of(int rows, std::size_t front) {
    // Room for one bin after the last, in an odd number of whole cache lines: with a power of two
    // all columns would compete for the same sets of the cache.
    const std::size_t lines =
        (front + 2 * (static_cast<std::size_t>(rows) + 1)) / floats_per_line + 1;
    return (lines | 1U) * floats_per_line;
}

/// The number of complex numbers in a line that are not 0.
int count_occupied(const float* line) {
    const unsigned any = (Floats8::load(line) != 0.0F).bits() |
                         (Floats8::load(line + lanes) != 0.0F).bits() << lanes;
    return std::popcount((any | any >> 1) & 0x5555U);
}

}  // namespace

EchoGrid::EchoGrid(int rows, int columns)
    : rows_(rows),
      columns_(columns),
      stride_(stride_of(rows, front)),
      values_(stride_ * columns + floats_per_line) {}

void EchoGrid::add(const EchoGrid& more) {
    for (int c = 0; c < columns_; ++c) {
        const float* const __restrict from = more.column(c);
        float* const __restrict to = column(c);
        for (int i = 0; i < 2 * rows_; ++i)
            to[i] += from[i];
    }
}

std::size_t EchoGrid::occupied() const {
    const std::size_t length = 2 * static_cast<std::size_t>(rows_);
    const std::size_t whole = length / floats_per_line * floats_per_line;
    std::size_t cells = 0;
    for (int c = 0; c < columns_; ++c) {
        const float* const values = column(c);
        for (std::size_t i = 0; i < whole; i += floats_per_line)
            cells += count_occupied(values + i);
        for (std::size_t i = whole; i < length; i += 2)
            cells += values[i] != 0.0F || values[i + 1] != 0.0F ? 1 : 0;
    }
    return cells;
}

void EchoGrid::convolve_pulse(const RangeTaps& taps, std::span<const float> power_gains,
                              bool powers) {
    const std::size_t length = 2 * static_cast<std::size_t>(rows_);
    const std::size_t margin = 2 * static_cast<std::size_t>(taps.reach);
    // Whole cache lines are written; a column has room for them.
    const std::size_t lines = (length + floats_per_line - 1) / floats_per_line;
    std::vector<float> padded(lines * floats_per_line + 2 * margin);
    float* const middle = padded.data() + margin;
    auto weights = taps.taps;
    for (int c = 0; c < columns_; ++c) {
        float* const values = column(c);
        std::copy_n(values, length, middle);
        int echoes = 0;
        for (std::size_t i = 0; i < lines * floats_per_line; i += floats_per_line)
            echoes += count_occupied(middle + i);
        if (echoes == 0) continue;
        if (!power_gains.empty()) {
            const float gain = powers ? power_gains[c] : std::sqrt(power_gains[c]);
            for (std::size_t k = 0; k < weights.size(); ++k)
                weights[k] = gain * taps.taps[k];
        }
        for (std::size_t i = 0; i < lines * floats_per_line; i += floats_per_line) {
            Floats8 one = 0.0F;
            Floats8 other = 0.0F;
            const float* shifted = padded.data() + i;
            for (const float tap : weights) {
                one = fma(tap, Floats8::load(shifted), one);
                other = fma(tap, Floats8::load(shifted + lanes), other);
                shifted += 2;
            }
            one.store(values + i);
            other.store(values + i + lanes);
        }
    }
}

}  // namespace sonarsim
