#include "scene/images/read_image.h"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/file.h"
#include "format/geotiff.h"
#include "scene/images/exr_file.h"
#include "support/approx.h"
#include "support/temporary_folder.h"

using namespace sonarsim;
using sonarsim::test::exr_of;
using sonarsim::test::TemporaryFolder;

namespace {

constexpr int columns = 40;
constexpr int rows = 30;

/// Whole numbers that fit into a byte, another one at every turn and mirror image of the map.
std::vector<float> numbers() {
    std::vector<float> values;
    for (int i = 0; i < rows * columns; ++i)
        values.push_back(static_cast<float>((7 * i + i / columns) % 251));
    return values;
}

bool has_gdal() {
    return std::system("gdal_translate --version > /dev/null 2>&1") == 0;
}

/// Another file of the same map by GDAL, which has a reader and a writer of its own.
std::filesystem::path translated(const std::filesystem::path& from, const std::string& options,
                                 const std::string& name) {
    const std::filesystem::path to = from.parent_path() / name;
    const std::string command =
        "gdal_translate -q " + options + " " + from.string() + " " + to.string();
    REQUIRE(std::system(command.c_str()) == 0);
    return to;
}

std::string error_of_image(const std::filesystem::path& path) {
    try {
        read_image(path);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

bool tells(const std::string& text, const std::string& part) {
    CAPTURE(text);
    CAPTURE(part);
    return text.find(part) != std::string::npos;
}

std::string bytes_of_floats(const std::vector<float>& values) {
    return {reinterpret_cast<const char*>(values.data()), sizeof(float) * values.size()};
}

}  // namespace

TEST_CASE("a map that we write reads back as the same numbers in the same place") {
    const TemporaryFolder folder;
    const auto path = folder.path / "map.tif";
    write_geotiff(path, numbers(), columns, {.west_m = 500000, .north_m = 5600300, .cell_m = 10});
    CHECK(is_image_file(path));
    const Image image = read_image(path);
    CHECK(image.width == columns);
    CHECK(image.height == rows);
    CHECK(image.channels == 1);
    CHECK(image.bits == 32);
    CHECK(image.is_float);
    CHECK(image.values == numbers());
    CHECK(*image.pixel(2, 3) == numbers()[2 * columns + 3]);
    REQUIRE(image.grid);
    // The tie point is the outer corner of the first pixel.
    CHECK(image.grid->x_m == 500005);
    CHECK(image.grid->y_m == 5600295);
    CHECK(image.grid->column_m == 10);
    CHECK(image.grid->row_m == -10);
    CHECK(!image.in_degrees);
    CHECK(!image.has_no_data);  // NaN, which is no number anyway
}

TEST_CASE("files of every type, packing and byte order hold the same numbers as for GDAL") {
    if (!has_gdal()) return;
    const TemporaryFolder folder;
    const auto path = folder.path / "map.tif";
    write_geotiff(path, numbers(), columns, {.west_m = 500000, .north_m = 5600300, .cell_m = 10});
    const auto same = [&](const std::string& options, const std::string& name) {
        CAPTURE(options);
        const Image image = read_image(translated(path, options, name));
        CHECK(image.values == numbers());
        CHECK(image.width == columns);
        REQUIRE(image.grid);
        CHECK(image.grid->x_m == 500005);
        CHECK(image.grid->y_m == 5600295);
        CHECK(image.grid->row_m == -10);
    };
    same("-ot Byte -a_nodata 255", "a.tif");
    same("-ot UInt16 -a_nodata none -co COMPRESS=LZW -co PREDICTOR=2", "b.tif");
    same("-ot Int16 -a_nodata none -co COMPRESS=DEFLATE -co TILED=YES", "c.tif");
    same("-ot UInt32 -a_nodata none -co BIGTIFF=YES -co TILED=YES", "d.tif");
    same("-ot Int32 -a_nodata none -co ENDIANNESS=BIG", "e.tif");
    same("-ot Float32 -co COMPRESS=DEFLATE -co PREDICTOR=3 -co BIGTIFF=YES", "f.tif");
    same("-ot Float64 -co COMPRESS=ZSTD", "g.tif");
    // With its place in a world file: map.tfw, and map.wld for the PNG.
    same("-ot Float32 -co PROFILE=BASELINE -co TFW=YES", "h.tif");
    same("-ot UInt16 -a_nodata none -of PNG -co WORLDFILE=YES", "i.png");
}

TEST_CASE("a tie point belongs to the corner of a pixel, or to its centre") {
    if (!has_gdal()) return;
    const TemporaryFolder folder;
    const auto path = folder.path / "map.tif";
    write_geotiff(path, numbers(), columns, {.west_m = 500000, .north_m = 5600300, .cell_m = 10});
    // GDAL moves the tie point by half a pixel as it says that it belongs to the centre.
    const auto point = translated(path, "-a_srs EPSG:32632 -mo AREA_OR_POINT=Point", "point.tif");
    CHECK(read_image(point).grid->x_m == 500005);
    CHECK(read_image(point).grid->y_m == 5600295);
    // GTRasterTypeGeoKey, in the file itself, one value: 2, the centre. It becomes 1, the corner.
    std::string bytes = read_file(point, 1'000'000);
    const std::string key("\x01\x04\0\0\x01\0\x02\0", 8);
    const std::size_t at = bytes.find(key);
    REQUIRE(at != std::string::npos);
    bytes[at + 6] = '\1';
    write_file(point, bytes);
    CHECK(read_image(point).grid->x_m == 500010);
    CHECK(read_image(point).grid->y_m == 5600290);
}

TEST_CASE("feet become metres, degrees are reported, a map that is turned is refused") {
    if (!has_gdal()) return;
    const TemporaryFolder folder;
    const auto path = folder.path / "map.tif";
    write_geotiff(path, numbers(), columns, {.west_m = 10, .north_m = 50, .cell_m = 0.25});
    const auto feet = read_image(translated(path, "-a_srs EPSG:2263", "feet.tif"));
    CHECK(feet.grid->column_m == test::approx(0.25 * 1200.0 / 3937.0).epsilon(1e-12));
    const auto degrees = read_image(translated(path, "-a_srs EPSG:4326", "deg.tif"));
    CHECK(degrees.in_degrees);
    CHECK(degrees.grid->column_m == 0.25);
    const auto turned = translated(path, "-co PROFILE=BASELINE", "turned.tif");
    write_file(folder.path / "turned.tfw", "1\n0.5\n0.5\n-1\n0\n0\n");
    CHECK(tells(error_of_image(turned), "turned.tfw: its rows and columns do not run along east"));
    write_file(folder.path / "turned.tfw", "1 0 0 -1 0");
    CHECK(tells(error_of_image(turned), "turned.tfw: is not a world file, which has six numbers"));
    const auto marked = translated(path, "-a_nodata -9999", "marked.tif");
    std::string bytes = read_file(marked, 1'000'000);
    bytes.replace(bytes.find("-9999"), 5, "-99,9");
    write_file(marked, bytes);
    CHECK(tells(error_of_image(marked), "pixels '-99,9' (GDAL_NODATA), which is not a number"));
    std::filesystem::rename(folder.path / "turned.tfw", folder.path / "turned.TFW");
    CHECK(tells(error_of_image(turned), "turned.TFW: is not a world file, which has six numbers"));
}

TEST_CASE("pixels of the file's mark have no value, also where the mark is rounded") {
    if (!has_gdal()) return;
    const TemporaryFolder folder;
    const auto path = folder.path / "map.tif";
    for (const auto& [mark, value] :
         {std::pair<std::string, float>{"-9999", -9999.0F}, {"-3.4e38", -3.402823e38F}}) {
        write_geotiff(path, std::vector{1.0F, value, 3.0F, -4.0F}, 2, {});
        const Image image = read_image(translated(path, "-a_nodata " + mark, "marked.tif"));
        CHECK(image.has_no_data);
        CHECK(std::isnan(image.values[1]));
        CHECK(image.values[3] == -4.0F);
    }
}

TEST_CASE("a mask of unknown pixels is refused, unless a value marks them, too") {
    const TemporaryFolder folder;
    const auto path = folder.path / "map.tif";
    // A second image of one pixel, whose NewSubfileType is 4, as GDAL writes a mask.
    std::string mask("\5\0", 2);
    for (const auto& [tag, value] : {std::pair<std::uint16_t, std::uint32_t>{254, 4},
                                     {256, 1},
                                     {257, 1},
                                     {273, 8},
                                     {279, 1}}) {
        const std::uint16_t type = 4;  // LONG
        const std::uint32_t count = 1;
        mask.append(reinterpret_cast<const char*>(&tag), sizeof tag);
        mask.append(reinterpret_cast<const char*>(&type), sizeof type);
        mask.append(reinterpret_cast<const char*>(&count), sizeof count);
        mask.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    mask.append(4, '\0');
    const auto with_mask = [&](std::string bytes, std::size_t tags) {
        const auto at = static_cast<std::uint32_t>(bytes.size());
        std::memcpy(&bytes[10 + 12 * tags], &at, sizeof at);
        write_file(path, bytes + mask);
        return error_of_image(path);
    };
    std::string plain = geotiff_bytes(numbers(), columns, {});
    plain[8] = 12;  // without the last tag, which is the mark of unknown pixels
    std::memset(&plain[10 + 12 * 12], 0, 12);
    write_file(path, plain);
    CHECK(error_of_image(path).empty());
    CHECK(tells(with_mask(plain, 12), "it marks unknown pixels by a mask"));
    CHECK(with_mask(geotiff_bytes(numbers(), columns, {}), 13).empty());  // NaN is its mark
}

TEST_CASE("images that cannot be read are refused with the reason") {
    const TemporaryFolder folder;
    const auto path = folder.path / "map.tif";
    CHECK(tells(error_of_image(path), "map.tif: no such file"));
    CHECK(tells(error_of_image(folder.path), "is not a regular file"));
    write_file(path, "x,y\n1,2\n");
    CHECK(tells(error_of_image(path), "is not an image; PNG, TIFF and OpenEXR are read"));
    CHECK(!is_image_file(path));
    write_geotiff(path, numbers(), columns, {});
    const std::string whole = read_file(path, 1'000'000);
    // Cut off anywhere, it is refused, and nothing crashes.
    for (const std::size_t size : {4UL, 8UL, 30UL, 200UL, 600UL, whole.size() - 1}) {
        CAPTURE(size);
        write_file(path, whole.substr(0, size));
        CHECK(tells(error_of_image(path), path.string() + ": "));
    }
    // 2^31 pixels declared: ImageWidth and ImageLength are the first two tags.
    std::string bomb = whole;
    bomb.replace(10 + 8, 4, std::string("\0\0\1\0", 4));
    bomb.replace(10 + 12 + 8, 4, std::string("\0\x80\0\0", 4));
    write_file(path, bomb);
    CHECK(tells(error_of_image(path), path.string() + ": "));
}

TEST_CASE("files that OpenImageIO reads wrongly are refused") {
    if (!has_gdal()) return;
    const TemporaryFolder folder;
    const auto path = folder.path / "map.tif";
    write_geotiff(path, numbers(), columns, {});
    const auto refused = [&](const std::string& options, const std::string& reason) {
        CHECK(tells(error_of_image(translated(path, options, "other.tif")), reason));
    };
    refused("-co COMPRESS=DEFLATE -co PREDICTOR=3 -co ENDIANNESS=BIG",
            "it is big-endian with the predictor of floats");
    refused("-ot Float64 -co TILED=YES", "it has tiles of 64-bit numbers");
    write_geotiff(path, std::vector<float>(1200, 0.0F), columns, {});
    refused("-ot Byte -a_nodata 0 -co SPARSE_OK=YES -co TILED=YES -co COMPRESS=LZW",
            "it has empty tiles or strips");
}

TEST_CASE("an OpenEXR file holds its floats, and damaged ones are refused") {
    const TemporaryFolder folder;
    const auto path = folder.path / "map.exr";
    const std::string whole = exr_of(bytes_of_floats(numbers()), 4, columns, rows);
    write_file(path, whole);
    CHECK(is_image_file(path));
    const Image image = read_image(path);
    CHECK(image.width == columns);
    CHECK(image.height == rows);
    CHECK(image.channels == 1);
    CHECK(image.bits == 32);
    CHECK(image.is_float);
    CHECK(image.values == numbers());
    CHECK(!image.grid);
    write_file(path, whole.substr(0, whole.size() - 10));
    CHECK(tells(error_of_image(path), path.string() + ": "));
}
