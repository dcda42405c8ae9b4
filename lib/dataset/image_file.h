#pragma once

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "dataset/proxy_file.h"
#include "dataset/whole_file.h"
#include "product/picture.h"

namespace sonarsim {

enum class PixelKind {
    grey16,
    rgb8,
};

/// A PNG image that is written row by row and so may be longer than memory. The bytes depend on the
/// pixels alone: nothing is stamped. std::runtime_error when the encoder or the disk fails.
class ImageFile {
  public:
    ImageFile(const std::filesystem::path& path, int width, int height, PixelKind kind);

    // The next row; its type is that of the image.
    void row(std::span<const std::uint16_t> pixels) { put(pixels.data(), pixels.size()); }
    void row(std::span<const Rgb> pixels) { put(pixels.data(), pixels.size()); }
    /// After the last row.
    void finish();

  private:
    void put(const void* pixels, std::size_t count);
    void require(bool done);

    WholeFile whole_;
    ProxyFile disk_;
    int width_;
    OIIO::TypeDesc type_;
    std::unique_ptr<OIIO::ImageOutput> out_;
    int next_ = 0;
};

/// A whole picture as a PNG file.
void write_picture(const std::filesystem::path& path, Picture picture);

}  // namespace sonarsim
