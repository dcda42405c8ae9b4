#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sonarsim {

/// The codes of DEFLATE (RFC 1951, 3.2.2) for symbols that occur `counts` times: lengths in bits,
/// none above `longest`, 0 for a symbol that does not occur. Ties are broken by the symbol.
std::vector<std::uint8_t> huffman_lengths(std::span<const std::uint32_t> counts, int longest);

/// The codes of these lengths, first bit lowest, as they go into the stream.
std::vector<std::uint16_t> huffman_codes(std::span<const std::uint8_t> lengths);

}  // namespace sonarsim
