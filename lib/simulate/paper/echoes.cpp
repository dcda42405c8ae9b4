#include "simulate/paper/echoes.h"

#include <xmmintrin.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "simulate/paper/footprint.h"
#include "simulate/trace/arrivals.h"

namespace sonarsim {

namespace {

constexpr int lanes = 8;

constexpr std::array<float, lanes> lane_numbers = {0, 1, 2, 3, 4, 5, 6, 7};

/// The destination of the echoes of a footprint.
struct EchoSlots {
    float* range_m;
    float* half_m;
    float* weight;
    float* intensity;
    std::uint32_t* cell_low;  ///< null without scatterer cells
    std::uint32_t* cell_high;
};

EchoSlots slots_at(Echoes& echoes, std::size_t at, bool cells) {
    return {.range_m = echoes.range_m.data() + at,
            .half_m = echoes.half_m.data() + at,
            .weight = echoes.weight.data() + at,
            .intensity = echoes.intensity.data() + at,
            .cell_low = cells ? echoes.cell_low.data() + at : nullptr,
            .cell_high = cells ? echoes.cell_high.data() + at : nullptr};
}

std::int32_t whole(float x) {
    return static_cast<std::int32_t>(std::floor(x));
}

/// c + s u + t v of footprint k, along one axis.
float along(const Footprints::Vectors& c, const Footprints::Vectors& u,
            const Footprints::Vectors& v, int axis, std::size_t k, float s, float t) {
    return std::fma(s, u[axis][k], std::fma(t, v[axis][k], c[axis][k]));
}

/// Writes the echoes of footprint k, of `count` pieces, and up to seven lanes more.
void write_pieces(const Footprints& f, std::size_t k, int count, const EchoSlots& to) {
    const float row_length = f.v[k];
    const float per_row = 1.0F / row_length;
    const float u_step = 2.0F / f.u[k];
    const float v_step = 2.0F / row_length;
    const float shift = f.shift_m[k];
    const float height = f.height_m[k];
    const float reflection = f.reflection[k];
    for (int first = 0; first < count; first += lanes) {
        std::array<float, lanes> s, t;
        const auto start = static_cast<float>(first);
        for (int lane = 0; lane < lanes; ++lane) {
            const float piece = start + lane_numbers[lane];
            const float row = std::floor((piece + 0.5F) * per_row);
            s[lane] = (row + 0.5F) * u_step - 1.0F;
            t[lane] = (piece - row * row_length + 0.5F) * v_step - 1.0F;
        }
        float* const __restrict range_m = to.range_m + first;
        float* const __restrict intensity = to.intensity + first;
        for (int lane = 0; lane < lanes; ++lane) {
            const float x = along(f.position, f.edge_u, f.edge_v, 0, k, s[lane], t[lane]);
            const float y = along(f.position, f.edge_u, f.edge_v, 1, k, s[lane], t[lane]);
            const float z = along(f.position, f.edge_u, f.edge_v, 2, k, s[lane], t[lane]);
            const float r = piece_range(x, y, z);
            range_m[lane] = r + shift;
            intensity[lane] = reflection * std::min(height / r, 1.0F);
        }
        std::fill_n(to.half_m + first, lanes, f.half_m[k]);
        std::fill_n(to.weight + first, lanes, f.weight[k]);
        if (!to.cell_low) continue;
        std::uint32_t* const __restrict low = to.cell_low + first;
        std::uint32_t* const __restrict high = to.cell_high + first;
        for (int lane = 0; lane < lanes; ++lane) {
            const CellName name =
                cell_name(whole(along(f.cell, f.cell_u, f.cell_v, 0, k, s[lane], t[lane])),
                          whole(along(f.cell, f.cell_u, f.cell_v, 1, k, s[lane], t[lane])),
                          whole(along(f.cell, f.cell_u, f.cell_v, 2, k, s[lane], t[lane])));
            low[lane] = name.low;
            high[lane] = name.high;
        }
    }
}

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

void Echoes::resize(std::size_t count, bool cells) {
    RangeBoxes::resize(count);
    if (cells) {
        cell_low.resize(count);
        cell_high.resize(count);
    }
}

void direct_echoes(std::span<const Sample> samples, std::span<const Material> materials,
                   float bin_m, const ScattererLattice& lattice, Echoes& echoes,
                   std::vector<std::uint32_t>* ends) {
    if (ends) ends->clear();
    const bool named = lattice.exists();
    std::size_t end = 0;
    Footprints footprints;
    for (std::size_t begin = 0; begin < samples.size(); begin += Footprints::capacity) {
        const auto block = samples.subspan(
            begin, std::min<std::size_t>(Footprints::capacity, samples.size() - begin));
        cut_footprints(block, materials, bin_m, lattice, footprints);
        for (std::size_t k = 0; k < block.size(); ++k) {
            const int count = static_cast<int>(footprints.u[k] * footprints.v[k]);
            // write_pieces() writes whole vectors: the next sample overwrites the surplus lanes.
            if (end + count + lanes > echoes.size()) {
                echoes.resize(2 * (end + count + lanes), named);
            }
            write_pieces(footprints, k, count, slots_at(echoes, end, named));
            end += count;
            if (ends) ends->push_back(static_cast<std::uint32_t>(end));
        }
    }
    echoes.resize(end, named);
}

std::uint64_t mean_of_bins(const BinSums& sums, std::span<float> intensity) {
    int occupied = 0;
    const auto first = static_cast<std::size_t>(sums.first);
    const auto end = static_cast<std::size_t>(sums.end);
    std::fill(intensity.begin(), intensity.begin() + sums.first, 0.0F);
    std::fill(intensity.begin() + sums.end, intensity.end(), 0.0F);
    for (std::size_t i = first; i < end; ++i) {
        const float weight = sums.weight(i);
        const bool visible = weight > 0.0F;
        intensity[i] = visible ? sums.echo(i) / weight : 0.0F;
        occupied += visible ? 1 : 0;
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
