#include "format/image_file.h"

#include <zlib.h>

#include <cstring>
#include <new>
#include <stdexcept>

#include "format/png_chunks.h"

namespace sonarsim {

namespace {

static_assert(sizeof(Rgb) == 3, "a row of colours is a row of bytes");

// Filters of a row: as it is, and how each byte differs from the pixel to the left.
constexpr std::uint8_t as_it_is = 0;
constexpr std::uint8_t from_the_left = 1;

constexpr std::size_t chunk_bytes = std::size_t{1} << 16;

std::string chunk(std::string_view kind, std::string_view data) {
    std::string bytes;
    append_png_chunk(bytes, kind, data);
    return bytes;
}

}  // namespace

void ImageFile::EndStream::operator()(z_stream_s* stream) const {
    ::deflateEnd(stream);
    delete stream;
}

ImageFile::ImageFile(const std::filesystem::path& path, int width, int height, PixelKind kind)
    : file_(path),
      width_(static_cast<std::size_t>(width)),
      stream_(new z_stream_s{}),
      packed_(chunk_bytes, '\0') {
    // Looking for runs alone is the fastest that packs at all, by the figures in png.cpp.
    constexpr int level = 1;
    constexpr int window_bits = 15;
    constexpr int memory = 8;
    if (::deflateInit2(stream_.get(), level, Z_DEFLATED, window_bits, memory, Z_RLE) != Z_OK)
        throw std::bad_alloc();
    stream_->next_out = reinterpret_cast<Bytef*>(packed_.data());
    stream_->avail_out = static_cast<uInt>(packed_.size());
    const bool colour = kind == PixelKind::rgb8;
    file_.append(png_signature);
    const int bits = kind == PixelKind::grey16 ? 16 : 8;
    file_.append(chunk("IHDR", png_header(width, height, bits, colour ? 2 : 0)));
}

void ImageFile::check_width(std::size_t pixels) const {
    if (pixels != width_) throw std::logic_error("a row does not suit the width of its image");
}

void ImageFile::row(std::span<const std::uint8_t> pixels) {
    check_width(pixels.size());
    row_.assign(1, as_it_is);
    row_.insert(row_.end(), pixels.begin(), pixels.end());
    pack(false);
}

void ImageFile::row(std::span<const std::uint16_t> pixels) {
    check_width(pixels.size());
    row_.assign(1, as_it_is);
    for (const std::uint16_t pixel : pixels) {
        row_.push_back(static_cast<std::uint8_t>(pixel >> 8));
        row_.push_back(static_cast<std::uint8_t>(pixel));
    }
    pack(false);
}

void ImageFile::row(std::span<const Rgb> pixels) {
    check_width(pixels.size());
    row_.resize(1 + pixels.size_bytes());
    row_[0] = from_the_left;
    std::memcpy(row_.data() + 1, pixels.data(), pixels.size_bytes());
    for (std::size_t k = row_.size() - 1; k > sizeof(Rgb); --k)
        row_[k] = static_cast<std::uint8_t>(row_[k] - row_[k - sizeof(Rgb)]);
    pack(false);
}

void ImageFile::pack(bool last) {
    stream_->next_in = row_.data();
    stream_->avail_in = static_cast<uInt>(row_.size());
    for (bool done = false; !done;) {
        const int state = ::deflate(stream_.get(), last ? Z_FINISH : Z_NO_FLUSH);
        done = last ? state == Z_STREAM_END : stream_->avail_in == 0 && stream_->avail_out > 0;
        if (stream_->avail_out > 0 && !(last && done)) continue;
        file_.append(chunk(
            "IDAT", std::string_view(packed_).substr(0, packed_.size() - stream_->avail_out)));
        stream_->next_out = reinterpret_cast<Bytef*>(packed_.data());
        stream_->avail_out = static_cast<uInt>(packed_.size());
    }
}

void ImageFile::finish() {
    row_.clear();
    pack(true);
    file_.append(chunk("IEND", {}));
    file_.finish();
}

void write_picture(const std::filesystem::path& path, Picture picture) {
    ImageFile file(path, picture.width, picture.height, PixelKind::rgb8);
    for (int y = 0; y < picture.height; ++y)
        file.row(std::span<const Rgb>(picture.row(y), picture.width));
    file.finish();
}

}  // namespace sonarsim
