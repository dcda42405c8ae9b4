#include "calibrated/sonar_equation.h"

#include <immintrin.h>

#include <algorithm>

#include "calibrated/line_array.h"

namespace sonarsim {

namespace {

constexpr int vector_lanes = 8;

/// The pattern between its entries, at a sine within [-1, 1].
void weigh_by_elevation(const ElevationPattern& pattern, const PieceBlock& pieces, int count,
                        PointEchoes& echoes) {
    if (pattern.power.empty()) return;
    const float* const table = pattern.power.data();
    constexpr float half = 0.5F * ElevationPattern::steps;
    for (int k = 0; k < count; ++k) {
        const float at = half + half * (pieces.z[k] / echoes.range_m[k]);
        // In this order what is no number becomes 0.
        const float whole = std::floor(std::min(2.0F * half, std::max(0.0F, at)));
        const float* const entry = table + static_cast<int>(whole);
        echoes.power[k] *= std::fma(at - whole, entry[1] - entry[0], entry[0]);
    }
}

/// Where an echo goes: its place, and its shares in the next bin and the next column.
struct Target {
    float* place;
    float next_row, next_column;
};

Target target_of(const PointEchoes& echoes, int k, EchoGrid& grid) {
    const float row = std::floor(echoes.row[k]);
    const float column = std::floor(echoes.column[k]);
    return {grid.column(static_cast<int>(column)) + 2 * static_cast<int>(row), echoes.row[k] - row,
            echoes.column[k] - column};
}

/// Adds (a, b) to four places, a and b being the two floats of one.
void add_shared(const Target& target, __m128 value, std::size_t stride) {
    const __m128 rows = _mm_setr_ps(1.0F - target.next_row, 1.0F - target.next_row, target.next_row,
                                    target.next_row);
    const __m128 next = _mm_set1_ps(target.next_column);
    const __m128 whole = _mm_mul_ps(value, rows);
    const __m128 there = _mm_mul_ps(whole, next);
    float* const here = target.place;
    _mm_storeu_ps(here, _mm_add_ps(_mm_loadu_ps(here), _mm_sub_ps(whole, there)));
    _mm_storeu_ps(here + stride, _mm_add_ps(_mm_loadu_ps(here + stride), there));
}

}  // namespace

ElevationPattern elevation_pattern(double width_rad, double side_lobe_db) {
    ElevationPattern out;
    if (width_rad <= 0.0) return out;
    const LineArray array = line_array(width_rad, side_lobe_db);
    for (int k = 0; k <= ElevationPattern::steps + 1; ++k) {
        const double sine = 2.0 * k / ElevationPattern::steps - 1.0;
        const double pattern = line_pattern(array, sine);
        out.power.push_back(static_cast<float>(pattern * pattern));
    }
    return out;
}

std::uint64_t find_echoes(const PieceBlock& pieces, std::span<const Backscatter> materials,
                          const SonarEquation& equation, PointEchoes& echoes) {
    const int count = (pieces.count + vector_lanes - 1) / vector_lanes * vector_lanes;
    echoes.count = count;
    const float per_bin = 1.0F / equation.bin_m;
    const float per_step = static_cast<float>(1.0 / equation.grid.step);
    const auto first_sine = static_cast<float>(equation.grid.first);
    for (int k = 0; k < count; ++k) {
        const float x = pieces.x[k];
        const float y = pieces.y[k];
        const float z = pieces.z[k];
        const float range = std::sqrt(std::fma(x, x, std::fma(y, y, z * z)));
        const float inverse = 1.0F / range;
        const float spreading = inverse * inverse;
        const float sine = std::min(pieces.height_m[k] * inverse, 1.0F);
        const Backscatter& material = materials[pieces.material[k]];
        echoes.range_m[k] = range;
        echoes.power[k] = material.at(sine) * pieces.area_m2[k] * spreading * spreading *
                          fading(equation.loss_per_m * range);
        echoes.row[k] = (range - equation.range_min_m) * per_bin - 0.5F;
        echoes.column[k] = (y * inverse - first_sine) * per_step;
    }
    weigh_by_elevation(equation.elevation, pieces, count, echoes);
    const auto rows = static_cast<float>(equation.rows);
    const auto last_column = static_cast<float>(equation.grid.columns - 1);
    int outside = 0;
    for (int k = 0; k < count; ++k) {
        const bool inside = echoes.row[k] > -0.5F && echoes.row[k] < rows - 0.5F &&
                            echoes.column[k] >= 0.0F && echoes.column[k] < last_column;
        const bool meant = k < pieces.count;
        outside += meant && !inside ? 1 : 0;
        const bool kept = meant && inside;
        echoes.power[k] = kept ? echoes.power[k] : 0.0F;
        echoes.row[k] = kept ? echoes.row[k] : 0.0F;
        echoes.column[k] = kept ? echoes.column[k] : 0.0F;
    }
    return outside;
}

void add_powers(const PointEchoes& echoes, EchoGrid& grid) {
    for (int k = 0; k < echoes.count; ++k) {
        const __m128 value = _mm_setr_ps(echoes.power[k], 0.0F, echoes.power[k], 0.0F);
        add_shared(target_of(echoes, k, grid), value, grid.stride());
    }
}

void add_amplitudes(const PointEchoes& echoes, const PieceBlock::Array<float>& re,
                    const PieceBlock::Array<float>& im, EchoGrid& grid) {
    for (int k = 0; k < echoes.count; ++k) {
        const __m128 value = _mm_setr_ps(re[k], im[k], re[k], im[k]);
        add_shared(target_of(echoes, k, grid), value, grid.stride());
    }
}

}  // namespace sonarsim
