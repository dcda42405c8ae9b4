#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace sonarsim {

/// Packs the bytes of an image as a zlib stream (RFC 1950 and 1951). Only runs of one pixel are
/// looked for: images of noise repeat nothing else, and the search for other repetitions takes most
/// of the time of general packers.
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

}  // namespace sonarsim
