#include "format/deflate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <string_view>
#include <vector>

#include "format/adler.h"
#include "format/huffman.h"

namespace sonarsim {

namespace {

using Bytes = std::span<const std::uint8_t>;

/// Bytes of a block, which has one Huffman code. A longer block would fit its code less well.
constexpr std::size_t block_bytes = std::size_t{1} << 17;
constexpr std::size_t stored_bytes = 65535;

constexpr int shortest_run = 4;
constexpr int longest_run = 258;
/// A token is a byte, or 256 plus the length of a run.
constexpr int run_token = 256;
constexpr std::size_t tokens_known = run_token + longest_run + 1;

constexpr std::size_t end_symbol = 256;
constexpr std::size_t symbols_known = 286;
constexpr int longest_code = 15;
constexpr int longest_length_code = 7;

/// Deflate with a window of 32 KiB, packed fast (RFC 1950, 2.2).
constexpr std::string_view stream_start{"\x78\x01", 2};

/// The symbol for the length of a run, and the bits that follow it (RFC 1951, 3.2.5).
struct RunLength {
    std::size_t symbol;
    BitCode extra;
};

RunLength run_length(int length) {
    if (length == longest_run) return {285, {}};
    const auto offset = static_cast<std::uint32_t>(length - 3);
    if (offset < 8) return {257 + offset, {}};
    // There are four symbols for each power of two.
    const int extra = std::bit_width(offset) - 3;
    const std::uint32_t step = (offset >> extra) - 4;
    return {257 + 4 + 4 * static_cast<std::size_t>(extra) + step,
            {offset & ((1U << extra) - 1), extra}};
}

void add_stored(std::string& out, Bytes bytes) {
    do {
        const Bytes part = bytes.first(std::min(bytes.size(), stored_bytes));
        bytes = bytes.subspan(part.size());
        const auto size = static_cast<std::uint16_t>(part.size());
        const auto inverse = static_cast<std::uint16_t>(~size);
        out += bytes.empty() ? '\1' : '\0';
        for (const std::uint16_t value : {size, inverse}) {
            out += static_cast<char>(value & 0xFF);
            out += static_cast<char>(value >> 8);
        }
        out.append(reinterpret_cast<const char*>(part.data()), part.size());
    } while (!bytes.empty());
}

/// The number of bytes from `at` on that equal the bytes `back` before them, at most `most`.
int run_at(const std::uint8_t* at, std::ptrdiff_t back, int most) {
    int length = 0;
    while (length + 8 <= most) {
        std::uint64_t here = 0;
        std::uint64_t before = 0;
        std::memcpy(&here, at + length, sizeof(here));
        std::memcpy(&before, at + length - back, sizeof(before));
        if (here != before) return length + std::countr_zero(here ^ before) / 8;
        length += 8;
    }
    while (length < most && at[length] == at[length - back])
        ++length;
    return length;
}

/// The tokens of a block and how often each occurs.
struct Tokens {
    std::vector<std::uint16_t> tokens;
    std::array<std::uint32_t, tokens_known> counts{};
};

Tokens tokens_of(Bytes all, std::size_t begin, std::size_t end, std::ptrdiff_t back) {
    Tokens out;
    out.tokens.resize(end - begin);
    std::uint16_t* token = out.tokens.data();
    const std::uint8_t* const last = all.data() + end;
    const std::uint8_t* at = all.data() + begin;
    const auto put = [&](int value) {
        *token++ = static_cast<std::uint16_t>(value);
        ++out.counts[value];
    };
    for (; at < last && at - all.data() < back; ++at)
        put(*at);
    while (last - at >= shortest_run) {
        std::uint32_t here = 0;
        std::uint32_t before = 0;
        std::memcpy(&here, at, sizeof(here));
        std::memcpy(&before, at - back, sizeof(before));
        if (here != before) {
            put(*at++);
            continue;
        }
        const auto most = static_cast<int>(std::min<std::ptrdiff_t>(longest_run, last - at));
        const int length = run_at(at, back, most);
        put(run_token + length);
        at += length;
    }
    while (at < last)
        put(*at++);
    out.tokens.resize(static_cast<std::size_t>(token - out.tokens.data()));
    return out;
}

/// Writes the code lengths of a block in a Huffman code of their own (RFC 1951, 3.2.7).
void put_lengths(BitWriter& writer, const std::vector<std::uint8_t>& lengths, int distances) {
    constexpr std::array<int, 19> order{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                        11, 4,  12, 3, 13, 2, 14, 1, 15};
    std::array<std::uint32_t, order.size()> counts{};
    for (const std::uint8_t length : lengths)
        ++counts[length];
    const std::vector<std::uint8_t> own = huffman_lengths(counts, longest_length_code);
    const std::vector<std::uint16_t> codes = huffman_codes(own);
    writer.put({symbols_known - 257, 5});
    writer.put({static_cast<std::uint32_t>(distances - 1), 5});
    writer.put({order.size() - 4, 4});
    for (const int symbol : order)
        writer.put({own[symbol], 3});
    for (const std::uint8_t length : lengths)
        writer.put({codes[length], own[length]});
}

void put_block(BitWriter& writer, const Tokens& block, int back, bool last) {
    std::array<std::uint32_t, symbols_known> counts{};
    std::ranges::copy_n(block.counts.begin(), run_token, counts.begin());
    counts[end_symbol] = 1;
    for (int length = shortest_run; length <= longest_run; ++length)
        counts[run_length(length).symbol] += block.counts[run_token + length];
    std::vector<std::uint8_t> lengths = huffman_lengths(counts, longest_code);
    const std::vector<std::uint16_t> codes = huffman_codes(lengths);

    std::array<BitCode, tokens_known> code_of;
    for (int byte = 0; byte < run_token; ++byte)
        code_of[byte] = {codes[byte], lengths[byte]};
    for (int length = shortest_run; length <= longest_run; ++length) {
        const RunLength run = run_length(length);
        const int bits = lengths[run.symbol];
        // Only one distance occurs; its code is one zero bit.
        code_of[run_token + length] = {codes[run.symbol] | run.extra.value << bits,
                                       bits + run.extra.bits + 1};
    }
    std::uint64_t bits = std::uint64_t{longest_code} * (symbols_known + 64);
    for (std::size_t token = 0; token < tokens_known; ++token)
        bits +=
            std::uint64_t{block.counts[token]} * static_cast<std::uint64_t>(code_of[token].bits);
    writer.reserve(bits);

    writer.put({last ? 0b101U : 0b100U, 3});
    const BitCode end{codes[end_symbol], lengths[end_symbol]};
    lengths.resize(symbols_known + static_cast<std::size_t>(back), 0);
    lengths.back() = 1;
    put_lengths(writer, lengths, back);
    // Codes have up to 21 bits. They are written in pairs, since each put() waits for the last one.
    const std::vector<std::uint16_t>& tokens = block.tokens;
    for (std::size_t k = 0; k + 1 < tokens.size(); k += 2) {
        const BitCode& first = code_of[tokens[k]];
        const BitCode& second = code_of[tokens[k + 1]];
        writer.put(first.value | std::uint64_t{second.value} << first.bits,
                   first.bits + second.bits);
    }
    if (tokens.size() % 2 == 1) writer.put(code_of[tokens.back()]);
    writer.put(end);
}

}  // namespace

std::string zlib_bytes(Bytes bytes, int pixel_bytes, Packing packing) {
    std::string out;
    if (packing == Packing::stored || bytes.empty()) {
        out.reserve(bytes.size() + 5 * (bytes.size() / stored_bytes + 1) + 6);
        out += stream_start;
        add_stored(out, bytes);
    } else {
        BitWriter writer{std::string(stream_start)};
        for (std::size_t begin = 0; begin < bytes.size(); begin += block_bytes) {
            const std::size_t end = std::min(begin + block_bytes, bytes.size());
            put_block(writer, tokens_of(bytes, begin, end, pixel_bytes), pixel_bytes,
                      end == bytes.size());
        }
        writer.align();
        out = writer.take();
    }
    const std::uint32_t sum = adler_32(bytes);
    for (int shift = 24; shift >= 0; shift -= 8)
        out += static_cast<char>(sum >> shift & 0xFF);
    return out;
}

ZlibStream::ZlibStream(int pixel_bytes)
    : pixel_bytes_(pixel_bytes), writer_(std::string(stream_start)) {}

void ZlibStream::add(Bytes bytes) {
    adler_ = adler_32(bytes, adler_);
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
    // One more byte than a block, since the last block has to be known as such.
    while (bytes_.size() - packed_ > block_bytes)
        pack(block_bytes, false);
}

void ZlibStream::finish() {
    pack(bytes_.size() - packed_, true);
    writer_.align();
    for (int shift = 24; shift >= 0; shift -= 8)
        writer_.put(adler_ >> shift & 0xFF, 8);
}

void ZlibStream::pack(std::size_t count, bool last) {
    const std::size_t end = packed_ + count;
    put_block(writer_, tokens_of(bytes_, packed_, end, pixel_bytes_), pixel_bytes_, last);
    packed_ = std::min<std::size_t>(end, static_cast<std::size_t>(pixel_bytes_));
    bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(end - packed_));
}

}  // namespace sonarsim
