#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace sonarsim {

/// The lengths in bits of a Huffman code (RFC 1951, 3.2.2) for symbols that occur `counts` times.
/// No length exceeds `longest`; a symbol that does not occur has length 0. Ties are broken by the
/// symbol.
std::vector<std::uint8_t> huffman_lengths(std::span<const std::uint32_t> counts, int longest);

/// The codes of these lengths; the first bit in the stream is the lowest.
std::vector<std::uint16_t> huffman_codes(std::span<const std::uint8_t> lengths);

}  // namespace sonarsim
