#include "format/png.h"

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/file.h"
#include "support/temporary_folder.h"

using namespace sonarsim;
using sonarsim::test::TemporaryFolder;

namespace {

/// Pixels of no pattern that a filter or an encoder could hide a fault behind.
template <class T>
std::vector<T> pixels_of(std::size_t count) {
    std::vector<T> pixels(count);
    std::uint32_t state = 1;
    for (T& pixel : pixels) {
        state = state * 1664525U + 1013904223U;
        pixel = static_cast<T>(state >> 13);
    }
    return pixels;
}

template <class T>
void check_round_trip(const std::string& bytes, const std::vector<T>& pixels, int width, int height,
                      int channels, OIIO::TypeDesc type) {
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path / "a.png";
    write_file(path, bytes);
    const auto in = OIIO::ImageInput::open(path.string());
    REQUIRE(in);
    CHECK(in->spec().width == width);
    CHECK(in->spec().height == height);
    CHECK(in->spec().nchannels == channels);
    CHECK(in->spec().format == type);
    std::vector<T> back(pixels.size());
    REQUIRE(in->read_image(0, 0, 0, channels, type, back.data()));
    CHECK(back == pixels);
}

/// The names of a PNG's chunks, each once.
std::vector<std::string> chunks(const std::string& bytes) {
    std::vector<std::string> names;
    for (std::size_t at = 8; at + 8 <= bytes.size();) {
        std::size_t length = 0;
        for (int i = 0; i < 4; ++i)
            length = length << 8 | static_cast<unsigned char>(bytes[at + i]);
        const std::string name = bytes.substr(at + 4, 4);
        if (names.empty() || names.back() != name) names.push_back(name);
        at += 12 + length;
    }
    return names;
}

}  // namespace

TEST_SUITE("dataset") {
    TEST_CASE("png: 8 and 16 bits, grey and RGB, are read back as they were") {
        const auto grey = pixels_of<std::uint8_t>(37 * 11);
        check_round_trip(png_bytes(grey, 37, 11), grey, 37, 11, 1, OIIO::TypeDesc::UINT8);
        const auto rgb = pixels_of<std::uint8_t>(37 * 11 * 3);
        check_round_trip(png_bytes(rgb, 37, 11, 3), rgb, 37, 11, 3, OIIO::TypeDesc::UINT8);
        const auto deep = pixels_of<std::uint16_t>(300 * 200);
        check_round_trip(png_bytes(deep, 300, 200), deep, 300, 200, 1, OIIO::TypeDesc::UINT16);
        const std::vector<std::uint8_t> dot{200};
        check_round_trip(png_bytes(dot, 1, 1), dot, 1, 1, 1, OIIO::TypeDesc::UINT8);
    }

    TEST_CASE("png: the bytes depend on the pixels alone") {
        const auto pixels = pixels_of<std::uint16_t>(64 * 64);
        const std::string first = png_bytes(pixels, 64, 64);
        // A stamp of the time would change within a second.
        std::this_thread::sleep_for(std::chrono::milliseconds(1100));
        CHECK(png_bytes(pixels, 64, 64) == first);
        for (const std::string& name : chunks(first)) {
            CAPTURE(name);
            const bool stamp = name == "tIME" || name == "tEXt" || name == "iTXt" || name == "eXIf";
            CHECK_FALSE(stamp);
        }
        CHECK(chunks(first).back() == "IEND");
    }

    TEST_CASE("png: compression is at work") {
        const std::vector<std::uint8_t> black(1000 * 1000);
        CHECK(png_bytes(black, 1000, 1000).size() < 20'000);
        // 16 bits: a dark image is packed, a full one stored.
        std::vector<std::uint16_t> deep(1000 * 1000);
        std::fill_n(deep.begin(), 400'000, 50'000);
        CHECK(png_bytes(deep, 1000, 1000).size() < 200'000);
        check_round_trip(png_bytes(deep, 1000, 1000), deep, 1000, 1000, 1, OIIO::TypeDesc::UINT16);
        const auto full = pixels_of<std::uint16_t>(1000 * 1000);
        CHECK(png_bytes(full, 1000, 1000).size() > 2'000'000);
    }

    TEST_CASE("png: a size that does not suit the pixels is a fault of the caller") {
        const std::vector<std::uint8_t> pixels(12);
        CHECK_THROWS_AS(png_bytes(pixels, 3, 3), std::logic_error);
        CHECK_THROWS_AS(png_bytes(pixels, 2, 3, 3), std::logic_error);
    }
}
