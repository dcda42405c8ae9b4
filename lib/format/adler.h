#pragma once

#include <cstdint>
#include <span>

namespace sonarsim {

/// Adler-32, the check sum of a zlib stream (RFC 1950, 8.2), of bytes that follow those with the
/// sum `before`; 1 at the start.
std::uint32_t adler_32(std::span<const std::uint8_t> bytes, std::uint32_t before = 1);

}  // namespace sonarsim
