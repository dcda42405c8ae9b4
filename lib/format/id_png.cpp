#include "format/id_png.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <stdexcept>
#include <utility>
#include <vector>

#include "format/png_file.h"

// Deflate: RFC 1951, here one block with the fixed codes of its 3.2.6. The stream around it and
// Adler-32: RFC 1950.

namespace sonarsim {

namespace {

constexpr std::uint8_t filter_up = 2;

/// A code of the fixed table: its bits in the order in which they are written.
struct BitCode {
    std::uint32_t bits = 0;
    int length = 0;
};

constexpr BitCode reversed(std::uint32_t code, int length) {
    std::uint32_t bits = 0;
    for (int k = 0; k < length; ++k)
        bits |= (code >> k & 1U) << (length - 1 - k);
    return {bits, length};
}

/// Of literals 0 to 255, the end of a block (256) and lengths (257 to 285).
constexpr BitCode symbol_code(int symbol) {
    if (symbol < 144) return reversed(0x30 + symbol, 8);
    if (symbol < 256) return reversed(0x190 + symbol - 144, 9);
    if (symbol < 280) return reversed(symbol - 256, 7);
    return reversed(0xC0 + symbol - 280, 8);
}

constexpr auto make_literals() {
    std::array<BitCode, 256> codes{};
    for (int k = 0; k < 256; ++k)
        codes[k] = symbol_code(k);
    return codes;
}

constexpr int longest_repeat = 258;

/// Of "the last byte, n times again", 3 <= n <= 258: length, extra bits, distance 1.
constexpr auto make_repeats() {
    std::array<BitCode, longest_repeat + 1> codes{};
    int length = 3;
    for (int symbol = 257; symbol < 285; ++symbol) {
        const int extra = symbol < 265 ? 0 : (symbol - 261) / 4;
        const BitCode code = symbol_code(symbol);
        for (std::uint32_t k = 0; k < 1U << extra && length < longest_repeat; ++k, ++length)
            codes[length] = {code.bits | k << code.length, code.length + extra + 5};
    }
    const BitCode code = symbol_code(285);
    codes[longest_repeat] = {code.bits, code.length + 5};
    return codes;
}

constexpr auto literals = make_literals();
constexpr auto repeats = make_repeats();

/// Deflates bytes that are mostly 0, and sums them.
class ZeroRunDeflater {
  public:
    explicit ZeroRunDeflater(std::size_t bytes_at_most) : out_(bytes_at_most, '\0') {
        put({0x78, 8});
        put({0x01, 8});
        put({0b011, 3});  // the last block, fixed codes
    }

    void add(std::uint8_t byte) {
        put(literals[byte]);
        sum_ += byte;
        sum_of_sums_ += sum_;
        if (++unreduced_ == most_unreduced) reduce();
    }

    void add_zeros(std::size_t count) {
        reduce();
        sum_of_sums_ = (sum_of_sums_ + count % base * sum_) % base;
        put(literals[0]);
        for (--count; count >= 3;) {
            const std::size_t n = std::min<std::size_t>(count, longest_repeat);
            put(repeats[n]);
            count -= n;
        }
        for (; count > 0; --count)
            put(literals[0]);
    }

    /// The whole zlib stream.
    std::string finish() {
        put(symbol_code(256));
        put({0, (8 - held_ % 8) % 8});
        reduce();
        const auto adler = static_cast<std::uint32_t>(sum_of_sums_ << 16 | sum_);
        for (int shift = 24; shift >= 0; shift -= 8)
            put({adler >> shift & 0xFF, 8});
        flush();
        out_.resize(size_);
        return std::move(out_);
    }

  private:
    static constexpr std::uint64_t base = 65521;
    static constexpr int most_unreduced = 5000;

    void put(BitCode code) {
        bits_ |= static_cast<std::uint64_t>(code.bits) << held_;
        held_ += code.length;
        if (held_ >= 32) flush();
    }

    /// Writes the whole bytes that are held.
    void flush() {
        static_assert(std::endian::native == std::endian::little);
        if (size_ + sizeof bits_ > out_.size()) out_.resize(size_ + size_ / 2 + 64);
        std::memcpy(out_.data() + size_, &bits_, sizeof bits_);
        size_ += held_ / 8;
        bits_ >>= held_ / 8 * 8;
        held_ %= 8;
    }

    void reduce() {
        sum_ %= base;
        sum_of_sums_ %= base;
        unreduced_ = 0;
    }

    std::string out_;
    std::size_t size_ = 0;
    std::uint64_t bits_ = 0;
    int held_ = 0;
    std::uint64_t sum_ = 1;  ///< the two halves of Adler-32
    std::uint64_t sum_of_sums_ = 0;
    int unreduced_ = 0;
};

/// Bytes, the runs of zeros in them as such.
void deflate_row(ZeroRunDeflater& out, const std::vector<std::uint8_t>& row) {
    const std::size_t n = row.size();
    for (std::size_t k = 0; k < n;) {
        std::size_t end = k;
        std::uint64_t eight = 0;
        while (end + 8 <= n && (std::memcpy(&eight, &row[end], 8), eight == 0))
            end += 8;
        while (end < n && row[end] == 0)
            ++end;
        if (end > k) out.add_zeros(end - k);
        for (k = end; k < n && row[k] != 0; ++k)
            out.add(row[k]);
    }
}

/// [height, width] pixels as the zlib stream of a PNG: `write` puts a pixel into a row, big endian.
template <class Pixel, class Write>
std::string deflate_pixels(std::span<const Pixel> pixels, int width, int height, Write write) {
    const auto columns = static_cast<std::size_t>(width);
    if (pixels.size() != columns * height) {
        throw std::logic_error("the number of pixels does not suit the size of the image");
    }
    ZeroRunDeflater out(64 + pixels.size() / 16);
    std::vector<std::uint8_t> above(columns * sizeof(Pixel), 0);
    std::vector<std::uint8_t> own(above.size());
    std::vector<std::uint8_t> difference(above.size());
    for (int i = 0; i < height; ++i) {
        write(pixels.data() + static_cast<std::size_t>(i) * columns, columns, own.data());
        for (std::size_t k = 0; k < own.size(); ++k)
            difference[k] = static_cast<std::uint8_t>(own[k] - above[k]);
        out.add(filter_up);
        deflate_row(out, difference);
        std::swap(own, above);
    }
    return out.finish();
}

}  // namespace

std::string id_png_bytes(std::span<const std::uint16_t> ids, int width, int height) {
    const auto big_endian = [](const std::uint16_t* from, std::size_t count, std::uint8_t* to) {
        for (std::size_t k = 0; k < count; ++k) {
            const auto swapped = static_cast<std::uint16_t>(from[k] << 8 | from[k] >> 8);
            std::memcpy(to + 2 * k, &swapped, 2);
        }
    };
    return png_file({width, height, 16, PngColours::grey},
                    deflate_pixels(ids, width, height, big_endian));
}

std::string palette_png_bytes(std::span<const std::uint8_t> indices, int width, int height,
                              std::span<const Colour> table) {
    std::string colours;
    for (const Colour& colour : table)
        colours.append(reinterpret_cast<const char*>(colour.data()), colour.size());
    const auto copy = [](const std::uint8_t* from, std::size_t count, std::uint8_t* to) {
        std::memcpy(to, from, count);
    };
    return png_file({width, height, 8, PngColours::table},
                    deflate_pixels(indices, width, height, copy), colours);
}

double id_png_bytes_at_most(int width, int height, int bytes_per_pixel) {
    // A byte that does not repeat takes up to nine bits; a header, a table and the sums.
    const double raw =
        static_cast<double>(height) * (1.0 + static_cast<double>(width) * bytes_per_pixel);
    return 1000.0 + 1.125 * raw;
}

Colour colour_of(std::uint32_t id) {
    Colour colour{};
    for (int bit = 7; bit >= 0; --bit, id >>= 3) {
        for (std::size_t c = 0; c < 3; ++c)
            colour[c] = static_cast<std::uint8_t>(colour[c] | (id >> c & 1U) << bit);
    }
    return colour;
}

}  // namespace sonarsim
