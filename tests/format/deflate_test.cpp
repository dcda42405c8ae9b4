#include "format/deflate.h"

#include <doctest/doctest.h>
#include <zlib.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/sha256.h"
#include "format/huffman.h"
#include "format/png.h"

using namespace sonarsim;

namespace {

using Bytes = std::vector<std::uint8_t>;

/// Unpacks a stream by zlib.
Bytes unpacked(const std::string& stream, std::size_t size) {
    Bytes bytes(size + 1);
    uLongf length = bytes.size();
    REQUIRE(::uncompress(bytes.data(), &length, reinterpret_cast<const Bytef*>(stream.data()),
                         stream.size()) == Z_OK);
    bytes.resize(length);
    return bytes;
}

void check_round_trip(const Bytes& bytes) {
    for (const int pixel_bytes : {1, 2, 3, 4}) {
        for (const Packing packing : {Packing::stored, Packing::runs}) {
            CAPTURE(pixel_bytes);
            CAPTURE(bytes.size());
            CHECK(unpacked(zlib_bytes(bytes, pixel_bytes, packing), bytes.size()) == bytes);
        }
    }
}

Bytes noise(std::size_t count, int bits) {
    Bytes bytes(count);
    std::uint32_t state = 1;
    for (std::uint8_t& byte : bytes) {
        state = state * 1664525U + 1013904223U;
        byte = static_cast<std::uint8_t>(state >> (32 - bits));
    }
    return bytes;
}

}  // namespace

TEST_SUITE("dataset") {
    TEST_CASE("deflate: zlib reads back what was packed") {
        for (const std::size_t count :
             {0, 1, 2, 3, 4, 5, 257, 258, 259, 65535, 65536, 131071, 131072, 131073, 300000}) {
            check_round_trip(noise(count, 8));
            check_round_trip(noise(count, 2));
            check_round_trip(Bytes(count, 7));
            check_round_trip(Bytes(count, 255));  // the largest sums
        }
    }

    TEST_CASE("deflate: a stream of pieces has the bytes of the whole") {
        std::mt19937 random(3);
        for (const std::size_t count : {1, 5, 131072, 131073, 262144, 400000}) {
            for (const int pixel_bytes : {1, 2, 3}) {
                const Bytes bytes = noise(count, 2);
                ZlibStream stream(pixel_bytes);
                std::string packed;
                for (std::size_t at = 0; at < count;) {
                    const std::size_t piece = std::min<std::size_t>(random() % 9000, count - at);
                    stream.add(std::span(bytes).subspan(at, piece));
                    packed += stream.take();
                    at += piece;
                }
                stream.finish();
                packed += stream.take();
                CHECK(packed == zlib_bytes(bytes, pixel_bytes, Packing::runs));
            }
        }
        ZlibStream empty(1);
        empty.finish();
        CHECK(unpacked(empty.take(), 0).empty());
    }

    TEST_CASE("deflate: runs of every length, at every distance") {
        Bytes bytes = noise(16, 8);
        for (int length = 1; length < 600; ++length) {
            const std::size_t pixel = 1 + length % 4;
            for (int k = 0; k < length; ++k)
                bytes.push_back(bytes[bytes.size() - pixel]);
            bytes.push_back(static_cast<std::uint8_t>(37 * length));
        }
        check_round_trip(bytes);
    }

    TEST_CASE("deflate: the bytes are those of the packer that png_encoder() names") {
        // Noise of 1 to 8 bits with runs of all lengths in it. The sum is that of the first packer
        // of this name, which took one byte after the other.
        std::mt19937 random(5);
        std::string all;
        for (const int spread : {2, 17, 256}) {
            for (const int pixel_bytes : {1, 2, 3}) {
                Bytes bytes;
                while (bytes.size() < 150'000) {
                    const auto byte = static_cast<std::uint8_t>(random() % spread);
                    const std::size_t run = random() % 16 == 0 ? random() % 700 : 1;
                    bytes.insert(bytes.end(), run, byte);
                }
                all += zlib_bytes(bytes, pixel_bytes, Packing::runs);
            }
        }
        REQUIRE(png_encoder() == "sonarsim 2");
        CHECK(sha256(all) == "ebea1edf3aaac27edfc7037d45193fb4e8ace88b97595939811c00fd891011c7");
    }

    TEST_CASE("deflate: counts that would make codes of more than 15 bits") {
        // Fibonacci's numbers make the tree a chain of 24 symbols; the rarest is 23 deep.
        Bytes bytes;
        int next = 1;
        for (int symbol = 0, count = 1; symbol < 24; ++symbol) {
            // Far enough apart that no run is one.
            for (int k = 0; k < count; ++k)
                bytes.push_back(static_cast<std::uint8_t>(symbol));
            count = std::exchange(next, next + count);
        }
        for (std::size_t k = bytes.size(); k > 1; --k)
            std::swap(bytes[k - 1], bytes[k * 7919 % bytes.size()]);
        check_round_trip(bytes);
    }

    TEST_CASE("deflate: a picture of few ids takes a fraction of its size") {
        // 16 bits a pixel, of which pixels repeat and bytes do not.
        Bytes ids;
        for (int k = 0; k < 100'000; ++k) {
            ids.push_back(static_cast<std::uint8_t>(k / 50'000));
            ids.push_back(static_cast<std::uint8_t>(1 + k / 1000 % 3));
        }
        CHECK(zlib_bytes(ids, 2, Packing::runs).size() < ids.size() / 100);
        check_round_trip(ids);
    }

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
