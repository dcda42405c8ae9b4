#pragma once

#include <immintrin.h>

#include <array>
#include <bit>
#include <cstdint>

// Eight cells at a time.

namespace sonarsim {

inline constexpr int search_lanes = 8;

inline __m256i all_lanes(std::uint32_t word) {
    return _mm256_set1_epi32(static_cast<int>(word));
}

inline __m256i load_numbers(const std::int32_t* from) {
    return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from));
}

inline void store_numbers(std::int32_t* to, __m256i values) {
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), values);
}

inline unsigned mask_of(__m256i lanes) {
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_castsi256_ps(lanes)));
}

/// A one-to-one function of 32 bits whose results look random.
inline __m256i mixed(__m256i h) {
    h = _mm256_xor_si256(h, _mm256_srli_epi32(h, 16));
    h = _mm256_mullo_epi32(h, all_lanes(0x7FEB352DU));
    h = _mm256_xor_si256(h, _mm256_srli_epi32(h, 15));
    h = _mm256_mullo_epi32(h, all_lanes(0x846CA68BU));
    return _mm256_xor_si256(h, _mm256_srli_epi32(h, 16));
}

/// Random bits of a level's cells, seen along an axis, by their numbers and a key.
inline __m256i cell_bits(__m256i i, __m256i j, std::int32_t level, std::int32_t axis,
                         std::uint32_t key) {
    const auto plane = static_cast<std::uint32_t>(4 * level + axis + 1) * 0x9E3779B1U;
    const __m256i by_i = _mm256_mullo_epi32(i, all_lanes(0x85EBCA6BU));
    const __m256i by_j = _mm256_mullo_epi32(j, all_lanes(0xC2B2AE35U));
    const __m256i cell = _mm256_add_epi32(_mm256_add_epi32(by_i, by_j), all_lanes(plane));
    return mixed(_mm256_xor_si256(cell, all_lanes(key)));
}

/// By 8 bits, the numbers of those that are set, in order, and then 0.
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

/// Moves the lanes of a mask to the front.
struct ToFront {
    __m256i order;
    int count;

    explicit ToFront(unsigned mask)
        : order(_mm256_cvtepu8_epi32(
              _mm_cvtsi64_si128(static_cast<long long>(lane_order_by_mask[mask])))),
          count(std::popcount(mask)) {}

    __m256i operator()(__m256i values) const { return _mm256_permutevar8x32_epi32(values, order); }
    __m256 operator()(__m256 values) const { return _mm256_permutevar8x32_ps(values, order); }
};

}  // namespace sonarsim
