#include "format/png_reader.h"

#include <zlib.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "format/png_file.h"

namespace sonarsim {

namespace {

constexpr std::size_t piece_bytes = std::size_t{1} << 16;
/// More than any picture of sonarsim has: two rows are held at a time.
constexpr std::uint32_t largest_side = 1U << 20;
/// The most bytes that one byte of DEFLATE can give: 258 for two bits.
constexpr std::uint64_t most_inflated = 1032;

[[noreturn]] void refuse_png(const std::string& what) {
    throw std::runtime_error(what);
}

void read_exactly(std::istream& file, char* bytes, std::size_t count) {
    if (!file.read(bytes, static_cast<std::streamsize>(count))) refuse_png("ends too early");
}

std::uint32_t number_at(const char* bytes) {
    std::uint32_t value = 0;
    for (int k = 0; k < 4; ++k)
        value = value << 8 | static_cast<unsigned char>(bytes[k]);
    return value;
}

/// `file_bytes`: how long the file is.
PngShape shape_of(const std::string& header, std::uint64_t file_bytes) {
    if (header.size() != 13) refuse_png("has a header of another length");
    const std::uint32_t width = number_at(header.data());
    const std::uint32_t height = number_at(header.data() + 4);
    const int bits = header[8];
    const int colours = header[9];
    const bool grey_or_rgb = (colours == 0 || colours == 2) && (bits == 8 || bits == 16);
    const bool known = grey_or_rgb || (colours == 3 && bits == 8);
    if (!known || header[12] != 0) refuse_png("has pixels of a kind that sonarsim does not write");
    if (width == 0 || height == 0 || width > largest_side || height > largest_side)
        refuse_png("has no pixels, or too many");
    const PngShape shape{static_cast<int>(width), static_cast<int>(height), bits,
                         colours == 2 ? 3 : 1};
    // Memory is allocated before unpacking, so refuse more than the file can unpack to.
    const std::uint64_t row = 1 + std::uint64_t{width} * bits * shape.channels / 8;
    if (row * height / most_inflated > file_bytes) refuse_png("has more pixels than it can hold");
    return shape;
}

/// Returns the nearest of left, up and upper left to left + up - upper left.
std::uint8_t paeth(int left, int up, int upper_left) {
    const int from_left = std::abs(up - upper_left);
    const int from_up = std::abs(left - upper_left);
    const int from_both = std::abs(left + up - 2 * upper_left);
    if (from_left <= from_up && from_left <= from_both) return static_cast<std::uint8_t>(left);
    return static_cast<std::uint8_t>(from_up <= from_both ? up : upper_left);
}

/// Turns a filtered row into its bytes. `above` is the row before, zeros for the first row.
void undo_filter(int filter, std::size_t pixel_bytes, const std::vector<std::uint8_t>& above,
                 std::span<std::uint8_t> row) {
    if (filter < 0 || filter > 4) refuse_png("has an unknown filter");
    for (std::size_t k = 0; k < row.size(); ++k) {
        const int left = k < pixel_bytes ? 0 : row[k - pixel_bytes];
        const int up = above[k];
        const int upper_left = k < pixel_bytes ? 0 : above[k - pixel_bytes];
        const int guesses[] = {0, left, up, (left + up) / 2, paeth(left, up, upper_left)};
        row[k] = static_cast<std::uint8_t>(row[k] + guesses[filter]);
    }
}

struct EndInflate {
    void operator()(z_stream* stream) const {
        ::inflateEnd(stream);
        delete stream;
    }
};

/// Unpacks the pixels row by row.
class RowUnpacker {
  public:
    explicit RowUnpacker(const PngShape& shape)
        : shape_(shape),
          stream_(new z_stream{}),
          above_(row_bytes()),
          packed_row_(row_bytes() + 1) {
        if (::inflateInit(stream_.get()) != Z_OK) throw std::bad_alloc();
        start_row();
    }

    template <class Visit>
    void add(std::span<char> packed, const Visit& visit) {
        stream_->next_in = reinterpret_cast<Bytef*>(packed.data());
        stream_->avail_in = static_cast<uInt>(packed.size());
        if (ended_ && !packed.empty()) refuse_png("has bytes behind its pixels");
        while (!ended_) {
            // Only the end of the stream may follow the last row.
            std::uint8_t beyond = 0;
            const bool all_rows = rows_ == shape_.height;
            if (all_rows) {
                stream_->next_out = &beyond;
                stream_->avail_out = 1;
            }
            const int state = ::inflate(stream_.get(), Z_NO_FLUSH);
            if (state != Z_OK && state != Z_STREAM_END && state != Z_BUF_ERROR)
                refuse_png("cannot be unpacked");
            ended_ = state == Z_STREAM_END;
            const bool full = stream_->avail_out == 0;
            if (full && all_rows) refuse_png("has more rows than it says");
            if (full) end_row(visit);
            // The stream may hold more than one row.
            if (!full && stream_->avail_in == 0) break;
        }
        if (stream_->avail_in > 0) refuse_png("has bytes behind its pixels");
    }

    void finish() const {
        if (!ended_ || rows_ != shape_.height) refuse_png("has fewer rows than it says");
    }

  private:
    std::size_t pixel_bytes() const {
        return static_cast<std::size_t>(shape_.channels) * shape_.bits / 8;
    }
    std::size_t row_bytes() const { return shape_.width * pixel_bytes(); }
    template <class Visit>
    void end_row(const Visit& visit) {
        const std::span row = std::span(packed_row_).subspan(1);
        undo_filter(packed_row_[0], pixel_bytes(), above_, row);
        std::ranges::copy(row, above_.begin());
        visit(shape_, std::span<const std::uint8_t>(above_));
        ++rows_;
        start_row();
    }
    void start_row() {
        stream_->next_out = packed_row_.data();
        stream_->avail_out = static_cast<uInt>(packed_row_.size());
    }

    PngShape shape_;
    std::unique_ptr<z_stream, EndInflate> stream_;
    std::vector<std::uint8_t> above_;
    std::vector<std::uint8_t> packed_row_;  ///< its filter, then its bytes
    int rows_ = 0;
    bool ended_ = false;
};

/// Calls `visit` with the data of a chunk, piece by piece, and checks their sum.
template <class Visit>
void read_chunk(std::istream& file, std::string_view kind, std::uint32_t length,
                const Visit& visit) {
    uLong sum = ::crc32_z(0, reinterpret_cast<const Bytef*>(kind.data()), kind.size());
    std::string piece;
    for (std::uint32_t left = length; left > 0;) {
        piece.resize(std::min<std::size_t>(left, piece_bytes));
        read_exactly(file, piece.data(), piece.size());
        sum = ::crc32_z(sum, reinterpret_cast<const Bytef*>(piece.data()), piece.size());
        left -= static_cast<std::uint32_t>(piece.size());
        visit(piece);
    }
    char expected[4];
    read_exactly(file, expected, sizeof expected);
    if (number_at(expected) != sum) refuse_png("has a wrong check sum");
}

}  // namespace

PngShape read_png(std::istream& file, std::uint64_t file_bytes,
                  const std::function<void(const PngShape&, std::span<const std::uint8_t>)>& row) {
    char start[8];
    read_exactly(file, start, sizeof start);
    if (std::string_view(start, sizeof start) != png_signature) refuse_png("is no png file");
    PngShape shape;
    std::unique_ptr<RowUnpacker> pixels;
    for (std::string kind; kind != "IEND";) {
        read_exactly(file, start, sizeof start);
        kind.assign(start + 4, 4);
        const bool is_header = kind == "IHDR";
        if (is_header == (shape.width > 0)) refuse_png("begins with no header");
        std::string header;
        read_chunk(file, kind, number_at(start), [&](std::string& piece) {
            if (is_header) header += piece;
            if (kind == "IDAT") pixels->add(piece, row);
        });
        if (!is_header) continue;
        shape = shape_of(header, file_bytes);
        pixels = std::make_unique<RowUnpacker>(shape);
    }
    pixels->finish();
    return shape;
}

}  // namespace sonarsim
