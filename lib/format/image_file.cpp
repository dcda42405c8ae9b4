#include "format/image_file.h"

#include <cstring>
#include <stdexcept>
#include <string>

#include "format/png_file.h"

namespace sonarsim {

namespace {

std::string png_chunk(std::string_view kind, std::string_view data) {
    std::string bytes;
    append_png_chunk(bytes, kind, data);
    return bytes;
}

int pixel_bytes(PixelKind kind) {
    if (kind == PixelKind::rgb8) return sizeof(Rgb);
    return kind == PixelKind::grey16 ? 2 : 1;
}

}  // namespace

ImageFile::ImageFile(const std::filesystem::path& path, int width, int height, PixelKind kind)
    : file_(path), width_(static_cast<std::size_t>(width)), stream_(pixel_bytes(kind)) {
    const int bits = kind == PixelKind::grey16 ? 16 : 8;
    file_.append(png_start(
        {width, height, bits, kind == PixelKind::rgb8 ? PngColours::rgb : PngColours::grey}));
}

void ImageFile::check_width(std::size_t pixels) const {
    if (pixels != width_) throw std::logic_error("a row does not suit the width of its image");
}

void ImageFile::row(std::span<const std::uint8_t> pixels) {
    check_width(pixels.size());
    row_.assign(1, png_filter_none);
    row_.insert(row_.end(), pixels.begin(), pixels.end());
    stream_.add(row_);
    write_packed();
}

void ImageFile::row(std::span<const std::uint16_t> pixels) {
    check_width(pixels.size());
    row_.assign(1, png_filter_none);
    for (const std::uint16_t pixel : pixels) {
        row_.push_back(static_cast<std::uint8_t>(pixel >> 8));
        row_.push_back(static_cast<std::uint8_t>(pixel));
    }
    stream_.add(row_);
    write_packed();
}

void ImageFile::row(std::span<const Rgb> pixels) {
    check_width(pixels.size());
    row_.resize(1 + pixels.size_bytes());
    row_[0] = png_filter_left;
    std::memcpy(row_.data() + 1, pixels.data(), pixels.size_bytes());
    for (std::size_t k = row_.size() - 1; k > sizeof(Rgb); --k)
        row_[k] = static_cast<std::uint8_t>(row_[k] - row_[k - sizeof(Rgb)]);
    stream_.add(row_);
    write_packed();
}

void ImageFile::write_packed() {
    const std::string packed = stream_.take();
    if (!packed.empty()) file_.append(png_chunk("IDAT", packed));
}

void ImageFile::finish() {
    stream_.finish();
    write_packed();
    file_.append(png_chunk("IEND", {}));
    file_.finish();
}

void write_picture(const std::filesystem::path& path, std::span<const Rgb> pixels, int width) {
    const auto columns = static_cast<std::size_t>(width);
    ImageFile file(path, width, static_cast<int>(pixels.size() / columns), PixelKind::rgb8);
    for (std::size_t at = 0; at < pixels.size(); at += columns)
        file.row(pixels.subspan(at, columns));
    file.finish();
}

}  // namespace sonarsim
