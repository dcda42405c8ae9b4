#include "input/scene/images/read_image.h"

#include "output/format/geotiff.h"
#include "support/test.h"

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

/// map.tif in a folder, with its north-western corner at (500000, 5600300).
struct NumberedMap {
    TemporaryFolder folder;
    std::filesystem::path path = folder.path / "map.tif";

    explicit NumberedMap(double cell_m = 10, const std::vector<float>& values = numbers(),
                         int width = columns) {
        write_file(path, geotiff_bytes(values, width,
                                       {.west_m = 500000, .north_m = 5600300, .cell_m = cell_m}));
    }

    /// Another file of the same map by GDAL, which has a reader and a writer of its own.
    std::filesystem::path translated(const std::string& options,
                                     const std::string& name = "other.tif") const {
        const std::filesystem::path to = folder.path / name;
        const std::string command =
            "gdal_translate -q " + options + " " + path.string() + " " + to.string();
        REQUIRE(std::system(command.c_str()) == 0);
        return to;
    }
};

void check_refused(const std::filesystem::path& path, const std::string& reason) {
    CHECK_THROWS_WITH_AS(read_image(path), doctest::Contains(reason.c_str()), InputError);
}

}  // namespace

TEST_CASE("a map that we write reads back as the same numbers in the same place") {
    const NumberedMap map;
    CHECK(is_image_file(map.path));
    const Image image = read_image(map.path);
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
    CHECK(image.unit == Image::Unit::metre);
    CHECK(!image.has_no_data);  // NaN, which is no number anyway
}

TEST_CASE("files of every type, packing and byte order hold the same numbers as for GDAL") {
    if (!has_gdal()) return;
    const NumberedMap map;
    const std::pair<const char*, const char*> files[] = {
        {"-ot Byte -a_nodata 255", "a.tif"},
        {"-ot UInt16 -a_nodata none -co COMPRESS=LZW -co PREDICTOR=2", "b.tif"},
        {"-ot Int16 -a_nodata none -co COMPRESS=DEFLATE -co TILED=YES", "c.tif"},
        {"-ot UInt32 -a_nodata none -co BIGTIFF=YES -co TILED=YES", "d.tif"},
        {"-ot Int32 -a_nodata none -co ENDIANNESS=BIG", "e.tif"},
        {"-ot Float32 -co COMPRESS=DEFLATE -co PREDICTOR=3 -co BIGTIFF=YES", "f.tif"},
        {"-ot Float64 -co COMPRESS=ZSTD", "g.tif"},
        // With its place in a world file: map.tfw, and map.wld for the PNG.
        {"-ot Float32 -co PROFILE=BASELINE -co TFW=YES", "h.tif"},
        {"-ot UInt16 -a_nodata none -of PNG -co WORLDFILE=YES", "i.png"}};
    for (const auto& file : files) {
        CAPTURE(file.first);
        const Image image = read_image(map.translated(file.first, file.second));
        CHECK(image.values == numbers());
        CHECK(image.width == columns);
        REQUIRE(image.grid);
        CHECK(image.grid->x_m == 500005);
        CHECK(image.grid->y_m == 5600295);
        CHECK(image.grid->row_m == -10);
    }
}

TEST_CASE("a tie point belongs to the corner of a pixel, or to its centre") {
    if (!has_gdal()) return;
    // GDAL moves the tie point by half a pixel as it says that it belongs to the centre.
    const NumberedMap map;
    const auto point = map.translated("-a_srs EPSG:32632 -mo AREA_OR_POINT=Point");
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
    const NumberedMap map(0.25);
    const auto in_feet = map.translated("-a_srs EPSG:2263");
    CHECK(read_image(in_feet).grid->column_m == approx(0.25 * 1200.0 / 3937.0).epsilon(1e-12));
    CHECK(epsg_of(in_feet) == 0);
    // GeoTIFF 1.1 leaves the unit to the system.
    const auto unit_of = [&](const char* system) {
        return read_image(map.translated(std::string("-co GEOTIFF_VERSION=1.1 -a_srs ") + system))
            .unit;
    };
    CHECK(unit_of("EPSG:2263") == Image::Unit::unnamed);
    CHECK(unit_of("EPSG:32632") == Image::Unit::metre);
    CHECK(read_image(map.translated("-a_srs EPSG:26915+6360")).heights_in_feet);
    check_refused(map.translated("-a_srs EPSG:3857"), "a Mercator map of the world");
    const auto degrees = read_image(map.translated("-a_srs EPSG:4326"));
    CHECK(degrees.unit == Image::Unit::degree);
    CHECK(degrees.grid->column_m == 0.25);
    const auto turned = map.translated("-co PROFILE=BASELINE", "turned.tif");
    write_file(map.folder.path / "turned.tfw", "1\n0.5\n0.5\n-1\n0\n0\n");
    check_refused(turned, "turned.tfw: its rows and columns do not run along east");
    std::filesystem::remove(map.folder.path / "turned.tfw");
    write_file(map.folder.path / "turned.TFW", "1 0 0 -1 0");
    check_refused(turned, "turned.TFW: is not a world file, which has six numbers");
}

TEST_CASE("pixels of the file's mark have no value, also where the mark is rounded") {
    if (!has_gdal()) return;
    const std::pair<std::string, float> marks[] = {{"-9999", -9999.0F}, {"-3.4e38", -3.402823e38F}};
    for (const auto& mark : marks) {
        const NumberedMap map(1.0, {1.0F, mark.second, 3.0F, -4.0F}, 2);
        const Image image = read_image(map.translated("-a_nodata " + mark.first));
        CHECK(image.has_no_data);
        CHECK(std::isnan(image.values[1]));
        CHECK(image.values[3] == -4.0F);
    }
    const NumberedMap map;
    const auto marked = map.translated("-a_nodata -9999");
    std::string bytes = read_file(marked, 1'000'000);
    bytes.replace(bytes.find("-9999"), 5, "-99,9");
    write_file(marked, bytes);
    check_refused(marked, "pixels '-99,9' (GDAL_NODATA), which is not a number");
    check_refused(map.translated("-a_scale 0.01"), "its values have a scale or an offset");
    // A mask alone is not read.
    const std::string masked = "-b 1 -mask 1 --config GDAL_TIFF_INTERNAL_MASK YES -a_nodata ";
    check_refused(map.translated(masked + "none"), "it marks unknown pixels by a mask");
    CHECK(read_image(map.translated(masked + "255")).values == numbers());
}

TEST_CASE("images that cannot be read are refused with the reason") {
    const NumberedMap map;
    const std::filesystem::path& path = map.path;
    const std::string whole = read_file(path, 1'000'000);
    check_refused(map.folder.path / "none.tif", "none.tif: no such file");
    check_refused(map.folder.path, "is not a regular file");
    write_file(path, "x,y\n1,2\n");
    check_refused(path, "is not an image; PNG, TIFF and OpenEXR are read");
    CHECK(!is_image_file(path));
    // Cut off anywhere, it is refused, and nothing crashes.
    for (const std::size_t size : {4UL, 8UL, 30UL, 200UL, 600UL, whole.size() - 1}) {
        CAPTURE(size);
        write_file(path, whole.substr(0, size));
        check_refused(path, path.string() + ": ");
    }
    // 2^31 pixels declared: ImageWidth and ImageLength are the first two tags.
    std::string bomb = whole;
    bomb.replace(10 + 8, 4, std::string("\0\0\1\0", 4));
    bomb.replace(10 + 12 + 8, 4, std::string("\0\x80\0\0", 4));
    write_file(path, bomb);
    check_refused(path, path.string() + ": ");
}

TEST_CASE("files that OpenImageIO reads wrongly are refused") {
    if (!has_gdal()) return;
    const NumberedMap map;
    check_refused(map.translated("-co COMPRESS=DEFLATE -co PREDICTOR=3 -co ENDIANNESS=BIG"),
                  "it is big-endian with the predictor of floats");
    check_refused(map.translated("-ot Float64 -co TILED=YES"), "it has tiles of 64-bit numbers");
    const NumberedMap zeros(10, std::vector<float>(1200, 0.0F));
    check_refused(
        zeros.translated("-ot Byte -a_nodata 0 -co SPARSE_OK=YES -co TILED=YES -co COMPRESS=LZW"),
        "it has empty tiles or strips");
}
