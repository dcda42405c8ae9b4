#include "dataset/image_file.h"

#include <stdexcept>

namespace sonarsim {

namespace {

static_assert(sizeof(Rgb) == 3, "a row of colours is a row of pixels");

}  // namespace

ImageFile::ImageFile(const std::filesystem::path& path, int width, int height, PixelKind kind)
    : whole_(path), disk_(whole_.part()), width_(width) {
    type_ = kind == PixelKind::rgb8 ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::UINT16;
    OIIO::ImageSpec spec(width, height, kind == PixelKind::rgb8 ? 3 : 1, type_);
    // The fastest that pack at all, by the figures in png.cpp.
    spec.attribute("compression", "rle");
    spec.attribute("png:compressionLevel", 1);
    spec.attribute("png:filter", kind == PixelKind::rgb8 ? 0x10 : 0x08);
    out_ = OIIO::ImageOutput::create("png");
    if (!out_) throw std::runtime_error("cannot write " + path.string() + ": " + OIIO::geterror());
    require(out_->set_ioproxy(&disk_) && out_->open(whole_.part().string(), spec));
}

void ImageFile::require(bool done) {
    if (done) return;
    const std::string reason = out_->geterror();
    out_.reset();
    disk_.finish();  // The disk's reason, if that is what the encoder stumbled over.
    throw std::runtime_error("cannot write " + whole_.part().string() + ": " + reason);
}

void ImageFile::put(const void* pixels, std::size_t count) {
    if (count != static_cast<std::size_t>(width_)) {
        throw std::logic_error("a row does not suit the width of its image");
    }
    require(out_->write_scanline(next_++, 0, type_, pixels));
}

void ImageFile::finish() {
    require(out_->close());
    disk_.finish();
    whole_.keep();
}

void write_picture(const std::filesystem::path& path, Picture picture) {
    ImageFile file(path, picture.width, picture.height, PixelKind::rgb8);
    for (int y = 0; y < picture.height; ++y)
        file.row(std::span<const Rgb>(picture.row(y), picture.width));
    file.finish();
}

}  // namespace sonarsim
