#include "format/adler.h"

#include <immintrin.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstring>

namespace sonarsim {

namespace {

/// The sum of eight lanes.
std::uint32_t sum_of(__m256i lanes) {
    std::array<std::uint32_t, 8> values;
    std::memcpy(values.data(), &lanes, sizeof(lanes));
    std::uint32_t sum = 0;
    for (const std::uint32_t value : values)
        sum += value;
    return sum;
}

}  // namespace

// Adler-32 keeps the sum of the bytes, which starts at 1, and the sum of the running sums, both
// modulo 65521. A step takes 32 bytes.
std::uint32_t adler_32(std::span<const std::uint8_t> bytes, std::uint32_t before_all) {
    constexpr std::uint32_t base = 65521;
    // With 160 blocks no sum exceeds 32 bits: 32 * (32 * 255) * (1 + ... + 159) is 3.3e9.
    constexpr std::size_t most_blocks = 160;
    const __m256i weights =
        _mm256_setr_epi8(32, 31, 30, 29, 28, 27, 26, 25, 24, 23, 22, 21, 20, 19, 18, 17, 16, 15, 14,
                         13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1);
    std::uint32_t sum = before_all & 0xFFFF;
    std::uint32_t sums = before_all >> 16;
    while (bytes.size() >= 32) {
        const std::size_t blocks = std::min(bytes.size() / 32, most_blocks);
        __m256i own = _mm256_setzero_si256();       // sums of all bytes so far
        __m256i before = _mm256_setzero_si256();    // sums of `own` before each block
        __m256i weighted = _mm256_setzero_si256();  // bytes times their weights in a block
        for (std::size_t k = 0; k < blocks; ++k) {
            const __m256i block =
                _mm256_loadu_si256(reinterpret_cast<const __m256i*>(bytes.data() + 32 * k));
            before = _mm256_add_epi32(before, own);
            own = _mm256_add_epi32(own, _mm256_sad_epu8(block, _mm256_setzero_si256()));
            const __m256i pairs = _mm256_maddubs_epi16(block, weights);
            weighted = _mm256_add_epi32(weighted, _mm256_madd_epi16(pairs, _mm256_set1_epi16(1)));
        }
        const auto count = static_cast<std::uint32_t>(32 * blocks);
        sums = (sums + count * sum + 32 * sum_of(before) + sum_of(weighted)) % base;
        sum = (sum + sum_of(own)) % base;
        bytes = bytes.subspan(count);
    }
    for (const std::uint8_t byte : bytes) {
        sum += byte;
        sums += sum;
    }
    return sums % base << 16 | sum % base;
}

}  // namespace sonarsim
