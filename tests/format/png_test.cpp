#include "output/format/png.h"

#include <OpenImageIO/imageio.h>

#include "core/hash.h"
#include "support/images.h"

namespace {

template <class T>
std::vector<T> read_back(const std::string& bytes, int width, int height) {
    const TemporaryFolder folder;
    write_file(folder.path / "a.png", bytes);
    return pixels_of<T>(folder.path / "a.png", width, height, 1);
}

/// Values of `bits` bits in runs of one to `longest` of the same value.
template <class T>
std::vector<T> drawn(std::mt19937& random, std::size_t count, unsigned bits, unsigned longest) {
    std::vector<T> values;
    values.reserve(count);
    while (values.size() < count) {
        const auto value = static_cast<T>(random() & ((1U << bits) - 1));
        const std::size_t run = 1 + random() % longest;
        values.insert(values.end(), std::min(run, count - values.size()), value);
    }
    return values;
}

}  // namespace

TEST_CASE("png: OpenImageIO reads back noise, runs of every length and areas") {
    std::mt19937 random(11);
    // One block of 128 KiB, more than one, and rows longer than a block.
    for (const auto& [width, height] :
         {std::pair(1, 1), {3, 2}, {37, 11}, {257, 300}, {700, 401}, {140'000, 3}}) {
        const std::size_t count = static_cast<std::size_t>(width) * height;
        for (const unsigned bits : {1U, 4U, 8U, 16U}) {
            for (const unsigned longest : {1U, 5U, 900U}) {
                const auto deep = drawn<std::uint16_t>(random, count, bits, longest);
                for (const PngFilter filter : {PngFilter::none, PngFilter::up, PngFilter::left}) {
                    const std::string bytes = png_bytes(deep, width, height, filter);
                    CHECK(read_back<std::uint16_t>(bytes, width, height) == deep);
                }
                if (bits == 16) continue;
                const auto grey = drawn<std::uint8_t>(random, count, bits, longest);
                CHECK(read_back<std::uint8_t>(png_bytes(grey, width, height), width, height) ==
                      grey);
            }
        }
    }
}

TEST_CASE("png: pictures and files that come row by row are read back") {
    const TemporaryFolder folder;
    std::mt19937 random(12);
    for (const auto& [width, height] : {std::pair(1, 1), {37, 11}, {700, 300}}) {
        const auto values =
            drawn<std::uint8_t>(random, 3 * static_cast<std::size_t>(width) * height, 8, 20);
        std::vector<Rgb> pixels;
        for (std::size_t k = 0; k < values.size(); k += 3)
            pixels.push_back({values[k], values[k + 1], values[k + 2]});
        write_picture(folder.path / "a.png", pixels, width);
        CHECK(pixels_of<std::uint8_t>(folder.path / "a.png", width, height, 3) == values);
        ImageFile file(folder.path / "b.png", width, height, PixelKind::grey8);
        for (int y = 0; y < height; ++y)
            file.row(std::span(values).subspan(static_cast<std::size_t>(y) * width, width));
        file.finish();
        const auto grey = pixels_of<std::uint8_t>(folder.path / "b.png", width, height, 1);
        CHECK(std::equal(grey.begin(), grey.end(), values.begin()));
    }
}

TEST_CASE("png: counts that would make codes of more than 15 bits") {
    // Fibonacci's numbers make the tree a chain of 24 symbols; the rarest is 23 deep.
    std::vector<std::uint8_t> bytes;
    int next = 1;
    for (int symbol = 0, count = 1; symbol < 24; ++symbol) {
        bytes.insert(bytes.end(), static_cast<std::size_t>(count),
                     static_cast<std::uint8_t>(symbol));
        count = std::exchange(next, next + count);
    }
    std::ranges::shuffle(bytes, std::mt19937(1));
    const TemporaryFolder folder;
    const auto width = static_cast<int>(bytes.size());
    ImageFile file(folder.path / "a.png", width, 1, PixelKind::grey8);
    file.row(bytes);
    file.finish();
    CHECK(pixels_of<std::uint8_t>(folder.path / "a.png", width, 1, 1) == bytes);
}

TEST_CASE("png: what repeats takes a fraction of its size") {
    const std::vector<std::uint8_t> black(1000 * 1000);
    CHECK(png_bytes(black, 1000, 1000).size() < 20'000);
    std::vector<std::uint16_t> ids(512 * 256);
    for (std::size_t k = 0; k < ids.size(); ++k)
        ids[k] = static_cast<std::uint16_t>(k / 256 / 100 * 771);
    CHECK(png_bytes(ids, 256, 512, PngFilter::up).size() < 5000);
}

TEST_CASE("png: the bytes are those of the packer that png_encoder names") {
    std::mt19937 random(5);
    std::string all;
    for (const unsigned bits : {2U, 5U, 8U}) {
        const auto values = drawn<std::uint8_t>(random, 300 * 500, bits, 9);
        all += png_bytes(values, 300, 500);
        all += png_bytes(drawn<std::uint16_t>(random, 300 * 500, 2 * bits, 9), 300, 500);
    }
    REQUIRE(std::string(png_encoder) == "sonarsim 3");
    CHECK(sha256(all) == "09a8829732fea1ca0d021dcb2a5fa5b61ff7968faaf093e092889f86042cfbb6");
}

TEST_CASE("png: a size that does not suit the pixels is a fault of the caller") {
    const std::vector<std::uint8_t> pixels(12);
    CHECK_THROWS_AS(png_bytes(pixels, 3, 3), std::logic_error);
    PngEncoder encoder(3, 1, PixelKind::grey8, PngFilter::left);
    CHECK_THROWS_AS(encoder.row(std::span(std::as_const(pixels)).first(4)), std::logic_error);
}
