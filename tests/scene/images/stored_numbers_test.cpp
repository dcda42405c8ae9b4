#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "format/geotiff.h"
#include "scene/images/exr_file.h"
#include "scene/images/read_image.h"
#include "support/temporary_folder.h"

using namespace sonarsim;
using sonarsim::test::exr_of;
using sonarsim::test::TemporaryFolder;

namespace {

/// A TIFF of one strip, with the numbers in the file as they are here.
struct RawTiff {
    int width = 0;
    int height = 0;
    int bits = 8;
    int photometric = 3;    // PhotometricInterpretation: a palette
    int sample_format = 1;  // SampleFormat: whole numbers without a sign
    int samples = 1;
    std::vector<int> palette = {};  // all reds, greens, blues
    std::string pixels = {};
    std::string no_data = {};
    bool big_endian = false;

    std::string number(std::uint64_t value, int bytes) const {
        std::string out;
        for (int i = 0; i < bytes; ++i) {
            const int k = big_endian ? bytes - 1 - i : i;
            out += static_cast<char>(value >> (8 * k) & 0xFF);
        }
        return out;
    }

    std::string entry(int tag, int type, std::size_t count, std::uint64_t value) const {
        constexpr int short_type = 3;
        const std::string field = type == short_type && count == 1
                                      ? number(value, 2) + std::string(2, '\0')
                                      : number(value, 4);
        return number(static_cast<std::uint64_t>(tag), 2) +
               number(static_cast<std::uint64_t>(type), 2) + number(count, 4) + field;
    }

    std::string bytes() const {
        constexpr std::size_t entries = 12;
        constexpr int copyright = 33432;
        const std::size_t palette_at = 8 + 2 + 12 * entries + 4;
        const std::size_t text_at = palette_at + 2 * palette.size();
        const std::size_t pixels_at = text_at + no_data.size() + 5;
        const auto one = [&](int tag, std::uint64_t value) { return entry(tag, 3, 1, value); };
        const auto whole = [](int value) { return static_cast<std::uint64_t>(value); };
        std::string out = big_endian ? std::string("MM\0*", 4) : std::string("II*\0", 4);
        out += number(8, 4) + number(entries, 2);
        out += one(256, whole(width)) + one(257, whole(height)) + one(258, whole(bits));
        out += one(259, 1) + one(262, whole(photometric)) + entry(273, 4, 1, pixels_at);
        out += one(277, whole(samples)) + one(278, whole(height));
        out += entry(279, 4, 1, pixels.size()) + entry(320, 3, palette.size(), palette_at);
        out += one(339, whole(sample_format)) +
               entry(no_data.empty() ? copyright : 42113, 2, no_data.size() + 5, text_at) +
               number(0, 4);
        for (const int value : palette)
            out += number(whole(value), 2);
        return out + no_data + std::string(5, '\0') + pixels;
    }
};

/// Every entry of a palette of `bits` once, in 2 rows of 2^(bits - 1) pixels.
RawTiff ramp(int bits, std::vector<int> palette, bool big_endian) {
    const int count = 1 << bits;
    RawTiff file{.width = count / 2,
                 .height = 2,
                 .bits = bits,
                 .palette = std::move(palette),
                 .big_endian = big_endian};
    const int step = bits == 4 ? 2 : 1;
    for (int i = 0; i < count; i += step) {
        const int packed = bits == 4 ? 16 * i + i + 1 : i;
        file.pixels += file.number(static_cast<std::uint64_t>(packed), bits == 16 ? 2 : 1);
    }
    return file;
}

/// Red, green and blue of 8 bits by pixel; the first three entries are dark, and the last is white.
std::vector<float> drawn_colours(int count, std::mt19937& random) {
    std::vector<float> colours{0, 0, 0, 1, 1, 1, 2, 0, 1};
    while (colours.size() < 3 * static_cast<std::size_t>(count))
        colours.push_back(static_cast<float>(random() % 256));
    for (std::size_t c = 0; c < 3; ++c)
        colours[colours.size() - 1 - c] = 255.0F;
    return colours;
}

std::vector<int> entries_of(const std::vector<float>& colours, int factor) {
    const std::size_t count = colours.size() / 3;
    std::vector<int> entries(colours.size());
    for (std::size_t i = 0; i < colours.size(); ++i)
        entries[i % 3 * count + i / 3] = factor * static_cast<int>(colours[i]);
    return entries;
}

std::string fault_of_image(const std::filesystem::path& path) {
    try {
        read_image(path);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_CASE("a palette has the colours that were written, with 257, 256 or 1 as their factor") {
    const TemporaryFolder folder;
    const auto path = folder.path / "map.tif";
    std::mt19937 random(7);
    for (const int bits : {4, 8, 16}) {
        for (const int factor : {256, 257, 1}) {
            const bool big_endian = random() % 2 == 0;
            CAPTURE(bits);
            CAPTURE(factor);
            CAPTURE(big_endian);
            const std::vector<float> colours = drawn_colours(1 << bits, random);
            write_file(path, ramp(bits, entries_of(colours, factor), big_endian).bytes());
            const Image image = read_image(path);
            CHECK(image.channels == 3);
            CHECK(image.bits == 8);
            CHECK(image.width == 1 << (bits - 1));
            CHECK(image.values == colours);
        }
    }
}

TEST_CASE("the mark of unknown pixels of a palette is an entry, which becomes transparent") {
    const TemporaryFolder folder;
    const auto path = folder.path / "map.tif";
    std::mt19937 random(8);
    const std::vector<float> colours = drawn_colours(256, random);
    RawTiff file = ramp(8, entries_of(colours, 256), false);
    file.no_data = "200";
    write_file(path, file.bytes());
    const Image image = read_image(path);
    REQUIRE(image.channels == 4);
    CHECK(!image.reference.no_data);
    for (std::size_t i = 0; i < 256; ++i) {
        CHECK(image.values[4 * i] == colours[3 * i]);
        CHECK(image.values[4 * i + 3] == (i == 200 ? 0.0F : 255.0F));
    }
}

TEST_CASE("numbers of few bits, and those whose 0 is white, are those that GDAL reads") {
    if (std::system("gdal_translate --version > /dev/null 2>&1") != 0) return;
    const TemporaryFolder folder;
    const auto path = folder.path / "map.tif";
    const auto same = [&](int most, const std::string& options, const std::string& name) {
        CAPTURE(options);
        std::vector<float> values;
        for (int i = 0; i < 12 * 9; ++i)
            values.push_back(static_cast<float>(i * 37 % (most + 1)));
        write_geotiff(path, values, 12, {});
        const auto other = folder.path / name;
        const std::string command = "gdal_translate -q -a_nodata none " + options + " " +
                                    path.string() + " " + other.string() + " 2> /dev/null";
        REQUIRE(std::system(command.c_str()) == 0);
        CHECK(read_image(other).values == values);
    };
    same(1, "-ot Byte -co NBITS=1", "a.tif");
    same(1, "-ot Byte -co NBITS=1 -co COMPRESS=CCITTFAX4", "b.tif");
    same(3, "-ot Byte -co NBITS=2", "c.tif");
    same(15, "-ot Byte -co NBITS=4 -co COMPRESS=LZW", "d.tif");
    same(1023, "-ot UInt16 -co NBITS=10", "e.tif");
    same(4095, "-ot UInt16 -co NBITS=12 -co COMPRESS=DEFLATE", "f.tif");
    same(107, "-ot Byte -co PHOTOMETRIC=MINISWHITE", "g.tif");
    same(107, "-ot UInt16 -co PHOTOMETRIC=MINISWHITE -co ENDIANNESS=BIG", "h.tif");
    same(15, "-ot Byte -of PNG -co NBITS=4", "i.png");
    same(1, "-ot Byte -of PNG -co NBITS=1", "j.png");
    same(107, "-ot Float32 -co NBITS=16", "k.tif");
    same(107, "-ot Float32 -co NBITS=16 -co COMPRESS=DEFLATE -co PREDICTOR=3", "l.tif");
}

TEST_CASE("half floats have the value of their sign, exponent and ten bits") {
    const TemporaryFolder folder;
    RawTiff file{.width = 62, .height = 1024, .bits = 16, .photometric = 1, .sample_format = 3};
    std::vector<float> values;
    // All finite halves: (1 + m / 1024) 2^(e - 15), and m 2^-24 for e = 0; e = 31 is infinite or
    // NaN.
    for (int pattern = 0; pattern < 1 << 16; ++pattern) {
        const int exponent = pattern >> 10 & 31;
        const int m = pattern & 1023;
        if (exponent == 31) continue;
        const double size =
            exponent == 0 ? std::ldexp(m, -24) : std::ldexp(1024 + m, exponent - 25);
        values.push_back(static_cast<float>(pattern >> 15 == 0 ? size : -size));
        file.pixels += file.number(static_cast<std::uint64_t>(pattern), 2);
    }
    for (const bool is_exr : {false, true}) {
        CAPTURE(is_exr);
        const auto path = folder.path / "map";
        write_file(path, is_exr ? exr_of(file.pixels, 2, 62, 1024) : file.bytes());
        const Image image = read_image(path);
        CHECK(image.is_float);
        CHECK(image.bits == 16);
        CHECK(image.values == values);
    }
}

TEST_CASE("TIFFs whose colours or numbers would not stay exact are refused") {
    const TemporaryFolder folder;
    const auto path = folder.path / "map.tif";
    const auto refused = [&](const RawTiff& file, const std::string& reason) {
        write_file(path, file.bytes());
        const std::string fault = fault_of_image(path);
        CAPTURE(fault);
        CHECK(fault.find(reason) != std::string::npos);
    };
    const RawTiff whole = ramp(8, std::vector<int>(768, 512), false);
    RawTiff file = whole;
    file.photometric = 5;  // cyan, magenta, yellow, black
    refused(file, "has colours in another form than red, green and blue");
    file = whole;
    file.palette.resize(767);
    refused(file, "has pixels of a palette without its colours");
    file = whole;
    file.samples = 2;
    refused(file, "has a palette and more channels");
    file = ramp(4, std::vector<int>(48, 512), false);
    file.sample_format = 2;  // with a sign
    refused(file, "has numbers of 4 bits, which are read up to 16 and without a sign");
    file = whole;
    file.bits = 32;
    refused(file, "has a palette of more than 16 bits");
}
