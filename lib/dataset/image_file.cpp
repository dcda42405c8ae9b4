#include "dataset/image_file.h"

#include <stdexcept>

namespace sonarsim {

namespace {

static_assert(sizeof(Rgb) == 3, "a row of colours is a row of pixels");

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
    throw std::runtime_error("cannot write " + path.string() + ": " + reason);
}

}  // namespace

ImageFile::ImageFile(const std::filesystem::path& path, int width, int height, PixelKind kind)
    : whole_(path), width_(width) {
    type_ = kind == PixelKind::rgb8     ? OIIO::TypeDesc::UINT8
            : kind == PixelKind::grey16 ? OIIO::TypeDesc::UINT16
                                        : OIIO::TypeDesc::FLOAT;
    OIIO::ImageSpec spec(width, height, kind == PixelKind::rgb8 ? 3 : 1, type_);
    if (kind == PixelKind::float32) {
        spec.attribute("compression", "none");
        spec.attribute("DateTime", "");
        spec.attribute("Software", "sonarsim");
    } else {
        // The fastest that pack at all, by the figures in png.cpp.
        spec.attribute("compression", "rle");
        spec.attribute("png:compressionLevel", 1);
        spec.attribute("png:filter", kind == PixelKind::rgb8 ? 0x10 : 0x08);
    }
    out_ = OIIO::ImageOutput::create(kind == PixelKind::float32 ? "tiff" : "png");
    if (!out_) fail(path, OIIO::geterror());
    if (!out_->open(whole_.part().string(), spec)) fail(path, out_->geterror());
}

void ImageFile::put(const void* pixels, std::size_t count) {
    if (count != static_cast<std::size_t>(width_)) {
        throw std::logic_error("a row does not suit the width of its image");
    }
    if (!out_->write_scanline(next_++, 0, type_, pixels)) {
        fail(whole_.part(), out_->geterror());
    }
}

void ImageFile::finish() {
    if (!out_->close()) fail(whole_.part(), out_->geterror());
    whole_.keep();
}

void write_picture(const std::filesystem::path& path, Picture picture) {
    ImageFile file(path, picture.width, picture.height, PixelKind::rgb8);
    for (int y = 0; y < picture.height; ++y)
        file.row(std::span<const Rgb>(picture.row(y), picture.width));
    file.finish();
}

}  // namespace sonarsim
