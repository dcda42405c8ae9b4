#pragma once

#include <immintrin.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <initializer_list>

// Operators for eight numbers at a time, so that code that uses them reads like code for one
// number. Each operator is one instruction, since its rounding affects the images.

namespace sonarsim {

inline constexpr int lanes = 8;

/// One truth value per lane.
struct Mask8 {
    __m256 v;

    /// Lane 0 is the lowest bit.
    unsigned bits() const { return static_cast<unsigned>(_mm256_movemask_ps(v)); }

    friend Mask8 operator&(Mask8 a, Mask8 b) { return {_mm256_and_ps(a.v, b.v)}; }
    friend Mask8 operator|(Mask8 a, Mask8 b) { return {_mm256_or_ps(a.v, b.v)}; }
};

struct Ints8 {
    __m256i v;

    Ints8(__m256i values) : v(values) {}
    Ints8(std::int32_t all) : v(_mm256_set1_epi32(all)) {}
    Ints8(std::uint32_t all) : Ints8(static_cast<std::int32_t>(all)) {}
    static Ints8 load(const std::int32_t* from) {
        return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
    }
    void store(std::int32_t* to) const { _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), v); }

    friend Ints8 operator+(Ints8 a, Ints8 b) { return _mm256_add_epi32(a.v, b.v); }
    friend Ints8 operator-(Ints8 a, Ints8 b) { return _mm256_sub_epi32(a.v, b.v); }
    /// The lower 32 bits of the products.
    friend Ints8 operator*(Ints8 a, Ints8 b) { return _mm256_mullo_epi32(a.v, b.v); }
    friend Ints8 operator&(Ints8 a, Ints8 b) { return _mm256_and_si256(a.v, b.v); }
    friend Ints8 operator^(Ints8 a, Ints8 b) { return _mm256_xor_si256(a.v, b.v); }
    friend Ints8 operator<<(Ints8 a, int count) { return _mm256_slli_epi32(a.v, count); }
    /// Zeros come in from the left.
    friend Ints8 operator>>(Ints8 a, int count) { return _mm256_srli_epi32(a.v, count); }
    /// The quotients by powers of two, rounded down.
    friend Ints8 halved(Ints8 a, Ints8 times) { return _mm256_srav_epi32(a.v, times.v); }
    friend Mask8 operator>(Ints8 a, Ints8 b) {
        return {_mm256_castsi256_ps(_mm256_cmpgt_epi32(a.v, b.v))};
    }
    friend Ints8 where(Mask8 mask, Ints8 a) {
        return _mm256_and_si256(_mm256_castps_si256(mask.v), a.v);
    }
};

struct Floats8 {
    __m256 v;

    Floats8() = default;
    Floats8(__m256 values) : v(values) {}
    Floats8(float all) : v(_mm256_set1_ps(all)) {}
    static Floats8 load(const float* from) { return _mm256_loadu_ps(from); }
    void store(float* to) const { _mm256_storeu_ps(to, v); }

    float operator[](int lane) const { return v[lane]; }

    friend Floats8 operator+(Floats8 a, Floats8 b) { return _mm256_add_ps(a.v, b.v); }
    friend Floats8 operator-(Floats8 a, Floats8 b) { return _mm256_sub_ps(a.v, b.v); }
    friend Floats8 operator*(Floats8 a, Floats8 b) { return _mm256_mul_ps(a.v, b.v); }
    friend Floats8 operator/(Floats8 a, Floats8 b) { return _mm256_div_ps(a.v, b.v); }
    /// Adds `a` to eight numbers in memory.
    friend void add_to(float* sums, Floats8 a) { (Floats8::load(sums) + a).store(sums); }
    friend Mask8 operator<(Floats8 a, Floats8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_LT_OQ)}; }
    /// True where one of them is NaN.
    friend Mask8 operator!=(Floats8 a, Floats8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_NEQ_UQ)}; }
    friend Mask8 operator>=(Floats8 a, Floats8 b) { return {_mm256_cmp_ps(a.v, b.v, _CMP_GE_OQ)}; }
    friend Mask8 operator>(Floats8 a, Floats8 b) { return b < a; }
    friend Mask8 operator<=(Floats8 a, Floats8 b) { return b >= a; }
    /// a b + c, rounded once.
    friend Floats8 fma(Floats8 a, Floats8 b, Floats8 c) { return _mm256_fmadd_ps(a.v, b.v, c.v); }
    /// a b - c, rounded once.
    friend Floats8 fms(Floats8 a, Floats8 b, Floats8 c) { return _mm256_fmsub_ps(a.v, b.v, c.v); }
    /// The lesser; b where one of them is NaN.
    friend Floats8 min(Floats8 a, Floats8 b) { return _mm256_min_ps(a.v, b.v); }
    /// The greater; b where one of them is NaN.
    friend Floats8 max(Floats8 a, Floats8 b) { return _mm256_max_ps(a.v, b.v); }
    friend Floats8 absolute(Floats8 a) { return _mm256_andnot_ps(_mm256_set1_ps(-0.0F), a.v); }
    friend Floats8 sqrt(Floats8 a) { return _mm256_sqrt_ps(a.v); }
    friend Floats8 floor(Floats8 a) { return _mm256_floor_ps(a.v); }
    /// 0 in the lanes that are false.
    friend Floats8 where(Mask8 mask, Floats8 a) { return _mm256_and_ps(mask.v, a.v); }
    /// Rounded towards 0.
    friend Ints8 to_ints(Floats8 a) { return _mm256_cvttps_epi32(a.v); }
    friend Ints8 bits_of_floats(Floats8 a) { return _mm256_castps_si256(a.v); }
    /// values[at], `at` within 0 to 7.
    friend Floats8 picked(Floats8 values, Ints8 at) {
        return _mm256_permutevar8x32_ps(values.v, at.v);
    }
};

/// a in the lanes that are true, b in the others.
inline Floats8 where(Mask8 mask, Floats8 a, Floats8 b) {
    return _mm256_blendv_ps(b.v, a.v, mask.v);
}

/// 0 to 7.
inline Ints8 lane_numbers() {
    return _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
}

inline Floats8 to_floats(Ints8 a) {
    return _mm256_cvtepi32_ps(a.v);
}
inline Floats8 floats_of_bits(Ints8 a) {
    return _mm256_castsi256_ps(a.v);
}
/// Horner's rule, `polynomial` of elementary.h; the coefficients from the highest power down.
inline Floats8 polynomial_of_8(Floats8 x, std::initializer_list<float> coefficients) {
    const float* next = coefficients.begin();
    Floats8 sum = *next;
    while (++next != coefficients.end())
        sum = fma(x, sum, *next);
    return sum;
}

/// Writes 8 complex numbers.
inline void store_complex(Floats8 re, Floats8 im, float* to) {
    const __m256 low = _mm256_unpacklo_ps(re.v, im.v);
    const __m256 high = _mm256_unpackhi_ps(re.v, im.v);
    _mm256_storeu_ps(to, _mm256_permute2f128_ps(low, high, 0x20));
    _mm256_storeu_ps(to + lanes, _mm256_permute2f128_ps(low, high, 0x31));
}

/// The columns of 8 rows of 8 numbers. Row k + 1 begins `stride` numbers after row k.
inline std::array<Floats8, lanes> columns_of_eight(const float* rows, std::ptrdiff_t stride = 8) {
    const auto row = [&](int k) { return _mm256_loadu_ps(rows + stride * k); };
    const auto pairs = [&](int k, bool upper) {
        return upper ? _mm256_unpackhi_ps(row(k), row(k + 1))
                     : _mm256_unpacklo_ps(row(k), row(k + 1));
    };
    // In each half: column c of the rows k to k + 3 for the lower half, column c + 4 for the upper.
    const auto four = [&](int k, int c) {
        const __m256 a = pairs(k, c >= 2);
        const __m256 b = pairs(k + 2, c >= 2);
        return c % 2 == 0 ? _mm256_shuffle_ps(a, b, _MM_SHUFFLE(1, 0, 1, 0))
                          : _mm256_shuffle_ps(a, b, _MM_SHUFFLE(3, 2, 3, 2));
    };
    const auto column = [&](int c) -> Floats8 {
        return c < 4 ? _mm256_permute2f128_ps(four(0, c), four(4, c), 0x20)
                     : _mm256_permute2f128_ps(four(0, c - 4), four(4, c - 4), 0x31);
    };
    return {column(0), column(1), column(2), column(3), column(4), column(5), column(6), column(7)};
}

/// For each mask of 8 bits the numbers of the bits that are set, ascending, a byte each.
constexpr std::array<std::uint64_t, 256> lane_orders() {
    std::array<std::uint64_t, 256> out{};
    for (unsigned mask = 0; mask < 256; ++mask) {
        int place = 0;
        for (unsigned bit = 0; bit < 8; ++bit) {
            if ((mask >> bit & 1U) != 0) out[mask] |= std::uint64_t{bit} << (8 * place++);
        }
    }
    return out;
}
inline constexpr std::array<std::uint64_t, 256> lane_order_by_mask = lane_orders();

/// Moves the lanes of a mask to the front, for the store into a list.
struct ToFront {
    __m256i order;
    int count;

    explicit ToFront(unsigned mask)
        : order(_mm256_cvtepu8_epi32(
              _mm_cvtsi64_si128(static_cast<long long>(lane_order_by_mask[mask])))),
          count(std::popcount(mask)) {}

    Ints8 operator()(Ints8 a) const { return _mm256_permutevar8x32_epi32(a.v, order); }
    Floats8 operator()(Floats8 a) const { return _mm256_permutevar8x32_ps(a.v, order); }
};

/// Each of two numbers in four lanes.
inline Ints8 two_by_four(const std::int32_t* two) {
    const __m128i pair = _mm_loadl_epi64(reinterpret_cast<const __m128i*>(two));
    return _mm256_permutevar8x32_epi32(_mm256_castsi128_si256(pair),
                                       _mm256_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1));
}

/// The entries of a table at `at`, and the ones after them.
struct EntryPairs {
    Floats8 here, next;
};
inline EntryPairs table_entries(const float* table, Ints8 at) {
    alignas(32) std::array<std::int32_t, lanes> entry;
    _mm256_store_si256(reinterpret_cast<__m256i*>(entry.data()), at.v);
    const auto two = [&](int lane) {
        const auto* const from = reinterpret_cast<const __m128i*>(table + entry[lane]);
        return _mm_castsi128_ps(_mm_loadl_epi64(from));
    };
    const auto four = [&](int lane) { return _mm_movelh_ps(two(lane), two(lane + 1)); };
    const __m256 low = _mm256_set_m128(four(4), four(0));
    const __m256 high = _mm256_set_m128(four(6), four(2));
    return {_mm256_shuffle_ps(low, high, _MM_SHUFFLE(2, 0, 2, 0)),
            _mm256_shuffle_ps(low, high, _MM_SHUFFLE(3, 1, 3, 1))};
}

}  // namespace sonarsim
