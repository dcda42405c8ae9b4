#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace sonarsim {

enum class Packing {
    stored,  ///< as they are
    runs,    ///< Huffman codes, and runs of what stands a pixel before
};

/// Bytes as a zlib stream (RFC 1950 and 1951), in one fixed way: the same on every machine and with
/// every version of a library. `pixel_bytes`, 1 to 4, is how far back a run repeats.
///
/// Only runs are looked for: images of noise have nothing else that repeats, and looking for it is
/// what takes the time of others.
std::string zlib_bytes(std::span<const std::uint8_t> bytes, int pixel_bytes, Packing packing);

}  // namespace sonarsim
