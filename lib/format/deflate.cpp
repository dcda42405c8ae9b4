#include "format/deflate.h"

#include <immintrin.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <vector>

#include "format/huffman.h"

namespace sonarsim {

namespace {

using Bytes = std::span<const std::uint8_t>;

/// The bytes that share one code; more of them would share one that suits them less.
constexpr std::size_t block_bytes = std::size_t{1} << 17;
constexpr std::size_t stored_bytes = 65535;

constexpr int shortest_run = 4;
constexpr int longest_run = 258;
/// A token is a byte, or 256 and the length of a run.
constexpr int run_token = 256;
constexpr std::size_t tokens_known = run_token + longest_run + 1;

constexpr std::size_t end_symbol = 256;
constexpr std::size_t symbols_known = 286;
constexpr int longest_code = 15;
constexpr int longest_length_code = 7;

/// What stands in the stream for a token or a symbol.
struct Code {
    std::uint32_t value = 0;
    int bits = 0;
};

/// The symbol for the length of a run, and the bits that follow it (RFC 1951, 3.2.5).
struct RunLength {
    std::size_t symbol;
    Code extra;
};

RunLength run_length(int length) {
    if (length == longest_run) return {285, {}};
    const auto offset = static_cast<std::uint32_t>(length - 3);
    if (offset < 8) return {257 + offset, {}};
    // Four symbols to each power of two.
    const int extra = std::bit_width(offset) - 3;
    const std::uint32_t step = (offset >> extra) - 4;
    return {257 + 4 + 4 * static_cast<std::size_t>(extra) + step,
            {offset & ((1U << extra) - 1), extra}};
}

/// Adds bits to a stream, lowest first.
class BitWriter {
  public:
    explicit BitWriter(std::string& out) : out_(out), end_(out.size()) {}

    /// Before `bits` further bits are put.
    void reserve(std::uint64_t bits) { out_.resize(end_ + bits / 8 + 2 * sizeof(buffer_)); }
    void put(const Code& code) { put(code.value, code.bits); }
    /// Up to 56 bits.
    void put(std::uint64_t value, int bits) {
        buffer_ |= value << held_;
        held_ += bits;
        std::memcpy(out_.data() + end_, &buffer_, sizeof(buffer_));
        end_ += static_cast<std::size_t>(held_ / 8);
        buffer_ >>= held_ & ~7;
        held_ &= 7;
    }
    /// The rest of the last byte is zero.
    void finish() { out_.resize(end_ + (held_ > 0 ? 1 : 0)); }

  private:
    std::string& out_;
    std::size_t end_;  ///< of the whole bytes
    std::uint64_t buffer_ = 0;
    int held_ = 0;
};

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

/// How many bytes from `at` on are those `back` before, up to `most`.
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

/// The tokens of a block, which begins at `begin`, and how often each occurs.
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

/// The code lengths of a block, each in the code of their own that RFC 1951, 3.2.7 gives them.
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

    std::array<Code, tokens_known> code_of;
    for (int byte = 0; byte < run_token; ++byte)
        code_of[byte] = {codes[byte], lengths[byte]};
    for (int length = shortest_run; length <= longest_run; ++length) {
        const RunLength run = run_length(length);
        const int bits = lengths[run.symbol];
        // One distance occurs, and its code is a zero bit.
        code_of[run_token + length] = {codes[run.symbol] | run.extra.value << bits,
                                       bits + run.extra.bits + 1};
    }
    std::uint64_t bits = std::uint64_t{longest_code} * (symbols_known + 64);
    for (std::size_t token = 0; token < tokens_known; ++token)
        bits +=
            std::uint64_t{block.counts[token]} * static_cast<std::uint64_t>(code_of[token].bits);
    writer.reserve(bits);

    writer.put({last ? 0b101U : 0b100U, 3});
    const Code end{codes[end_symbol], lengths[end_symbol]};
    lengths.resize(symbols_known + static_cast<std::size_t>(back), 0);
    lengths.back() = 1;
    put_lengths(writer, lengths, back);
    // In pairs, since every put waits for the one before it; a code has up to 21 bits.
    const std::vector<std::uint16_t>& tokens = block.tokens;
    for (std::size_t k = 0; k + 1 < tokens.size(); k += 2) {
        const Code& first = code_of[tokens[k]];
        const Code& second = code_of[tokens[k + 1]];
        writer.put(first.value | std::uint64_t{second.value} << first.bits,
                   first.bits + second.bits);
    }
    if (tokens.size() % 2 == 1) writer.put(code_of[tokens.back()]);
    writer.put(end);
}

/// Eight lanes added up.
std::uint32_t sum_of(__m256i lanes) {
    std::array<std::uint32_t, 8> values;
    std::memcpy(values.data(), &lanes, sizeof(lanes));
    std::uint32_t sum = 0;
    for (const std::uint32_t value : values)
        sum += value;
    return sum;
}

/// RFC 1950, 8.2: the sum of the bytes, from 1 on, and the sum of these sums, modulo 65521; 32
/// bytes at a time.
std::uint32_t adler_32(Bytes bytes) {
    constexpr std::uint32_t base = 65521;
    // So few blocks that no sum leaves 32 bits: 32 * (32 * 255) * (1 + ... + 159) is 3.3e9.
    constexpr std::size_t most_blocks = 160;
    const __m256i weights =
        _mm256_setr_epi8(32, 31, 30, 29, 28, 27, 26, 25, 24, 23, 22, 21, 20, 19, 18, 17, 16, 15, 14,
                         13, 12, 11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1);
    std::uint32_t sum = 1;
    std::uint32_t sums = 0;
    while (bytes.size() >= 32) {
        const std::size_t blocks = std::min(bytes.size() / 32, most_blocks);
        __m256i own = _mm256_setzero_si256();       // of all bytes so far
        __m256i before = _mm256_setzero_si256();    // of what `own` was before each block
        __m256i weighted = _mm256_setzero_si256();  // of bytes by how often they count in a block
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

}  // namespace

std::string zlib_bytes(Bytes bytes, int pixel_bytes, Packing packing) {
    std::string out("\x78\x01", 2);
    if (packing == Packing::stored || bytes.empty()) {
        out.reserve(bytes.size() + 5 * (bytes.size() / stored_bytes + 1) + 6);
        add_stored(out, bytes);
    } else {
        BitWriter writer(out);
        for (std::size_t begin = 0; begin < bytes.size(); begin += block_bytes) {
            const std::size_t end = std::min(begin + block_bytes, bytes.size());
            put_block(writer, tokens_of(bytes, begin, end, pixel_bytes), pixel_bytes,
                      end == bytes.size());
        }
        writer.finish();
    }
    const std::uint32_t sum = adler_32(bytes);
    for (int shift = 24; shift >= 0; shift -= 8)
        out += static_cast<char>(sum >> shift & 0xFF);
    return out;
}

}  // namespace sonarsim
