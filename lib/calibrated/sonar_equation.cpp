#include "calibrated/sonar_equation.h"

#include <immintrin.h>

#include <algorithm>

#include "calibrated/line_array.h"

namespace sonarsim {

namespace {

constexpr int vector_lanes = 8;

using Floats = PieceBlock::Array<float>;

/// What the materials of pieces are like, in arrays of their own so that loops vectorise.
struct MaterialsOfPieces {
    Floats lambert, facet, inverse_slope2;

    MaterialsOfPieces(const PieceBlock& pieces, std::span<const Backscatter> materials, int count) {
        if (materials.size() <= vector_lanes) {
            const auto numbers = reinterpret_cast<const std::int32_t*>(pieces.material.data());
            look_up(materials, &Backscatter::lambert, numbers, count, lambert);
            look_up(materials, &Backscatter::facet, numbers, count, facet);
            look_up(materials, &Backscatter::inverse_slope2, numbers, count, inverse_slope2);
            return;
        }
        for (int k = 0; k < count; ++k) {
            const Backscatter& material = materials[pieces.material[k]];
            lambert[k] = material.lambert;
            facet[k] = material.facet;
            inverse_slope2[k] = material.inverse_slope2;
        }
    }

  private:
    /// As many materials as a register has lanes are looked up in one.
    static void look_up(std::span<const Backscatter> materials, float Backscatter::*value,
                        const std::int32_t* numbers, int count, Floats& out) {
        std::array<float, vector_lanes> values{};
        for (std::size_t m = 0; m < materials.size(); ++m)
            values[m] = materials[m].*value;
        const __m256 table = _mm256_loadu_ps(values.data());
        for (int k = 0; k < count; k += vector_lanes) {
            const __m256i number =
                _mm256_loadu_si256(reinterpret_cast<const __m256i*>(numbers + k));
            _mm256_storeu_ps(out.data() + k, _mm256_permutevar8x32_ps(table, number));
        }
    }
};

/// An entry of a table and the next one.
__m128 two_entries(const float* table, int at) {
    return _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(table + at)));
}

/// The pattern between its entries, at a sine within [-1, 1].
void weigh_by_elevation(const ElevationPattern& pattern, const PieceBlock& pieces, int count,
                        PointEchoes& echoes) {
    if (pattern.power.empty()) return;
    const float* const table = pattern.power.data();
    const __m256 half = _mm256_set1_ps(0.5F * ElevationPattern::steps);
    const __m256 most = _mm256_set1_ps(1.0F * ElevationPattern::steps);
    alignas(32) std::array<std::int32_t, vector_lanes> entry;
    for (int k = 0; k < count; k += vector_lanes) {
        const __m256 sine = _mm256_div_ps(_mm256_loadu_ps(pieces.z.data() + k),
                                          _mm256_loadu_ps(echoes.range_m.data() + k));
        // In this order of arguments what is no number becomes 0.
        const __m256 at = _mm256_min_ps(
            _mm256_max_ps(_mm256_fmadd_ps(half, sine, half), _mm256_setzero_ps()), most);
        const __m256 whole = _mm256_floor_ps(at);
        _mm256_store_si256(reinterpret_cast<__m256i*>(entry.data()), _mm256_cvttps_epi32(whole));
        const auto four_entries = [&](int lane) {
            return _mm_movelh_ps(two_entries(table, entry[lane]),
                                 two_entries(table, entry[lane + 1]));
        };
        const __m256 one = _mm256_set_m128(four_entries(4), four_entries(0));
        const __m256 other = _mm256_set_m128(four_entries(6), four_entries(2));
        const __m256 here = _mm256_shuffle_ps(one, other, _MM_SHUFFLE(2, 0, 2, 0));
        const __m256 next = _mm256_shuffle_ps(one, other, _MM_SHUFFLE(3, 1, 3, 1));
        const __m256 power =
            _mm256_fmadd_ps(_mm256_sub_ps(at, whole), _mm256_sub_ps(next, here), here);
        float* const to = echoes.power.data() + k;
        _mm256_storeu_ps(to, _mm256_mul_ps(_mm256_loadu_ps(to), power));
    }
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
    const MaterialsOfPieces of(pieces, materials, count);
    for (int k = 0; k < count; ++k) {
        const float x = pieces.x[k];
        const float y = pieces.y[k];
        const float z = pieces.z[k];
        const float range = std::sqrt(std::fma(x, x, std::fma(y, y, z * z)));
        const float inverse = 1.0F / range;
        const float spreading = inverse * inverse;
        const float sine = std::min(pieces.height_m[k] * inverse, 1.0F);
        const Backscatter material{of.lambert[k], of.facet[k], of.inverse_slope2[k]};
        echoes.range_m[k] = range;
        echoes.power[k] = material.at(sine) * pieces.area_m2[k] * spreading * spreading *
                          fading(equation.loss_per_m * range);
        echoes.row[k] = (range - equation.range_min_m) * per_bin - 0.5F;
    }
    weigh_by_elevation(equation.elevation, pieces, count, echoes);
    const auto rows = static_cast<float>(equation.rows);
    int outside = 0;
    for (int k = 0; k < count; ++k) {
        const bool inside = echoes.row[k] > -0.5F && echoes.row[k] < rows - 0.5F;
        const bool meant = k < pieces.count;
        outside += meant && !inside ? 1 : 0;
        const bool kept = meant && inside;
        echoes.power[k] = kept ? echoes.power[k] : 0.0F;
        echoes.row[k] = kept ? echoes.row[k] : 0.0F;
    }
    return outside;
}

}  // namespace sonarsim
