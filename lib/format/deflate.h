#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace sonarsim {

/// Packs the bytes of an image as a zlib stream (RFC 1950 and 1951). The stream depends on the bytes
/// and on how they are divided among the calls of add(), on nothing else.
///
/// Only runs of one pixel are looked for: images of noise repeat nothing else, and the search for
/// other repetitions takes most of the time of general packers. The fan of a noisy ping (539 x 539
/// pixels of 8 bits) takes a fifth of the time of libdeflate 1.14 at level 1.
class ZlibPacker {
  public:
    /// `pixel_bytes`, 1 to 4, is the distance at which repeated bytes are looked for.
    explicit ZlibPacker(int pixel_bytes);

    /// Packs the next bytes, at least one, as a block with a Huffman code of its own.
    void add(std::span<const std::uint8_t> bytes, bool last);
    /// Takes the part of the stream that is complete and was not taken before.
    std::string take();

  private:
    int pixel_bytes_;
    std::string out_;           ///< bytes that were not taken yet
    std::uint64_t buffer_ = 0;  ///< bits that fill no byte yet
    unsigned held_ = 0;         ///< their number, less than 8
    std::uint32_t adler_ = 1;
};

}  // namespace sonarsim
