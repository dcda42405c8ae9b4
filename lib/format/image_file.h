#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/atomic_file.h"
#include "product/picture.h"

struct z_stream_s;  // zlib's

namespace sonarsim {

enum class PixelKind {
    grey8,
    grey16,
    rgb8,
};

/// A PNG image that is written row by row and so may be longer than memory. The bytes depend on the
/// pixels and the version of zlib alone: nothing is stamped. std::system_error when the disk does
/// not take it.
class ImageFile {
  public:
    ImageFile(const std::filesystem::path& path, int width, int height, PixelKind kind);

    // The next row; its type is that of the image.
    void row(std::span<const std::uint8_t> pixels);
    void row(std::span<const std::uint16_t> pixels);
    void row(std::span<const Rgb> pixels);
    /// After the last row.
    void finish();

  private:
    struct EndStream {
        void operator()(z_stream_s* stream) const;
    };

    void check_width(std::size_t pixels) const;
    /// Packs what stands in row_, with its filter in front.
    void pack(bool last);

    StreamedFile file_;
    std::size_t width_;
    std::unique_ptr<z_stream_s, EndStream> stream_;
    std::vector<std::uint8_t> row_;
    std::string packed_;  ///< room for a chunk
};

/// A whole picture as a PNG file.
void write_picture(const std::filesystem::path& path, Picture picture);

}  // namespace sonarsim
