#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "core/atomic_file.h"
#include "core/rgb.h"
#include "format/deflate.h"

namespace sonarsim {

enum class PixelKind {
    grey8,
    grey16,
    rgb8,
};

/// Writes a PNG image row by row, so that it may be longer than memory. The bytes depend on the
/// pixels alone. Throws std::system_error when the disk does not take it.
class ImageFile {
  public:
    ImageFile(const std::filesystem::path& path, int width, int height, PixelKind kind);

    // Writes the next row. Its type must be that of the image.
    void row(std::span<const std::uint8_t> pixels);
    void row(std::span<const std::uint16_t> pixels);
    void row(std::span<const Rgb> pixels);
    /// To be called after the last row.
    void finish();

  private:
    void check_width(std::size_t pixels) const;
    void write_packed();

    StreamedFile file_;
    std::size_t width_;
    ZlibStream stream_;
    std::vector<std::uint8_t> row_;  ///< its filter, then its bytes
};

/// Writes a whole picture of `width` pixels a row as a PNG file.
void write_picture(const std::filesystem::path& path, std::span<const Rgb> pixels, int width);

}  // namespace sonarsim
