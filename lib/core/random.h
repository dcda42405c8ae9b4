#pragma once

#include <immintrin.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

#include "core/elementary.h"

namespace sonarsim {

/// Four 32-bit words: the counter that goes into Philox and the random words that come out.
struct PhiloxBlock {
    std::uint32_t x0, x1, x2, x3;
};

/// The 64-bit key of Philox. It identifies a family of draws.
struct PhiloxKey {
    std::uint32_t k0, k1;
};

/// Philox4x32-10 of Salmon et al. (SC11, "Parallel random numbers"), tested with Random123.
inline PhiloxBlock philox(PhiloxBlock c, PhiloxKey key) {
    for (int round = 0; round < 10; ++round) {
        const std::uint64_t a = std::uint64_t{0xD2511F53U} * c.x0;
        const std::uint64_t b = std::uint64_t{0xCD9E8D57U} * c.x2;
        c = {static_cast<std::uint32_t>(b >> 32) ^ c.x1 ^ key.k0, static_cast<std::uint32_t>(b),
             static_cast<std::uint32_t>(a >> 32) ^ c.x3 ^ key.k1, static_cast<std::uint32_t>(a)};
        key.k0 += 0x9E3779B9U;
        key.k1 += 0xBB67AE85U;
    }
    return c;
}

/// Rounds for draws that are made by the million; from 6 on no statistical flaw is known.
constexpr int pair_rounds = 7;

/// Philox2x32 of the same paper for a batch of counters, in place: counter k is (x0[k], x1[k]) and
/// becomes two random words. `count` is a multiple of 8. Philox2x32 has a key of one word, so the
/// second word goes into the counter. Two families of draws share a key only if their first words
/// are equal, and they use different counters then. The function works on eight counters at a time
/// in AVX2 registers; the plain loop takes more than twice as long.
inline void philox_pairs(std::uint32_t* x0, std::uint32_t* x1, std::size_t count, PhiloxKey key) {
    const __m256i multiplier = _mm256_set1_epi64x(0xD256D193);
    const __m256i second_key = _mm256_set1_epi32(static_cast<int>(key.k1));
    const auto at = [](std::uint32_t* x, std::size_t k) {
        return reinterpret_cast<__m256i*>(x + k);
    };
    for (std::size_t k = 0; k < count; k += 8) {
        // Even and odd counters go into separate registers, each in the lower half of 64 bits. The
        // product reads only the lower halves, so the upper ones may hold anything.
        __m256i even0 = _mm256_loadu_si256(at(x0, k));
        __m256i odd0 = _mm256_srli_epi64(even0, 32);
        __m256i even1 = _mm256_xor_si256(_mm256_loadu_si256(at(x1, k)), second_key);
        __m256i odd1 = _mm256_srli_epi64(even1, 32);
        std::uint32_t round_key = key.k0;
        for (int round = 0; round < pair_rounds; ++round) {
            const __m256i even = _mm256_mul_epu32(even0, multiplier);
            const __m256i odd = _mm256_mul_epu32(odd0, multiplier);
            const __m256i k0 = _mm256_set1_epi32(static_cast<int>(round_key));
            even0 = _mm256_xor_si256(_mm256_srli_epi64(even, 32), _mm256_xor_si256(even1, k0));
            odd0 = _mm256_xor_si256(_mm256_srli_epi64(odd, 32), _mm256_xor_si256(odd1, k0));
            even1 = even;
            odd1 = odd;
            round_key += 0x9E3779B9U;
        }
        const auto woven = [](__m256i even, __m256i odd) {
            return _mm256_blend_epi32(even, _mm256_slli_epi64(odd, 32), 0xAA);
        };
        _mm256_storeu_si256(at(x0, k), woven(even0, odd0));
        _mm256_storeu_si256(at(x1, k), woven(even1, odd1));
    }
}

/// A float in (0, 1): the midpoint of one of 2^23 equal intervals. 0 and 1 never occur, so its
/// logarithm is finite; with 24 bits the last midpoint would round to 1.
inline float unit_float(std::uint32_t word) {
    return (static_cast<float>(static_cast<std::int32_t>(word >> 9)) + 0.5F) * 0x1p-23F;
}

/// A double in [0, 1) with 53 random bits.
inline double unit_double(std::uint32_t high, std::uint32_t low) {
    return (static_cast<double>(high >> 5) * 67108864.0 + static_cast<double>(low >> 6)) * 0x1p-53;
}

/// The purpose of a draw. Draws of different streams never share a number.
enum class Stream : std::uint32_t {
    range_noise = 1,
    pixel_noise = 2,
    multipath_range_noise = 3,
    scatter = 4,    ///< stream_key() takes the scatter rule as `sensor`, the object as `ping`
    variation = 5,  ///< the key that varies as `sensor`, the variant as `ping`
    scatterers = 6,
    speckle = 7,
    receiver_noise = 8,
    ping_variation = 9,  ///< the key that varies as `sensor`, the pose as `ping`
};

/// A number for a name: its FNV-1a hash.
constexpr std::uint32_t number_of_name(std::string_view name) {
    std::uint32_t hash = 2166136261U;
    for (const char c : name)
        hash = (hash ^ static_cast<unsigned char>(c)) * 16777619U;
    return hash;
}

/// A stream that is not in the list above, for a stage that brings its own.
constexpr Stream stream_named(std::string_view name) {
    return Stream{0x80000000U | number_of_name(name)};
}

/// The key of a stream of one ping of one sensor. The counter identifies the item of the draw.
inline PhiloxKey stream_key(std::uint64_t seed, std::uint32_t sensor, std::uint32_t ping,
                            Stream stream) {
    const PhiloxBlock block =
        philox({sensor, ping, static_cast<std::uint32_t>(stream), 0x736f6e61U},
               {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
    return {block.x0, block.x1};
}

/// Uniform draws, each named by a quantity, which is a value of an enum, and a number.
template <class Quantity>
struct NamedDraws {
    PhiloxKey key;

    /// In [0, 1).
    double unit(Quantity what, std::uint32_t number = 0) const {
        const PhiloxBlock block = philox({number, static_cast<std::uint32_t>(what), 0, 0}, key);
        return unit_double(block.x0, block.x1);
    }
    double in(const std::array<double, 2>& range, Quantity what, std::uint32_t number = 0) const {
        return range[0] + (range[1] - range[0]) * unit(what, number);
    }
};

using NormalPair = std::pair<float, float>;

/// Two independent draws of normal(0, 1) from a random word, by Box and Muller: 20 bits make the
/// radius, 12 the angle. The greatest radius is 5.4; one draw in 15 million would lie beyond.
/// Without branches, so that loops vectorise.
inline NormalPair normal_pair(std::uint32_t word) {
    const auto upper = static_cast<float>(static_cast<std::int32_t>(word >> 12));
    const auto lower = static_cast<float>(static_cast<std::int32_t>(word & 0xFFFU));
    const float radius = std::sqrt(-2.0F * natural_log((upper + 0.5F) * 0x1p-20F));
    const SinCosFloat angle =
        sincos_small(static_cast<float>(2.0 * pi) * ((lower + 0.5F) * 0x1p-12F - 0.5F));
    return {radius * angle.cos, radius * angle.sin};
}

/// Two independent draws of normal(0, 1) from a block of random words, by Box and Muller.
inline std::pair<double, double> two_normals(const PhiloxBlock& words) {
    const double radius = std::sqrt(-2.0 * logarithm(1.0 - unit_double(words.x0, words.x1)));
    const SinCos angle = sincos(2.0 * pi * unit_double(words.x2, words.x3));
    return {radius * angle.cos, radius * angle.sin};
}

/// The name of a cell of a lattice in its random draws: the lowest 21 bits of its x and y and 22 of
/// its z. Cells that lie 2^21 edges apart share draws, 42 km at 2 cm.
struct CellName {
    std::uint32_t low, high;
};

inline CellName cell_name(std::int32_t x, std::int32_t y, std::int32_t z) {
    constexpr std::uint32_t bits_21 = 0x1FFFFF;
    const auto split = static_cast<std::uint32_t>(z);
    return {.low = (static_cast<std::uint32_t>(x) & bits_21) | split << 21,
            .high = (static_cast<std::uint32_t>(y) & bits_21) | split >> 11 << 21};
}

}  // namespace sonarsim
