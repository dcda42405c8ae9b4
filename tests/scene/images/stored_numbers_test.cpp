#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/file.h"
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

    static std::string number(std::uint64_t value, int bytes) {
        std::string out;
        for (int k = 0; k < bytes; ++k)
            out += static_cast<char>(value >> (8 * k) & 0xFF);
        return out;
    }

    static std::string entry(int tag, int type, std::size_t count, std::uint64_t value) {
        constexpr int short_type = 3;
        const std::string field = type == short_type && count == 1
                                      ? number(value, 2) + std::string(2, '\0')
                                      : number(value, 4);
        return number(static_cast<std::uint64_t>(tag), 2) +
               number(static_cast<std::uint64_t>(type), 2) + number(count, 4) + field;
    }

    std::string bytes() const {
        constexpr std::size_t entries = 11;
        const std::size_t palette_at = 8 + 2 + 12 * entries + 4;
        const std::size_t pixels_at = palette_at + 2 * palette.size();
        const auto one = [&](int tag, std::uint64_t value) { return entry(tag, 3, 1, value); };
        const auto whole = [](int value) { return static_cast<std::uint64_t>(value); };
        std::string out("II*\0", 4);
        out += number(8, 4) + number(entries, 2);
        out += one(256, whole(width)) + one(257, whole(height)) + one(258, whole(bits));
        out += one(259, 1) + one(262, whole(photometric)) + entry(273, 4, 1, pixels_at);
        out += one(277, whole(samples)) + one(278, whole(height));
        out += entry(279, 4, 1, pixels.size()) + entry(320, 3, palette.size(), palette_at);
        out += one(339, whole(sample_format)) + number(0, 4);
        for (const int value : palette)
            out += number(whole(value), 2);
        return out + pixels;
    }
};

std::string fault_of_image(const std::filesystem::path& path) {
    try {
        read_image(path);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

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

TEST_CASE("TIFFs and PNGs whose numbers would not stay exact are refused") {
    const TemporaryFolder folder;
    const auto path = folder.path / "map.tif";
    const RawTiff whole{.width = 16, .height = 2, .photometric = 1, .pixels = std::string(32, 'x')};
    const auto fault_of = [&](RawTiff file) {
        write_file(path, file.bytes());
        return fault_of_image(path);
    };
    CHECK(fault_of(whole).empty());
    const auto refused = [&](auto change, const std::string& reason) {
        RawTiff file = whole;
        change(file);
        const std::string fault = fault_of(file);
        CAPTURE(fault);
        CHECK(fault.find("map.tif: cannot be read: it") != std::string::npos);
        CHECK(fault.find(reason) != std::string::npos);
    };
    refused([](RawTiff& file) { file.bits = 4; }, "its numbers have 4 bits");
    refused([](RawTiff& file) { file.bits = 12; }, "its numbers have 12 bits");
    refused([](RawTiff& file) { file.photometric = 0; }, "(PhotometricInterpretation 0)");
    refused([](RawTiff& file) { file.photometric = 5; }, "(PhotometricInterpretation 5)");
    refused(
        [](RawTiff& file) {
            file.photometric = 3;
            file.palette.resize(768, 512);
        },
        "it has a palette; write its colours with gdal_translate -expand rgb");
    refused([](RawTiff& file) { file.pixels.resize(31); }, "it ends before its pixels do");
    // The head of a grey PNG with 4 bits.
    write_file(path, std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\1\0\0\0\1\4\0", 26));
    CHECK(fault_of_image(path).find("its numbers have 4 bits; save it with 8 or 16 bits") !=
          std::string::npos);
}
