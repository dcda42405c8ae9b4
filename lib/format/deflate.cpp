#include "format/deflate.h"

#include <immintrin.h>
#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <utility>
#include <vector>

#include "format/huffman.h"

namespace sonarsim {

namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t end_symbol = 256;
constexpr std::size_t symbols_known = 286;
constexpr int max_code_bits = 14;  // DEFLATE allows 15; with 14 four codes fit one put()

constexpr std::size_t min_run = 4;
constexpr std::size_t max_run = 258;
/// A token is a byte, or 256 plus the length of a run.
constexpr std::size_t run_token = 256;
constexpr std::size_t tokens_known = run_token + max_run + 1;

/// A bit string; its first bit is the lowest.
struct BitCode {
    std::uint32_t value = 0;
    int bits = 0;
};
using TokenCodes = std::array<BitCode, tokens_known>;

/// Writes bits, lowest first.
struct BitCursor {
    char* at;              ///< the next byte
    std::uint64_t buffer;  ///< bits that fill no byte yet
    unsigned held;         ///< their number, less than 8

    void put(const BitCode& code) { put(code.value, code.bits); }
    /// Writes up to 56 bits.
    void put(std::uint64_t value, int bits) {
        buffer |= value << held;
        held += static_cast<unsigned>(bits);
        std::memcpy(at, &buffer, sizeof(buffer));
        at += held / 8;
        buffer >>= held & 56U;
        held &= 7U;
    }
};

/// Literal bytes and the run after them; the last stretch of a block may have no run.
struct Stretch {
    std::uint32_t literals;
    std::uint32_t run;
};

struct Tokens {
    std::vector<Stretch> stretches;
    std::array<std::uint32_t, tokens_known> counts{};
};

/// The number of bytes from `at` on that equal the bytes `back` before them, up to `end`.
std::size_t run_length(const std::uint8_t* at, const std::uint8_t* end, std::ptrdiff_t back) {
    const std::uint8_t* const begin = at;
    for (; end - at >= 8; at += 8) {
        std::uint64_t here = 0;
        std::uint64_t before = 0;
        std::memcpy(&here, at, sizeof(here));
        std::memcpy(&before, at - back, sizeof(before));
        if (here != before)
            return static_cast<std::size_t>(at - begin + std::countr_zero(here ^ before) / 8);
    }
    return static_cast<std::size_t>(std::mismatch(at, end, at - back).first - begin);
}

/// The first run of at least min_run bytes that begins at `at` or later; `end` if there is none.
const std::uint8_t* find_run(const std::uint8_t* at, const std::uint8_t* end, std::ptrdiff_t back) {
    while (end - at >= 32) {
        const __m256i here = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(at));
        const __m256i before = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(at - back));
        const auto equal =
            static_cast<std::uint32_t>(_mm256_movemask_epi8(_mm256_cmpeq_epi8(here, before)));
        static_assert(min_run == 4);
        const std::uint32_t pairs = equal & equal >> 1;
        const std::uint32_t runs = pairs & pairs >> 2;
        if (runs != 0) return at + std::countr_zero(runs);
        at += 32 - (min_run - 1);
    }
    for (; end - at >= std::ptrdiff_t{min_run}; ++at) {
        if (run_length(at, at + min_run, back) == min_run) return at;
    }
    return end;
}

Tokens find_tokens(Bytes bytes, std::ptrdiff_t back) {
    Tokens tokens;
    // Neighbours go to different counters: one that was just written is slow to read.
    std::array<std::array<std::uint32_t, run_token>, 4> counts{};
    const std::uint8_t* at = bytes.data();
    const std::uint8_t* const end = at + bytes.size();
    // The first pixel has none before it.
    const std::uint8_t* first = at + std::min<std::ptrdiff_t>(back, end - at);
    while (at < end) {
        const std::uint8_t* const run_at = find_run(std::max(at, first), end, back);
        const std::uint8_t* byte = at;
        for (; run_at - byte >= 4; byte += 4) {
            for (std::size_t k = 0; k < 4; ++k)
                ++counts[k][byte[k]];
        }
        for (; byte < run_at; ++byte)
            ++counts[0][*byte];
        const std::ptrdiff_t most = std::min<std::ptrdiff_t>(max_run, end - run_at);
        const std::size_t run = run_length(run_at, run_at + most, back);
        if (run > 0) ++tokens.counts[run_token + run];
        tokens.stretches.push_back(
            {static_cast<std::uint32_t>(run_at - at), static_cast<std::uint32_t>(run)});
        at = run_at + run;
    }
    for (std::size_t byte = 0; byte < run_token; ++byte)
        tokens.counts[byte] = counts[0][byte] + counts[1][byte] + counts[2][byte] + counts[3][byte];
    return tokens;
}

/// The symbol for the length of a run, and the bits that follow it (RFC 1951, 3.2.5).
std::pair<std::size_t, BitCode> run_symbol(std::size_t length) {
    if (length == max_run) return {285, {}};
    const auto offset = static_cast<std::uint32_t>(length - 3);
    if (offset < 8) return {257 + offset, {}};
    // There are four symbols for each power of two.
    const int extra = std::bit_width(offset) - 3;
    const std::uint32_t step = (offset >> extra) - 4;
    return {261 + 4 * static_cast<std::size_t>(extra) + step,
            {offset & ((1U << extra) - 1), extra}};
}

/// The bits of each token. A run is followed by the one bit of the only distance.
TokenCodes token_codes(const std::vector<std::uint8_t>& lengths,
                       const std::vector<std::uint16_t>& codes) {
    TokenCodes out;
    for (std::size_t byte = 0; byte < run_token; ++byte)
        out[byte] = {codes[byte], lengths[byte]};
    for (std::size_t length = min_run; length <= max_run; ++length) {
        const auto [symbol, extra] = run_symbol(length);
        const int bits = lengths[symbol];
        out[run_token + length] = {codes[symbol] | extra.value << bits, bits + extra.bits + 1};
    }
    return out;
}

/// Writes the code lengths of a block (RFC 1951, 3.2.7), each length of 0 to 15 in a code of four bits.
void put_lengths(BitCursor& to, const std::vector<std::uint8_t>& lengths, int distances) {
    constexpr std::array<std::uint32_t, 19> order{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                  11, 4,  12, 3, 13, 2, 14, 1, 15};
    constexpr std::size_t plain_lengths = 16;  // the others repeat a length
    static constexpr std::array<std::uint8_t, plain_lengths> code_bits{4, 4, 4, 4, 4, 4, 4, 4,
                                                                       4, 4, 4, 4, 4, 4, 4, 4};
    const std::vector<std::uint16_t> codes = huffman_codes(code_bits);
    to.put({symbols_known - 257, 5});
    to.put({static_cast<std::uint32_t>(distances - 1), 5});
    to.put({order.size() - 4, 4});
    for (const std::uint32_t length : order)
        to.put({length < plain_lengths ? 4U : 0U, 3});
    for (const std::uint8_t length : lengths)
        to.put({codes[length], 4});
}

/// Writes literals, four at a time (at most 56 bits), since each put() waits for the one before.
void put_literals(BitCursor& to, const TokenCodes& codes, Bytes bytes) {
    const std::uint8_t* at = bytes.data();
    std::size_t left = bytes.size();
    for (; left >= 4; left -= 4, at += 4) {
        const BitCode& a = codes[at[0]];
        const BitCode& b = codes[at[1]];
        const BitCode& c = codes[at[2]];
        const BitCode& d = codes[at[3]];
        const std::uint64_t low = a.value | std::uint64_t{b.value} << a.bits;
        const std::uint64_t high = c.value | std::uint64_t{d.value} << c.bits;
        to.put(low | high << (a.bits + b.bits), a.bits + b.bits + c.bits + d.bits);
    }
    for (; left > 0; --left, ++at)
        to.put(codes[*at]);
}

}  // namespace

// Deflate with a window of 32 KiB, packed fast (RFC 1950, 2.2).
ZlibPacker::ZlibPacker(int pixel_bytes) : pixel_bytes_(pixel_bytes), out_("\x78\x01") {}

void ZlibPacker::add(Bytes bytes, bool last) {
    adler_ = libdeflate_adler32(adler_, bytes.data(), bytes.size());
    const Tokens tokens = find_tokens(bytes, pixel_bytes_);
    std::array<std::uint32_t, symbols_known> counts{};
    std::copy_n(tokens.counts.begin(), run_token, counts.begin());
    counts[end_symbol] = 1;
    for (std::size_t length = min_run; length <= max_run; ++length)
        counts[run_symbol(length).first] += tokens.counts[run_token + length];
    std::vector<std::uint8_t> lengths = huffman_lengths(counts, max_code_bits);
    const std::vector<std::uint16_t> codes = huffman_codes(lengths);
    const TokenCodes code_of = token_codes(lengths, codes);

    std::uint64_t bits = std::uint64_t{max_code_bits} * (symbols_known + 64);
    for (std::size_t token = 0; token < tokens_known; ++token)
        bits +=
            std::uint64_t{tokens.counts[token]} * static_cast<std::uint64_t>(code_of[token].bits);
    const std::size_t begin = out_.size();
    out_.resize(begin + bits / 8 + 2 * sizeof(buffer_));
    BitCursor to{out_.data() + begin, buffer_, held_};
    to.put({last ? 0b101U : 0b100U, 3});
    const BitCode end{codes[end_symbol], lengths[end_symbol]};
    // The only distance is that of a pixel; its code has one bit.
    lengths.resize(symbols_known + static_cast<std::size_t>(pixel_bytes_), 0);
    lengths.back() = 1;
    put_lengths(to, lengths, pixel_bytes_);
    for (const Stretch& stretch : tokens.stretches) {
        put_literals(to, code_of, bytes.first(stretch.literals));
        if (stretch.run > 0) to.put(code_of[run_token + stretch.run]);
        bytes = bytes.subspan(stretch.literals + stretch.run);
    }
    to.put(end);
    if (last) {
        if (to.held > 0) to.put(0, 8 - static_cast<int>(to.held));
        for (int shift = 24; shift >= 0; shift -= 8)
            to.put(adler_ >> shift & 0xFF, 8);
    }
    buffer_ = to.buffer;
    held_ = to.held;
    out_.resize(static_cast<std::size_t>(to.at - out_.data()));
}

std::string ZlibPacker::take() {
    return std::exchange(out_, {});
}

}  // namespace sonarsim
