#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "format/bit_writer.h"

namespace sonarsim {

// zlib streams (RFC 1950 and 1951), packed in one fixed way: the bytes are the same on every
// machine and do not depend on the version of any library. `pixel_bytes`, 1 to 4, is the distance
// at which repeated bytes are looked for.
//
// Only runs of one pixel are looked for: images of noise have nothing else that repeats, and the
// search for other repetitions takes most of the time of general packers.

enum class Packing {
    stored,  ///< not compressed
    runs,    ///< Huffman codes, and runs that repeat the previous pixel
};

std::string zlib_bytes(std::span<const std::uint8_t> bytes, int pixel_bytes, Packing packing);

/// The same stream as zlib_bytes() with Packing::runs, made of bytes that come in pieces.
class ZlibStream {
  public:
    explicit ZlibStream(int pixel_bytes);

    void add(std::span<const std::uint8_t> bytes);
    /// Ends the stream.
    void finish();
    /// Takes the part of the stream that is complete and was not taken before; may be empty.
    std::string take() { return writer_.take(); }

  private:
    void pack(std::size_t count, bool last);

    int pixel_bytes_;
    BitWriter writer_;
    std::vector<std::uint8_t> bytes_;  ///< at most one packed pixel, then the bytes to pack
    std::size_t packed_ = 0;           ///< number of packed bytes at the front of bytes_
    std::uint32_t adler_ = 1;
};

}  // namespace sonarsim
