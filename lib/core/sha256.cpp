#include "core/sha256.h"

#include <cpuid.h>
#include <fcntl.h>
#include <immintrin.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <span>
#include <type_traits>
#include <vector>

#include "core/file.h"
#include "core/sha256_of_all.h"

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

/// A state as the SHA instructions need it.
struct TwoRegisters {
    __m128i abef, cdgh;
};

__m128i load_16(const void* from) {
    return _mm_loadu_si128(static_cast<const __m128i*>(from));
}

TwoRegisters registers_of(const State& state) {
    const __m128i cdab = _mm_shuffle_epi32(load_16(&state[0]), 0xb1);
    const __m128i efgh = _mm_shuffle_epi32(load_16(&state[4]), 0x1b);
    return {_mm_alignr_epi8(cdab, efgh, 8), _mm_blend_epi16(efgh, cdab, 0xf0)};
}

void store(const TwoRegisters& from, State& state) {
    const __m128i feba = _mm_shuffle_epi32(from.abef, 0x1b);
    const __m128i dchg = _mm_shuffle_epi32(from.cdgh, 0xb1);
    _mm_storeu_si128(reinterpret_cast<__m128i*>(&state[0]), _mm_blend_epi16(feba, dchg, 0xf0));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(&state[4]), _mm_alignr_epi8(dchg, feba, 8));
}

/// Adds `count` blocks of several streams of bytes to their states with the SHA instructions. The
/// streams are interleaved: each instruction waits for the last one of its stream, so four streams
/// take only 2.2 times as long as one.
template <std::size_t streams>
__attribute__((target("sha"))) void blocks_by_sha_instructions(
    std::span<State* const, streams> states, std::span<const char* const, streams> bytes,
    std::size_t count) {
    std::array<const char*, streams> blocks;
    std::ranges::copy(bytes, blocks.begin());
    const __m128i big_endian = _mm_set_epi64x(0x0c0d0e0f08090a0b, 0x0405060700010203);
    TwoRegisters now[streams];
    for (std::size_t s = 0; s < streams; ++s)
        now[s] = registers_of(*states[s]);
    for (; count > 0; --count) {
        TwoRegisters before[streams];
        __m128i words[streams][16];
        for (std::size_t s = 0; s < streams; ++s)
            before[s] = now[s];
            // Unrolling keeps the words in registers: a store and a load would delay every round.
#pragma GCC unroll 16
        for (std::ptrdiff_t i = 0; i < 16; ++i) {  // four rounds each
#pragma GCC unroll 4
            for (std::size_t s = 0; s < streams; ++s) {
                __m128i* const word = words[s];
                if (i < 4) {
                    word[i] = _mm_shuffle_epi8(load_16(blocks[s] + 16 * i), big_endian);
                } else {
                    const __m128i shifted = _mm_alignr_epi8(word[i - 1], word[i - 2], 4);
                    const __m128i sum =
                        _mm_add_epi32(_mm_sha256msg1_epu32(word[i - 4], word[i - 3]), shifted);
                    word[i] = _mm_sha256msg2_epu32(sum, word[i - 1]);
                }
                const __m128i keyed = _mm_add_epi32(word[i], load_16(round_constants + 4 * i));
                now[s].cdgh = _mm_sha256rnds2_epu32(now[s].cdgh, now[s].abef, keyed);
                now[s].abef =
                    _mm_sha256rnds2_epu32(now[s].abef, now[s].cdgh, _mm_shuffle_epi32(keyed, 0x0e));
            }
        }
        for (std::size_t s = 0; s < streams; ++s) {
            now[s].abef = _mm_add_epi32(now[s].abef, before[s].abef);
            now[s].cdgh = _mm_add_epi32(now[s].cdgh, before[s].cdgh);
            blocks[s] += 64;
        }
    }
    for (std::size_t s = 0; s < streams; ++s)
        store(now[s], *states[s]);
}

bool find_sha_instructions() {
    unsigned a = 0;
    unsigned b = 0;
    unsigned c = 0;
    unsigned d = 0;
    return __get_cpuid_count(7, 0, &a, &b, &c, &d) != 0 && (b >> 29 & 1U) != 0;
}

bool has_sha_instructions() {
    static const bool has = find_sha_instructions();
    return has;
}

constexpr std::size_t most_streams = 4;

/// Adds `count` blocks of each stream to its state.
void work_in_all(std::span<State* const> states, std::span<const char* const> blocks,
                 std::size_t count) {
    const auto take = [&]<std::size_t streams>(std::integral_constant<std::size_t, streams>) {
        blocks_by_sha_instructions<streams>(states.first<streams>(), blocks.first<streams>(),
                                            count);
    };
    const std::size_t streams = has_sha_instructions() ? states.size() : 0;
    static_assert(most_streams == 4);
    if (streams == 1) return take(std::integral_constant<std::size_t, 1>());
    if (streams == 2) return take(std::integral_constant<std::size_t, 2>());
    if (streams == 3) return take(std::integral_constant<std::size_t, 3>());
    if (streams == 4) return take(std::integral_constant<std::size_t, 4>());
    for (std::size_t s = 0; s < states.size(); ++s)
        sha256_blocks_portable(*states[s], blocks[s], count);
}

void work_in(State& state, const char* blocks, std::size_t count) {
    work_in_all(std::array{&state}, std::array{blocks}, count);
}

constexpr std::size_t bytes_of_block = 64;
constexpr State first_state{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                            0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};

/// The digest of `all_bytes` bytes, of which `rest` is not in the state yet.
std::string digest_of(State state, std::string_view rest, std::uint64_t all_bytes) {
    const std::size_t blocks = rest.size() / bytes_of_block;
    work_in(state, rest.data(), blocks);
    // Padding: a set bit, zeros, and the length in bits in the last eight bytes of a block.
    std::string end(rest.substr(blocks * bytes_of_block));
    end += static_cast<char>(0x80);
    end.append((2 * bytes_of_block - 8 - end.size()) % bytes_of_block, char{0});
    for (int shift = 56; shift >= 0; shift -= 8)
        end += static_cast<char>(8 * all_bytes >> shift & 0xffU);
    work_in(state, end.data(), end.size() / bytes_of_block);
    std::string out;
    for (const std::uint32_t word : state) {
        for (int shift = 28; shift >= 0; shift -= 4)
            out += "0123456789abcdef"[word >> shift & 15U];
    }
    return out;
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
    return digest_of(state_, {rest_.data(), rest_bytes_}, bytes_);
}

std::vector<std::string> sha256_of_all(std::span<const std::string_view> texts) {
    std::vector<State> states(texts.size(), first_state);
    std::vector<std::string_view> left(texts.begin(), texts.end());
    // The longest come first, so that the last ones end at about the same time.
    std::vector<std::size_t> waiting(texts.size());
    std::iota(waiting.begin(), waiting.end(), 0);
    std::ranges::stable_sort(waiting, {}, [&](std::size_t k) { return texts[k].size(); });
    std::vector<std::size_t> taken;
    while (!waiting.empty() || !taken.empty()) {
        for (; taken.size() < most_streams && !waiting.empty(); waiting.pop_back())
            taken.push_back(waiting.back());
        std::vector<State*> own;
        std::vector<const char*> blocks;
        std::size_t count = SIZE_MAX;
        for (const std::size_t k : taken) {
            own.push_back(&states[k]);
            blocks.push_back(left[k].data());
            count = std::min(count, left[k].size() / bytes_of_block);
        }
        work_in_all(own, blocks, count);
        for (const std::size_t k : taken)
            left[k].remove_prefix(count * bytes_of_block);
        std::erase_if(taken, [&](std::size_t k) { return left[k].size() < bytes_of_block; });
    }
    std::vector<std::string> digests;
    for (std::size_t k = 0; k < texts.size(); ++k)
        digests.push_back(digest_of(states[k], left[k], texts[k].size()));
    return digests;
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
