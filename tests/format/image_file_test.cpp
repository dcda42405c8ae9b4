#include "format/image_file.h"

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <random>

#include "core/sha256.h"
#include "support/temporary_folder.h"

using namespace sonarsim;
using sonarsim::test::TemporaryFolder;

namespace {

std::vector<int> values_of(const std::vector<std::uint8_t>& row) {
    return {row.begin(), row.end()};
}
std::vector<int> values_of(const std::vector<std::uint16_t>& row) {
    return {row.begin(), row.end()};
}
std::vector<int> values_of(const std::vector<Rgb>& row) {
    std::vector<int> values;
    for (const Rgb& pixel : row)
        values.insert(values.end(), {pixel.r, pixel.g, pixel.b});
    return values;
}

/// The values of an image file, as OpenImageIO reads them; T is their type.
template <class T>
std::vector<int> read_back(const std::filesystem::path& path, OIIO::TypeDesc type, int width,
                           int height, int channels) {
    const auto file = OIIO::ImageInput::open(path.string());
    REQUIRE(file);
    CHECK(file->spec().width == width);
    CHECK(file->spec().height == height);
    CHECK(file->spec().nchannels == channels);
    CHECK(file->spec().format == type);
    std::vector<T> values(static_cast<std::size_t>(width) * height * channels);
    REQUIRE(file->read_image(0, 0, 0, channels, type, values.data()));
    return {values.begin(), values.end()};
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

/// Writes random rows and has OpenImageIO read them back.
template <class Pixel>
void check_round_trip(PixelKind kind, int width, int height) {
    CAPTURE(width);
    CAPTURE(height);
    const TemporaryFolder folder;
    const std::filesystem::path path = folder.path / "a.png";
    std::mt19937 random(11);
    std::vector<int> written;
    ImageFile image(path, width, height, kind);
    for (int y = 0; y < height; ++y) {
        std::vector<Pixel> row(static_cast<std::size_t>(width));
        for (Pixel& pixel : row)
            draw_pixel(random, pixel);
        image.row(row);
        const std::vector<int> values = values_of(row);
        written.insert(written.end(), values.begin(), values.end());
    }
    image.finish();
    const int channels = kind == PixelKind::rgb8 ? 3 : 1;
    const std::vector<int> read =
        kind == PixelKind::grey16
            ? read_back<std::uint16_t>(path, OIIO::TypeDesc::UINT16, width, height, channels)
            : read_back<std::uint8_t>(path, OIIO::TypeDesc::UINT8, width, height, channels);
    CHECK(read == written);
}

}  // namespace

TEST_SUITE("dataset") {
    TEST_CASE("image file: every pixel is read back, in one block and in many") {
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
