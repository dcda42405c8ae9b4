#include "calibrated/sonar_equation.h"

#include <immintrin.h>

#include <algorithm>

#include "calibrated/levels.h"
#include "calibrated/line_array.h"
#include "trace/arrivals.h"

namespace sonarsim {

namespace {

constexpr int vector_lanes = 8;

using Floats = PatchBlock::Array<float>;

__m256 all(float value) {
    return _mm256_set1_ps(value);
}

__m256 product(__m256 a, __m256 b) {
    return _mm256_mul_ps(a, b);
}

/// `exp_neg` of bottom.h, 8 at a time: what a compiler makes of a loop over it takes twice as long.
__m256 exp_neg(__m256 x, float end = fades_at) {
    const __m256 longest = all(end);
    const __m256 turns = product(_mm256_min_ps(x, longest), all(1.44269504F));
    const __m256 whole = _mm256_floor_ps(turns);
    const __m256 rest = product(_mm256_sub_ps(turns, whole), all(0.69314718F));
    __m256 series = all(-1.0F / 5040);
    for (const float term : {1.0F / 720, -1.0F / 120, 1.0F / 24, -1.0F / 6, 1.0F / 2, -1.0F, 1.0F})
        series = _mm256_fmadd_ps(series, rest, all(term));
    const __m256i exponent = _mm256_sub_epi32(_mm256_set1_epi32(127), _mm256_cvttps_epi32(whole));
    const __m256 scale = _mm256_castsi256_ps(_mm256_slli_epi32(exponent, 23));
    return _mm256_and_ps(product(series, scale), _mm256_cmp_ps(x, longest, _CMP_LT_OQ));
}

/// One value of every material. As many as a register has lanes are looked up in one.
class MaterialTable {
  public:
    MaterialTable(std::span<const Backscatter> materials, float Backscatter::*value)
        : materials_(materials), value_(value) {
        std::array<float, vector_lanes> first{};
        for (std::size_t m = 0; m < std::min(materials.size(), first.size()); ++m)
            first[m] = materials[m].*value;
        first_ = _mm256_loadu_ps(first.data());
    }

    /// Of 8 materials.
    __m256 at(const std::uint32_t* numbers) const {
        if (materials_.size() <= vector_lanes) {
            const auto* const eight = reinterpret_cast<const __m256i*>(numbers);
            return _mm256_permutevar8x32_ps(first_, _mm256_loadu_si256(eight));
        }
        std::array<float, vector_lanes> values;
        for (int lane = 0; lane < vector_lanes; ++lane)
            values[lane] = materials_[numbers[lane]].*value_;
        return _mm256_loadu_ps(values.data());
    }

  private:
    std::span<const Backscatter> materials_;
    float Backscatter::*value_;
    __m256 first_;
};

/// `Backscatter::at`, 8 at a time.
class BackscatterTable {
  public:
    explicit BackscatterTable(std::span<const Backscatter> materials)
        : lambert_(materials, &Backscatter::lambert),
          facet_(materials, &Backscatter::facet),
          inverse_slope2_(materials, &Backscatter::inverse_slope2) {}

    __m256 at(const std::uint32_t* numbers, __m256 sine) const {
        const __m256 s2 = product(sine, sine);
        const __m256 inverse = _mm256_div_ps(all(1.0F), _mm256_max_ps(s2, all(1e-6F)));
        const __m256 steepness =
            product(inverse_slope2_.at(numbers), _mm256_sub_ps(inverse, all(1.0F)));
        const __m256 facets =
            product(product(facet_.at(numbers), product(inverse, inverse)), exp_neg(steepness));
        return _mm256_fmadd_ps(lambert_.at(numbers), s2, facets);
    }

  private:
    MaterialTable lambert_, facet_, inverse_slope2_;
};

/// An entry of a table and the next one.
__m128 two_entries(const float* table, int at) {
    return _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(table + at)));
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

void weigh_by_elevation(const ElevationPattern& pattern, const PatchBlock& pieces, int count,
                        PointEchoes& echoes) {
    if (pattern.power.empty()) return;
    const float* const table = pattern.power.data();
    // Between the entries, at a sine within [-1, 1].
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

std::uint64_t apply_sonar_equation(const PatchBlock& pieces, std::span<const Backscatter> materials,
                                   const SonarEquation& equation, PointEchoes& echoes) {
    const int count = (pieces.count + vector_lanes - 1) / vector_lanes * vector_lanes;
    echoes.count = count;
    const float per_bin = 1.0F / equation.bin_m;
    const BackscatterTable scattering(materials);
    for (int k = 0; k < count; k += vector_lanes) {
        const auto read = [&](const Floats& from) { return _mm256_loadu_ps(from.data() + k); };
        const auto write = [&](Floats& to, __m256 values) {
            _mm256_storeu_ps(to.data() + k, values);
        };
        const __m256 x = read(pieces.x);
        const __m256 y = read(pieces.y);
        const __m256 z = read(pieces.z);
        const __m256 range = piece_range(x, y, z);
        const __m256 inverse = _mm256_div_ps(all(1.0F), range);
        const __m256 spreading = product(inverse, inverse);
        const __m256 sine = _mm256_min_ps(product(read(pieces.height_m), inverse), all(1.0F));
        const __m256 received = product(read(pieces.area_m2), product(spreading, spreading));
        const __m256 loss = exp_neg(
            _mm256_fmsub_ps(all(equation.loss_per_m), range, all(equation.raised)), least_loss);
        write(echoes.range_m, range);
        const __m256 power =
            product(product(scattering.at(pieces.material.data() + k, sine), loss), received);
        // In this order what is no number stays that.
        write(echoes.power, _mm256_min_ps(all(most_echo), power));
        write(echoes.row, _mm256_fmsub_ps(_mm256_sub_ps(range, all(equation.range_min_m)),
                                          all(per_bin), all(0.5F)));
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
