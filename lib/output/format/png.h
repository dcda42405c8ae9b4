#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/file.h"
#include "core/rgb.h"

namespace sonarsim {

/// The kind of a pixel; the value is its number of bytes.
enum class PixelKind : std::uint8_t { grey8 = 1, grey16 = 2, rgb8 = 3 };

/// The bytes of a row: as they are, or their differences from the pixel to the left (noise,
/// colours) or above (areas of one value, such as ids).
enum class PngFilter : std::uint8_t { none = 0, left = 1, up = 2 };

/// Packs the bytes of an image as a zlib stream (RFC 1950 and 1951). Only runs of one pixel are
/// looked for: noise repeats nothing else, and general packers search for it most of their time.
class ZlibPacker {
  public:
    /// `pixel_bytes`, 1 to 4, is the distance at which repeated bytes are looked for.
    explicit ZlibPacker(int pixel_bytes) : pixel_bytes_(pixel_bytes) {}

    /// The stream of the next bytes, at least one, as a block with a Huffman code of its own.
    std::string pack(std::span<const std::uint8_t> bytes, bool last);

  private:
    int pixel_bytes_;
    /// Bits that are not written yet, and their number: at first the header of the stream, deflate
    /// with a window of 32 KiB, packed fast (RFC 1950, 2.2).
    std::uint64_t buffer_ = 0x0178;
    unsigned held_ = 16;
    std::uint32_t adler_ = 1;
};

/// Makes a PNG file (www.w3.org/TR/png) of rows one by one. Its bytes depend on the pixels alone.
class PngEncoder {
  public:
    PngEncoder(int width, int height, PixelKind kind, PngFilter filter);

    /// Adds a row of std::uint8_t, std::uint16_t or Rgb. std::logic_error if its length is wrong.
    template <class Pixel>
    void row(std::span<const Pixel> pixels) {
        add({reinterpret_cast<const std::uint8_t*>(pixels.data()), pixels.size_bytes()});
    }
    /// The chunks that were not taken before; after the `last` row, the rest of the file.
    std::string take(bool last);

  private:
    void add(std::span<const std::uint8_t> bytes);
    void pack(bool last);

    std::size_t pixel_bytes_;
    PngFilter filter_;
    std::string file_;                        ///< chunks that were not taken yet
    std::vector<std::uint8_t> rows_;          ///< filtered rows that were not packed yet
    std::vector<std::uint8_t> line_, above_;  ///< a row, highest byte first, and the one before
    ZlibPacker packer_;
};

/// Writes a PNG file row by row: it may be longer than memory. std::system_error by the disk.
class ImageFile {
  public:
    ImageFile(const std::filesystem::path& path, int width, int height, PixelKind kind)
        : file_(path),
          encoder_(width, height, kind,
                   kind == PixelKind::rgb8 ? PngFilter::left : PngFilter::none) {}

    template <class Row>
    void row(const Row& pixels) {
        encoder_.row(std::span(pixels));
        file_.append(encoder_.take(false));
    }
    /// To be called after the last row.
    void finish() {
        file_.append(encoder_.take(true));
        file_.finish();
    }

  private:
    StreamedFile file_;
    PngEncoder encoder_;
};

/// A PNG file in memory of [height, width] grey values. std::logic_error if the size is another.
std::string png_bytes(std::span<const std::uint8_t> pixels, int width, int height);
std::string png_bytes(std::span<const std::uint16_t> pixels, int width, int height,
                      PngFilter filter = PngFilter::none);

/// Writes a whole picture of `width` pixels a row as a PNG file.
void write_picture(const std::filesystem::path& path, std::span<const Rgb> pixels, int width);

/// Names the way in which pixels are packed. Another way stores the same pixels in other bytes.
inline constexpr const char* png_encoder = "sonarsim 3";

}  // namespace sonarsim
