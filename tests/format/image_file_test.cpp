#include "format/image_file.h"

#include <doctest/doctest.h>

#include <fstream>
#include <random>

#include "core/sha256.h"
#include "format/png_reader.h"
#include "support/temporary_folder.h"

using namespace sonarsim;
using sonarsim::test::TemporaryFolder;

namespace {

/// The bytes of a row in PNG; values of 16 bits have the high byte first.
std::vector<std::uint8_t> png_row(const std::vector<std::uint8_t>& row) {
    return row;
}
std::vector<std::uint8_t> png_row(const std::vector<std::uint16_t>& row) {
    std::vector<std::uint8_t> bytes;
    for (const std::uint16_t value : row) {
        bytes.push_back(static_cast<std::uint8_t>(value >> 8));
        bytes.push_back(static_cast<std::uint8_t>(value));
    }
    return bytes;
}
std::vector<std::uint8_t> png_row(const std::vector<Rgb>& row) {
    std::vector<std::uint8_t> bytes;
    for (const Rgb& pixel : row)
        bytes.insert(bytes.end(), {pixel.r, pixel.g, pixel.b});
    return bytes;
}

/// Draws values that often repeat.
std::uint8_t draw(std::mt19937& random) {
    return random() % 4 == 0 ? static_cast<std::uint8_t>(random()) : 7;
}
void draw_pixel(std::mt19937& random, std::uint8_t& pixel) {
    pixel = draw(random);
}
void draw_pixel(std::mt19937& random, std::uint16_t& pixel) {
    pixel = static_cast<std::uint16_t>(draw(random) << 8 | draw(random));
}
void draw_pixel(std::mt19937& random, Rgb& pixel) {
    pixel = {draw(random), draw(random), draw(random)};
}

/// Writes random rows and has zlib read them back.
template <class Pixel>
void check_round_trip(PixelKind kind, int width, int height) {
    CAPTURE(width);
    CAPTURE(height);
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path / "a.png";
    std::mt19937 random(11);
    std::vector<std::uint8_t> written;
    ImageFile image(path, width, height, kind);
    for (int y = 0; y < height; ++y) {
        std::vector<Pixel> row(static_cast<std::size_t>(width));
        for (Pixel& pixel : row)
            draw_pixel(random, pixel);
        image.row(row);
        const std::vector<std::uint8_t> bytes = png_row(row);
        written.insert(written.end(), bytes.begin(), bytes.end());
    }
    image.finish();
    std::vector<std::uint8_t> read;
    std::ifstream file(path, std::ios::binary);
    const PngShape shape =
        read_png(file, std::filesystem::file_size(path),
                 [&](const PngShape&, std::span<const std::uint8_t> row) {
                     read.insert(read.end(), row.begin(), row.end());
                 });
    CHECK(shape.width == width);
    CHECK(shape.height == height);
    CHECK(read == written);
}

}  // namespace

TEST_SUITE("dataset") {
    TEST_CASE("image file: zlib reads back every pixel, in one block and in many") {
        for (const auto& [width, height] : {std::pair(1, 1), {37, 11}, {700, 300}}) {
            check_round_trip<std::uint8_t>(PixelKind::grey8, width, height);
            check_round_trip<std::uint16_t>(PixelKind::grey16, width, height);
            check_round_trip<Rgb>(PixelKind::rgb8, width, height);
        }
    }

    TEST_CASE("image file: the bytes are those of this sum, whichever zlib is installed") {
        const TemporaryFolder folder;
        const std::filesystem::path path = folder.path / "a.png";
        std::vector<Rgb> pixels;
        for (std::uint32_t k = 0; k < 300 * 200; ++k)
            pixels.push_back({static_cast<std::uint8_t>(k / 300),
                              static_cast<std::uint8_t>(k % 300),
                              static_cast<std::uint8_t>(k * k)});
        write_picture(path, pixels, 300);
        CHECK(sha256_of_file(path) ==
              "0d23933f07d263941c891019fa458df3a0f00f0eca684dffb6ffa02bc1f249dc");
    }

    TEST_CASE("image file: a row of another width is refused") {
        const TemporaryFolder folder;
        ImageFile image(folder.path / "a.png", 3, 1, PixelKind::grey8);
        CHECK_THROWS_AS(image.row(std::vector<std::uint8_t>(4)), std::logic_error);
    }
}
