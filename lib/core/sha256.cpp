#include "core/sha256.h"

#include <cpuid.h>
#include <fcntl.h>
#include <immintrin.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <vector>

#include "core/file.h"

namespace sonarsim {

namespace {

/// FIPS 180-4, 4.2.2: the fractions of the cube roots of the first 64 primes.
alignas(16) constexpr std::uint32_t round_constants[64] = {
    0x428a2f98, 0x71374491, 0xb5c0fbcf, 0xe9b5dba5, 0x3956c25b, 0x59f111f1, 0x923f82a4, 0xab1c5ed5,
    0xd807aa98, 0x12835b01, 0x243185be, 0x550c7dc3, 0x72be5d74, 0x80deb1fe, 0x9bdc06a7, 0xc19bf174,
    0xe49b69c1, 0xefbe4786, 0x0fc19dc6, 0x240ca1cc, 0x2de92c6f, 0x4a7484aa, 0x5cb0a9dc, 0x76f988da,
    0x983e5152, 0xa831c66d, 0xb00327c8, 0xbf597fc7, 0xc6e00bf3, 0xd5a79147, 0x06ca6351, 0x14292967,
    0x27b70a85, 0x2e1b2138, 0x4d2c6dfc, 0x53380d13, 0x650a7354, 0x766a0abb, 0x81c2c92e, 0x92722c85,
    0xa2bfe8a1, 0xa81a664b, 0xc24b8b70, 0xc76c51a3, 0xd192e819, 0xd6990624, 0xf40e3585, 0x106aa070,
    0x19a4c116, 0x1e376c08, 0x2748774c, 0x34b0bcb5, 0x391c0cb3, 0x4ed8aa4a, 0x5b9cca4f, 0x682e6ff3,
    0x748f82ee, 0x78a5636f, 0x84c87814, 0x8cc70208, 0x90befffa, 0xa4506ceb, 0xbef9a3f7, 0xc67178f2};

using State = std::array<std::uint32_t, 8>;

/// The same with the SHA instructions, which need the state as two registers, ABEF and CDGH.
__attribute__((target("sha"))) void blocks_by_sha_instructions(State& state, const char* blocks,
                                                               std::size_t count) {
    const __m128i big_endian = _mm_set_epi64x(0x0c0d0e0f08090a0b, 0x0405060700010203);
    const auto load = [](const void* from) {
        return _mm_loadu_si128(static_cast<const __m128i*>(from));
    };
    const __m128i cdab = _mm_shuffle_epi32(load(&state[0]), 0xb1);
    const __m128i efgh = _mm_shuffle_epi32(load(&state[4]), 0x1b);
    __m128i abef = _mm_alignr_epi8(cdab, efgh, 8);
    __m128i cdgh = _mm_blend_epi16(efgh, cdab, 0xf0);
    for (; count > 0; --count, blocks += 64) {
        const __m128i abef_before = abef;
        const __m128i cdgh_before = cdgh;
        __m128i words[16];
        for (std::ptrdiff_t i = 0; i < 16; ++i) {  // four rounds each
            if (i < 4) {
                words[i] = _mm_shuffle_epi8(load(blocks + 16 * i), big_endian);
            } else {
                const __m128i shifted = _mm_alignr_epi8(words[i - 1], words[i - 2], 4);
                const __m128i sum =
                    _mm_add_epi32(_mm_sha256msg1_epu32(words[i - 4], words[i - 3]), shifted);
                words[i] = _mm_sha256msg2_epu32(sum, words[i - 1]);
            }
            const __m128i keyed = _mm_add_epi32(words[i], load(round_constants + 4 * i));
            cdgh = _mm_sha256rnds2_epu32(cdgh, abef, keyed);
            abef = _mm_sha256rnds2_epu32(abef, cdgh, _mm_shuffle_epi32(keyed, 0x0e));
        }
        abef = _mm_add_epi32(abef, abef_before);
        cdgh = _mm_add_epi32(cdgh, cdgh_before);
    }
    const __m128i feba = _mm_shuffle_epi32(abef, 0x1b);
    const __m128i dchg = _mm_shuffle_epi32(cdgh, 0xb1);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(&state[0]), _mm_blend_epi16(feba, dchg, 0xf0));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(&state[4]), _mm_alignr_epi8(dchg, feba, 8));
}

bool has_sha_instructions() {
    unsigned a = 0;
    unsigned b = 0;
    unsigned c = 0;
    unsigned d = 0;
    return __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0 && (b >> 29 & 1U) != 0;
}

void work_in(State& state, const char* blocks, std::size_t count) {
    static const bool fast = has_sha_instructions();
    fast ? blocks_by_sha_instructions(state, blocks, count)
         : sha256_blocks_portable(state, blocks, count);
}

std::uint32_t big_endian_word(const char* bytes) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes, sizeof word);
    return __builtin_bswap32(word);
}

}  // namespace

void sha256_blocks_portable(State& state, const char* blocks, std::size_t count) {
    for (; count > 0; --count, blocks += 64) {
        std::uint32_t w[64];
        for (std::ptrdiff_t i = 0; i < 16; ++i)
            w[i] = big_endian_word(blocks + 4 * i);
        for (int i = 16; i < 64; ++i) {
            const std::uint32_t s0 =
                std::rotr(w[i - 15], 7) ^ std::rotr(w[i - 15], 18) ^ w[i - 15] >> 3;
            const std::uint32_t s1 =
                std::rotr(w[i - 2], 17) ^ std::rotr(w[i - 2], 19) ^ w[i - 2] >> 10;
            w[i] = w[i - 16] + s0 + w[i - 7] + s1;
        }
        auto [a, b, c, d, e, f, g, h] = state;
        for (int i = 0; i < 64; ++i) {
            const std::uint32_t s1 = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
            const std::uint32_t t1 = h + s1 + ((e & f) ^ (~e & g)) + round_constants[i] + w[i];
            const std::uint32_t s0 = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
            const std::uint32_t t2 = s0 + ((a & b) ^ (a & c) ^ (b & c));
            h = g;
            g = f;
            f = e;
            e = d + t1;
            d = c;
            c = b;
            b = a;
            a = t1 + t2;
        }
        const State change{a, b, c, d, e, f, g, h};
        for (int i = 0; i < 8; ++i)
            state[i] += change[i];
    }
}

void Sha256::add(std::string_view bytes) {
    bytes_ += bytes.size();
    if (rest_bytes_ > 0) {
        const std::size_t taken = std::min(bytes.size(), block_bytes - rest_bytes_);
        bytes.copy(rest_.data() + rest_bytes_, taken);
        rest_bytes_ += taken;
        bytes.remove_prefix(taken);
        if (rest_bytes_ < block_bytes) return;
        work_in(state_, rest_.data(), 1);
    }
    const std::size_t blocks = bytes.size() / block_bytes;
    work_in(state_, bytes.data(), blocks);
    bytes.remove_prefix(blocks * block_bytes);
    rest_bytes_ = bytes.copy(rest_.data(), bytes.size());
}

std::string Sha256::digest() {
    const std::uint64_t bits = 8 * bytes_;
    // Padding: a set bit, zeros, and the length in bits in the last eight bytes of a block.
    std::string end(1 + (2 * block_bytes - 9 - rest_bytes_) % block_bytes, '\0');
    end[0] = '\x80';
    for (int shift = 56; shift >= 0; shift -= 8)
        end += static_cast<char>(bits >> shift & 0xffU);
    add(end);
    std::string out;
    for (const std::uint32_t word : state_) {
        for (int shift = 28; shift >= 0; shift -= 4)
            out += "0123456789abcdef"[word >> shift & 15U];
    }
    return out;
}

std::string sha256(std::string_view bytes) {
    Sha256 hash;
    hash.add(bytes);
    return hash.digest();
}

std::string sha256_of_file(const std::filesystem::path& path) {
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) throw_errno("cannot read", path);
    Sha256 hash;
    std::vector<char> piece(std::size_t{1} << 18);
    ssize_t got = 1;
    while (got != 0) {
        got = ::read(fd, piece.data(), piece.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) break;
        hash.add({piece.data(), static_cast<std::size_t>(got)});
    }
    const int reason = errno;
    ::close(fd);
    errno = reason;
    if (got < 0) throw_errno("cannot read", path);
    return hash.digest();
}

}  // namespace sonarsim
