#include "format/deflate.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <string_view>
#include <vector>

#include "format/adler.h"
#include "format/huffman.h"
#include "format/tokens.h"

namespace sonarsim {

namespace {

using Bytes = std::span<const std::uint8_t>;

/// Bytes of a block. Each block has its own Huffman code, which fits a longer block less well.
constexpr std::size_t block_bytes = std::size_t{1} << 17;
constexpr std::size_t stored_bytes = 65535;

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

using TokenCodes = std::array<BitCode, tokens_known>;

/// Two codes as one, of up to 42 bits.
struct TwoCodes {
    TwoCodes(const BitCode& first, const BitCode& second)
        : value(first.value | std::uint64_t{second.value} << first.bits),
          bits(first.bits + second.bits) {}
    std::uint64_t value;
    int bits;
};

/// Writes bytes as literals, four at a time, since each put() waits for the previous one.
void put_literals(BitCursor& to, const TokenCodes& codes, const std::uint8_t* bytes,
                  std::size_t count) {
    for (; count >= 4; count -= 4, bytes += 4) {
        const TwoCodes low(codes[bytes[0]], codes[bytes[1]]);
        const TwoCodes high(codes[bytes[2]], codes[bytes[3]]);
        if (low.bits + high.bits <= BitCursor::most_bits) {
            to.put(low.value | high.value << low.bits, low.bits + high.bits);
        } else {
            to.put(low.value, low.bits);
            to.put(high.value, high.bits);
        }
    }
    for (; count > 0; --count, ++bytes)
        to.put(codes[*bytes]);
}

/// Writes the code lengths of a block in a Huffman code of their own (RFC 1951, 3.2.7).
void put_lengths(BitCursor& to, const std::vector<std::uint8_t>& lengths, int distances) {
    constexpr std::array<int, 19> order{16, 17, 18, 0, 8,  7, 9,  6, 10, 5,
                                        11, 4,  12, 3, 13, 2, 14, 1, 15};
    std::array<std::uint32_t, order.size()> counts{};
    for (const std::uint8_t length : lengths)
        ++counts[length];
    const std::vector<std::uint8_t> own = huffman_lengths(counts, longest_length_code);
    const std::vector<std::uint16_t> codes = huffman_codes(own);
    to.put({symbols_known - 257, 5});
    to.put({static_cast<std::uint32_t>(distances - 1), 5});
    to.put({order.size() - 4, 4});
    for (const int symbol : order)
        to.put({own[symbol], 3});
    for (const std::uint8_t length : lengths)
        to.put({codes[length], own[length]});
}

void put_block(BitWriter& writer, const Tokens& block, int back, bool last) {
    std::array<std::uint32_t, symbols_known> counts{};
    std::ranges::copy_n(block.counts.begin(), run_token, counts.begin());
    counts[end_symbol] = 1;
    for (int length = shortest_run; length <= longest_run; ++length)
        counts[run_length(length).symbol] += block.counts[run_token + length];
    std::vector<std::uint8_t> lengths = huffman_lengths(counts, longest_code);
    const std::vector<std::uint16_t> codes = huffman_codes(lengths);

    TokenCodes code_of;
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
    const BitCode end{codes[end_symbol], lengths[end_symbol]};
    lengths.resize(symbols_known + static_cast<std::size_t>(back), 0);
    lengths.back() = 1;
    BitCursor to = writer.begin(bits);
    to.put({last ? 0b101U : 0b100U, 3});
    put_lengths(to, lengths, back);
    const std::uint8_t* at = block.bytes;
    for (const Stretch& stretch : block.stretches) {
        put_literals(to, code_of, at, stretch.literals);
        if (stretch.run > 0) to.put(code_of[run_token + stretch.run]);
        at += stretch.literals + stretch.run;
    }
    to.put(end);
    writer.end(to);
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
    // A block is packed only if more bytes follow, since finish() must mark the last block.
    while (bytes_.size() - packed_ > block_bytes)
        pack(block_bytes, false);
}

void ZlibStream::finish() {
    pack(bytes_.size() - packed_, true);
    writer_.align();
    BitCursor to = writer_.begin(32);
    for (int shift = 24; shift >= 0; shift -= 8)
        to.put(adler_ >> shift & 0xFF, 8);
    writer_.end(to);
}

void ZlibStream::pack(std::size_t count, bool last) {
    const std::size_t end = packed_ + count;
    put_block(writer_, tokens_of(bytes_, packed_, end, pixel_bytes_), pixel_bytes_, last);
    packed_ = std::min<std::size_t>(end, static_cast<std::size_t>(pixel_bytes_));
    bytes_.erase(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(end - packed_));
}

}  // namespace sonarsim
