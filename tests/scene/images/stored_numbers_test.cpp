#include <OpenImageIO/imageio.h>

#include "input/scene/images/read_image.h"
#include "support/test.h"

namespace {

/// A TIFF of one strip, with the numbers in the file as they are here.
struct RawTiff {
    int width = 16;
    int height = 2;
    int bits = 8;
    int photometric = 1;            // PhotometricInterpretation: 0 is black; 3: a palette
    int sample_format = 1;          // SampleFormat: whole numbers without a sign
    std::vector<int> palette = {};  // all reds, greens, blues
    std::string pixels = std::string(32, 'x');

    static std::string number(std::uint64_t value, int bytes) {
        std::string out;
        for (int k = 0; k < bytes; ++k)
            out += static_cast<char>(value >> (8 * k) & 0xFF);
        return out;
    }

    std::string bytes() const {
        constexpr std::size_t entries = 11;
        const std::size_t palette_at = 8 + 2 + 12 * entries + 4;
        const auto whole = [](int value) { return static_cast<std::uint64_t>(value); };
        std::string out = std::string("II*\0", 4) + number(8, 4) + number(entries, 2);
        // A tag, its type (3: 16 bits, 4: 32 bits), the number of values, the value or its place.
        const auto add = [&](std::uint64_t tag, std::uint64_t value, std::uint64_t type = 3,
                             std::uint64_t count = 1) {
            out += number(tag, 2) + number(type, 2) + number(count, 4) + number(value, 4);
        };
        add(256, whole(width));
        add(257, whole(height));
        add(258, whole(bits));
        add(259, 1);
        add(262, whole(photometric));
        add(273, palette_at + 2 * palette.size(), 4);
        add(277, 1);
        add(278, whole(height));
        add(279, pixels.size(), 4);
        add(320, palette_at, 3, palette.size());
        add(339, whole(sample_format));
        out += number(0, 4);
        for (const int value : palette)
            out += number(whole(value), 2);
        return out + pixels;
    }
};

void write_exr(const std::filesystem::path& path, const std::vector<float>& values, int width,
               OIIO::TypeDesc type) {
    const auto out = OIIO::ImageOutput::create(path.string());
    REQUIRE(out);
    const OIIO::ImageSpec spec(width, static_cast<int>(values.size()) / width, 1, type);
    REQUIRE(out->open(path.string(), spec));
    REQUIRE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()));
    REQUIRE(out->close());
}

}  // namespace

TEST_CASE("half floats have the value of their sign, exponent and ten bits") {
    const TemporaryFolder folder;
    RawTiff file{.width = 62, .height = 1024, .bits = 16, .sample_format = 3, .pixels = ""};
    std::vector<float> values;
    // All finite halves: (1 + m / 1024) 2^(e - 15), and m 2^-24 for e = 0; not for e = 31.
    for (int pattern = 0; pattern < 1 << 16; ++pattern) {
        const int exponent = pattern >> 10 & 31;
        const int m = pattern & 1023;
        if (exponent == 31) continue;
        const double size =
            exponent == 0 ? std::ldexp(m, -24) : std::ldexp(1024 + m, exponent - 25);
        values.push_back(static_cast<float>(pattern >> 15 == 0 ? size : -size));
        file.pixels += RawTiff::number(static_cast<std::uint64_t>(pattern), 2);
    }
    write_file(folder.path / "map.tif", file.bytes());
    write_exr(folder.path / "map.exr", values, 62, OIIO::TypeDesc::HALF);
    for (const char* name : {"map.tif", "map.exr"}) {
        CAPTURE(name);
        const Image image = read_image(folder.path / name);
        CHECK(image.is_float);
        CHECK(image.bits == 16);
        CHECK(image.values == values);
    }
}

TEST_CASE("an OpenEXR file holds its floats, and damaged ones are refused") {
    const TemporaryFolder folder;
    const auto path = folder.path / "map.exr";
    std::vector<float> values;
    for (int k = 0; k < 1200; ++k)
        values.push_back(0.1F * static_cast<float>(k % 251));
    write_exr(path, values, 40, OIIO::TypeDesc::FLOAT);
    CHECK(is_image_file(path));
    const Image image = read_image(path);
    CHECK(image.width == 40);
    CHECK(image.channels == 1);
    CHECK(image.bits == 32);
    CHECK(image.is_float);
    CHECK(image.values == values);
    CHECK(!image.grid);
    const std::string whole = read_file(path, 1'000'000);
    write_file(path, whole.substr(0, whole.size() - 10));
    CHECK_THROWS_WITH_AS(read_image(path), doctest::Contains((path.string() + ": ").c_str()),
                         InputError);
    // OpenEXR would reserve 2 GB for an attribute of a file of 5 kB, OpenImageIO 4 GB for 64 rows.
    const auto changed = [&](const std::string& attribute, std::size_t at, const char(&bytes)[5]) {
        std::string file = whole;
        file.replace(file.find(attribute) + attribute.size() + 1 + at, 4, bytes, 4);
        write_file(path, file);
    };
    changed(std::string("compression\0compression", 23), 0, "\0\0\0\x7f");
    CHECK_THROWS_WITH_AS(read_image(path), doctest::Contains("its header is damaged"), InputError);
    changed(std::string("dataWindow\0box2i", 16), 12, "\xff\xff\xff\0");
    CHECK_THROWS_WITH_AS(read_image(path), doctest::Contains("2^22 of a row"), InputError);
}

TEST_CASE("TIFFs and PNGs whose numbers would not stay exact are refused") {
    const TemporaryFolder folder;
    const auto path = folder.path / "map.tif";
    write_file(path, RawTiff{}.bytes());
    CHECK_NOTHROW(read_image(path));
    const auto refused = [&](const std::string& bytes, const std::string& reason) {
        write_file(path, bytes);
        CHECK_THROWS_WITH_AS(read_image(path), doctest::Contains(reason.c_str()), InputError);
    };
    for (const int bits : {4, 12}) {
        refused(RawTiff{.bits = bits}.bytes(),
                "map.tif: cannot be read: its numbers have " + std::to_string(bits) + " bits");
    }
    for (const int kind : {0, 5}) {
        refused(RawTiff{.photometric = kind}.bytes(),
                "(PhotometricInterpretation " + std::to_string(kind) + ")");
    }
    refused(RawTiff{.photometric = 3, .palette = std::vector<int>(768, 512)}.bytes(),
            "it has a palette; write its colours with gdal_translate -expand rgb");
    refused(RawTiff{.pixels = std::string(31, 'x')}.bytes(), "it ends before its pixels do");
    // The head of a grey PNG with 4 bits.
    refused(std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\4\0", 26),
            "its numbers have 4 bits; save it with 8 or 16 bits");
}
