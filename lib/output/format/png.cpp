#include "output/format/png.h"

#include <libdeflate.h>

#include <algorithm>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace sonarsim {

namespace {

/// Bytes of a block. Each block has a Huffman code of its own, which fits a longer block less well.
constexpr std::size_t block_bytes = std::size_t{1} << 17;

/// Appends a number with the highest byte first.
void append_number(std::string& out, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8)
        out += static_cast<char>(value >> shift & 0xFF);
}

/// Appends a chunk: the length of its data, its kind of four letters, the data and their CRC.
void append_chunk(std::string& out, std::string_view kind, std::string_view data) {
    append_number(out, static_cast<std::uint32_t>(data.size()));
    const std::size_t begin = out.size();
    out.append(kind).append(data);
    append_number(out, libdeflate_crc32(0, out.data() + begin, out.size() - begin));
}

template <class Pixel>
std::string encode(std::span<const Pixel> pixels, int width, int height, PngFilter filter) {
    const auto columns = static_cast<std::size_t>(width);
    if (pixels.size() != columns * static_cast<std::size_t>(height))
        throw std::logic_error("the number of pixels does not suit the size of the image");
    PngEncoder encoder(width, height, PixelKind{sizeof(Pixel)}, filter);
    for (std::size_t at = 0; at < pixels.size(); at += columns)
        encoder.row(pixels.subspan(at, columns));
    return encoder.take(true);
}

}  // namespace

PngEncoder::PngEncoder(int width, int height, PixelKind kind, PngFilter filter)
    : pixel_bytes_(static_cast<std::size_t>(kind)),
      filter_(filter),
      file_("\x89PNG\r\n\x1a\n"),
      line_(static_cast<std::size_t>(width) * pixel_bytes_),
      above_(line_.size()),
      // An id has few high bytes, so single bytes repeat more often than pixels.
      packer_(filter == PngFilter::up ? 1 : static_cast<int>(pixel_bytes_)) {
    std::string header;
    append_number(header, static_cast<std::uint32_t>(width));
    append_number(header, static_cast<std::uint32_t>(height));
    header += static_cast<char>(kind == PixelKind::grey16 ? 16 : 8);
    header += kind == PixelKind::rgb8 ? '\2' : '\0';  // type of the colour
    header.append(3, '\0');
    append_chunk(file_, "IHDR", header);
    rows_.reserve(block_bytes);
}

void PngEncoder::add(std::span<const std::uint8_t> bytes) {
    const std::size_t size = line_.size();
    if (bytes.size() != size) throw std::logic_error("a row does not suit the width of its image");
    // A block is packed when more bytes follow, since take() marks the last block.
    if (rows_.size() + size >= block_bytes && !rows_.empty()) pack(false);
    line_.swap(above_);
    std::ranges::copy(bytes, line_.begin());
    for (std::size_t k = 0; pixel_bytes_ == 2 && k < size; k += 2)
        std::swap(line_[k], line_[k + 1]);
    rows_.push_back(static_cast<std::uint8_t>(filter_));
    rows_.insert(rows_.end(), line_.begin(), line_.end());
    std::uint8_t* const to = rows_.data() + rows_.size() - size;
    if (filter_ == PngFilter::left) {
        for (std::size_t k = pixel_bytes_; k < size; ++k)
            to[k] = static_cast<std::uint8_t>(line_[k] - line_[k - pixel_bytes_]);
    } else if (filter_ == PngFilter::up) {
        for (std::size_t k = 0; k < size; ++k)
            to[k] = static_cast<std::uint8_t>(line_[k] - above_[k]);
    }
}

void PngEncoder::pack(bool last) {
    append_chunk(file_, "IDAT", packer_.pack(rows_, last));
    rows_.clear();
}

std::string PngEncoder::take(bool last) {
    if (last) {
        pack(true);
        append_chunk(file_, "IEND", {});
    }
    return std::exchange(file_, {});
}

std::string png_bytes(std::span<const std::uint8_t> pixels, int width, int height) {
    return encode(pixels, width, height, PngFilter::left);
}

std::string png_bytes(std::span<const std::uint16_t> pixels, int width, int height,
                      PngFilter filter) {
    return encode(pixels, width, height, filter);
}

void write_picture(const std::filesystem::path& path, std::span<const Rgb> pixels, int width) {
    const int height = static_cast<int>(pixels.size()) / width;
    write_file(path, encode(pixels, width, height, PngFilter::left));
}

}  // namespace sonarsim
