#include <immintrin.h>
#include <libdeflate.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <functional>
#include <queue>
#include <utility>

#include "output/format/png.h"

namespace sonarsim {

namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::size_t end_symbol = 256;  // bytes are below it, lengths of runs above
constexpr std::size_t symbols_known = 286;
constexpr int max_code_bits = 14;  // DEFLATE allows 15; with 14 four codes fit one put()
constexpr std::ptrdiff_t min_run = 4;
constexpr std::ptrdiff_t max_run = 258;

/// A bit string; its first bit is the lowest.
struct BitCode {
    std::uint32_t value = 0;
    int bits = 0;
};

/// The depth of each symbol in the Huffman tree of its counts, of which two are not 0; 0: unused.
std::vector<std::uint8_t> tree_depths(std::span<const std::uint32_t> counts) {
    using Node = std::pair<std::uint64_t, std::size_t>;  // count and number
    std::priority_queue<Node, std::vector<Node>, std::greater<>> nodes;
    for (std::size_t symbol = 0; symbol < counts.size(); ++symbol) {
        if (counts[symbol] > 0) nodes.emplace(counts[symbol], symbol);
    }
    std::vector<std::size_t> parent(2 * counts.size());
    std::size_t joined = counts.size();  // number of the next node that joins two
    for (; nodes.size() > 1; ++joined) {
        std::uint64_t count = 0;
        for (int child = 0; child < 2; ++child, nodes.pop()) {
            count += nodes.top().first;
            parent[nodes.top().second] = joined;
        }
        nodes.emplace(count, joined);
    }
    std::vector<std::uint8_t> depths(joined, 0);
    for (std::size_t k = joined - 1; k-- > 0;) {
        if (parent[k] > 0) depths[k] = static_cast<std::uint8_t>(depths[parent[k]] + 1);
    }
    depths.resize(counts.size());
    return depths;
}

/// The lengths of a Huffman code (RFC 1951, 3.2.2), none above max_code_bits. Halved counts give a
/// flatter tree; that of equal counts is within the limit.
std::vector<std::uint8_t> huffman_lengths(std::vector<std::uint32_t> counts) {
    std::vector<std::uint8_t> lengths = tree_depths(counts);
    while (*std::ranges::max_element(lengths) > max_code_bits) {
        for (std::uint32_t& count : counts)
            count = (count + 1) / 2;
        lengths = tree_depths(counts);
    }
    return lengths;
}

/// The codes of these lengths.
std::vector<BitCode> huffman_codes(std::span<const std::uint8_t> lengths) {
    std::array<std::uint16_t, max_code_bits + 2> next{};
    for (const std::uint8_t length : lengths) {
        if (length > 0) ++next[length + 1];
    }
    for (std::size_t bits = 1; bits < next.size(); ++bits)
        next[bits] = static_cast<std::uint16_t>(2 * (next[bits - 1] + next[bits]));
    std::vector<BitCode> codes(lengths.size());
    for (std::size_t k = 0; k < lengths.size(); ++k) {
        if (lengths[k] == 0) continue;
        std::uint32_t code = next[lengths[k]]++;
        for (; codes[k].bits < lengths[k]; ++codes[k].bits, code >>= 1)
            codes[k].value = 2 * codes[k].value + (code & 1);
    }
    return codes;
}

/// Writes bits, lowest first.
struct BitCursor {
    char* at;              ///< the next byte
    std::uint64_t buffer;  ///< bits that fill no byte yet
    unsigned held;         ///< their number

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
    for (; end - at >= min_run; ++at) {
        if (std::equal(at, at + min_run, at - back)) return at;
    }
    return end;
}

/// Calls visit(literals, run) for single bytes and the length of the run after them, 0 at the end.
template <class Visit>
void for_each_stretch(Bytes bytes, std::ptrdiff_t back, const Visit& visit) {
    const std::uint8_t* at = bytes.data();
    const std::uint8_t* const end = at + bytes.size();
    // The first pixel has none before it.
    const std::uint8_t* const first = at + std::min<std::ptrdiff_t>(back, end - at);
    while (at < end) {
        const std::uint8_t* const run_at = find_run(std::max(at, first), end, back);
        const std::uint8_t* const limit = run_at + std::min(max_run, end - run_at);
        const std::uint8_t* const run_end = std::mismatch(run_at, limit, run_at - back).first;
        visit(Bytes(at, run_at), static_cast<std::size_t>(run_end - run_at));
        at = run_end;
    }
}

/// Writes the code lengths of a block (RFC 1951, 3.2.7), each of 0 to 15 in a code of four bits.
void put_lengths(BitCursor& to, const std::vector<std::uint8_t>& lengths, int distances) {
    constexpr std::array<std::uint32_t, 19> order{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                                  11, 4,  12, 3, 13, 2, 14, 1, 15};
    constexpr std::size_t plain_lengths = 16;  // the others repeat a length
    const std::vector<BitCode> codes = huffman_codes(std::vector<std::uint8_t>(plain_lengths, 4));
    to.put({symbols_known - 257, 5});
    to.put({static_cast<std::uint32_t>(distances - 1), 5});
    to.put({order.size() - 4, 4});
    for (const std::uint32_t length : order)
        to.put({length < plain_lengths ? 4U : 0U, 3});
    for (const std::uint8_t length : lengths)
        to.put(codes[length]);
}

/// Writes literals, four at a time (at most 56 bits), since each put() waits for the one before.
void put_literals(BitCursor& to, const std::vector<BitCode>& codes, Bytes bytes) {
    for (; bytes.size() >= 4; bytes = bytes.subspan(4)) {
        const BitCode four[4] = {codes[bytes[0]], codes[bytes[1]], codes[bytes[2]],
                                 codes[bytes[3]]};
        const int two = four[0].bits + four[1].bits;
        const std::uint64_t low = four[0].value | std::uint64_t{four[1].value} << four[0].bits;
        const std::uint64_t high = four[2].value | std::uint64_t{four[3].value} << four[2].bits;
        to.put(low | high << two, two + four[2].bits + four[3].bits);
    }
    for (const std::uint8_t byte : bytes)
        to.put(codes[byte]);
}

}  // namespace

std::string ZlibPacker::pack(Bytes bytes, bool last) {
    adler_ = libdeflate_adler32(adler_, bytes.data(), bytes.size());
    std::vector<std::uint32_t> counts(symbols_known);
    counts[end_symbol] = 1;
    for_each_stretch(bytes, pixel_bytes_, [&](Bytes literals, std::size_t run) {
        for (const std::uint8_t byte : literals)
            ++counts[byte];
        if (run > 0) ++counts[run_symbol(run).first];
    });
    std::vector<std::uint8_t> lengths = huffman_lengths(std::move(counts));
    const std::vector<BitCode> codes = huffman_codes(lengths);
    // The only distance is that of a pixel; its code has one bit.
    lengths.resize(symbols_known + static_cast<std::size_t>(pixel_bytes_), 0);
    lengths.back() = 1;
    constexpr std::size_t max_header = 256;  // and a byte takes at most max_code_bits
    std::string out(2 * bytes.size() + max_header, '\0');
    BitCursor to{out.data(), buffer_, held_};
    to.put({last ? 0b101U : 0b100U, 3});
    put_lengths(to, lengths, pixel_bytes_);
    for_each_stretch(bytes, pixel_bytes_, [&](Bytes literals, std::size_t run) {
        put_literals(to, codes, literals);
        if (run == 0) return;
        const auto [symbol, extra] = run_symbol(run);
        to.put(codes[symbol]);
        to.put(extra.value, extra.bits + 1);  // with the bit of the distance
    });
    to.put(codes[end_symbol]);
    if (last) {
        if (to.held > 0) to.put(0, 8 - static_cast<int>(to.held));
        to.put(__builtin_bswap32(adler_), 32);
    }
    buffer_ = to.buffer;
    held_ = to.held;
    out.resize(static_cast<std::size_t>(to.at - out.data()));
    return out;
}

}  // namespace sonarsim
