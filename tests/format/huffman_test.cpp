#include "format/huffman.h"

#include <doctest/doctest.h>

#include <numeric>

using namespace sonarsim;

TEST_SUITE("format") {
    TEST_CASE("huffman: the codes of RFC 1951, 3.2.2") {
        // Its example: lengths of A to H, and the codes that belong to them, there first bit first.
        const std::vector<std::uint8_t> lengths{3, 3, 3, 3, 3, 2, 4, 4};
        const std::vector<std::uint16_t> codes{0b010, 0b110, 0b001,  0b101,
                                               0b011, 0b00,  0b0111, 0b1111};
        CHECK(huffman_codes(lengths) == codes);
    }

    TEST_CASE("huffman: lengths that are optimal, and complete within their limit") {
        const std::vector<std::uint32_t> counts{8, 4, 2, 1, 1, 0};
        CHECK(huffman_lengths(counts, 15) == std::vector<std::uint8_t>{1, 2, 3, 4, 4, 0});
        const std::vector<std::uint8_t> limited = huffman_lengths(counts, 3);
        // Kraft: 2^-length adds up to 1.
        const int eighths = std::accumulate(
            limited.begin(), limited.end(), 0,
            [](int sum, std::uint8_t length) { return sum + (length > 0 ? 8 >> length : 0); });
        CHECK(eighths == 8);
    }
}
