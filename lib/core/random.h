#pragma once

#include <immintrin.h>

#include <cstddef>
#include <cstdint>

namespace sonarsim {

/// Four 32-bit words: the counter that goes into Philox and the random words that come out.
struct PhiloxBlock {
    std::uint32_t x0, x1, x2, x3;
};

/// The 64-bit key of Philox: what names a family of draws.
struct PhiloxKey {
    std::uint32_t k0, k1;
};

/// Philox4x32-10 of Salmon et al., "Parallel random numbers: as easy as 1, 2, 3" (SC11), the same
/// function as in Random123; a test holds the two against each other.
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

/// Philox for a batch of counters, in place: counter k is (x0[k], x1[k], x2[k], x3[k]) and becomes
/// its random block. `count` is a multiple of 8. Eight counters at a time in AVX2 registers; what a
/// compiler makes of a loop over `philox` takes more than twice as long.
inline void philox_batch(std::uint32_t* x0, std::uint32_t* x1, std::uint32_t* x2, std::uint32_t* x3,
                         std::size_t count, PhiloxKey first_key) {
    const __m256i a = _mm256_set1_epi64x(0xD2511F53);
    const __m256i b = _mm256_set1_epi64x(0xCD9E8D57);
    const auto at = [](std::uint32_t* x, std::size_t k) {
        return reinterpret_cast<__m256i*>(x + k);
    };
    for (std::size_t k = 0; k < count; k += 8) {
        __m256i c0 = _mm256_loadu_si256(at(x0, k));
        __m256i c1 = _mm256_loadu_si256(at(x1, k));
        __m256i c2 = _mm256_loadu_si256(at(x2, k));
        __m256i c3 = _mm256_loadu_si256(at(x3, k));
        PhiloxKey key = first_key;
        for (int round = 0; round < 10; ++round) {
            // Products of the even and of the odd lanes: 64 bits each, low and high halves apart.
            const __m256i a_even = _mm256_mul_epu32(c0, a);
            const __m256i a_odd = _mm256_mul_epu32(_mm256_srli_epi64(c0, 32), a);
            const __m256i b_even = _mm256_mul_epu32(c2, b);
            const __m256i b_odd = _mm256_mul_epu32(_mm256_srli_epi64(c2, 32), b);
            const __m256i a_high = _mm256_blend_epi32(_mm256_srli_epi64(a_even, 32), a_odd, 0xAA);
            const __m256i b_high = _mm256_blend_epi32(_mm256_srli_epi64(b_even, 32), b_odd, 0xAA);
            const __m256i k0 = _mm256_set1_epi32(static_cast<int>(key.k0));
            const __m256i k1 = _mm256_set1_epi32(static_cast<int>(key.k1));
            c0 = _mm256_xor_si256(_mm256_xor_si256(b_high, c1), k0);
            c1 = _mm256_blend_epi32(b_even, _mm256_slli_epi64(b_odd, 32), 0xAA);
            c2 = _mm256_xor_si256(_mm256_xor_si256(a_high, c3), k1);
            c3 = _mm256_blend_epi32(a_even, _mm256_slli_epi64(a_odd, 32), 0xAA);
            key.k0 += 0x9E3779B9U;
            key.k1 += 0xBB67AE85U;
        }
        _mm256_storeu_si256(at(x0, k), c0);
        _mm256_storeu_si256(at(x1, k), c1);
        _mm256_storeu_si256(at(x2, k), c2);
        _mm256_storeu_si256(at(x3, k), c3);
    }
}

/// A float in (0, 1): the midpoint of one of 2^23 equal intervals. Neither 0 nor 1 occurs, so the
/// logarithm of it is finite; with 24 bits the last midpoint would round to 1.
inline float unit_float(std::uint32_t word) {
    return (static_cast<float>(static_cast<std::int32_t>(word >> 9)) + 0.5F) * 0x1p-23F;
}

/// What a draw is for. Draws of different streams never share a number.
enum class Stream : std::uint32_t { range_noise = 1, pixel_noise = 2, multipath_range_noise = 3 };

/// The key of one stream of one ping of one sensor. The counter below it names what the draw
/// belongs to (a scatterer cell, a pixel).
inline PhiloxKey stream_key(std::uint64_t seed, std::uint32_t sensor, std::uint32_t ping,
                            Stream stream) {
    const PhiloxBlock block =
        philox({sensor, ping, static_cast<std::uint32_t>(stream), 0x736f6e61U},
               {static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)});
    return {block.x0, block.x1};
}

}  // namespace sonarsim
