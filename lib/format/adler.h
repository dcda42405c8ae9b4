#pragma once

#include <cstdint>
#include <span>

namespace sonarsim {

/// The Adler-32 checksum of a zlib stream (RFC 1950, 8.2). `before` is the checksum of the bytes
/// before these; 1 at the start.
std::uint32_t adler_32(std::span<const std::uint8_t> bytes, std::uint32_t before = 1);

}  // namespace sonarsim
