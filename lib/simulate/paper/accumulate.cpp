#include "simulate/paper/accumulate.h"

#include <xmmintrin.h>

#include <algorithm>

namespace sonarsim {

namespace {

constexpr int tile = 4;

/// Writes the first 4 values of 4 lists, `from_step` apart, as columns of 4 rows, `to_step` apart.
void write_transposed(const float* from, std::size_t from_step, float* to, std::size_t to_step) {
    __m128 a = _mm_loadu_ps(from);
    __m128 b = _mm_loadu_ps(from + from_step);
    __m128 c = _mm_loadu_ps(from + 2 * from_step);
    __m128 d = _mm_loadu_ps(from + 3 * from_step);
    _MM_TRANSPOSE4_PS(a, b, c, d);
    _mm_storeu_ps(to, a);
    _mm_storeu_ps(to + to_step, b);
    _mm_storeu_ps(to + 2 * to_step, c);
    _mm_storeu_ps(to + 3 * to_step, d);
}

}  // namespace

std::uint64_t mean_of_bins(const BinSums& sums, std::span<float> intensity) {
    int occupied = 0;
    const auto first = static_cast<std::size_t>(sums.first);
    const auto end = static_cast<std::size_t>(sums.end);
    std::fill(intensity.begin(), intensity.begin() + sums.first, 0.0F);
    std::fill(intensity.begin() + sums.end, intensity.end(), 0.0F);
    for (std::size_t i = first; i < end; ++i) {
        const float weight = sums.weight(i);
        const bool seen = weight > 0.0F;
        intensity[i] = seen ? sums.echo(i) / weight : 0.0F;
        occupied += seen ? 1 : 0;
    }
    return occupied;
}

void write_beams(std::span<const float> by_beam, int beams, int first, int columns,
                 std::span<float> image) {
    const std::size_t rows = image.size() / columns;
    const std::size_t whole_rows = rows / tile * tile;
    const int whole_beams = beams / tile * tile;
    float* const to = image.data() + first;
    for (std::size_t i = 0; i < whole_rows; i += tile) {
        for (int j = 0; j < whole_beams; j += tile)
            write_transposed(by_beam.data() + j * rows + i, rows, to + i * columns + j, columns);
    }
    for (std::size_t i = 0; i < rows; ++i) {
        for (int j = i < whole_rows ? whole_beams : 0; j < beams; ++j)
            to[i * columns + j] = by_beam[j * rows + i];
    }
}

}  // namespace sonarsim
