#include "output/format/geotiff.h"

#include <OpenImageIO/imageio.h>

#include "support/test.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_CASE("GeoTIFF: another reader finds the values, NaN among them, and nothing is stamped") {
    const TemporaryFolder temporary;
    const auto path = temporary.path / "map.tif";
    const std::vector<float> values{1, 2, std::numeric_limits<float>::quiet_NaN(), 4, -5.5F, 6};
    write_file(path, geotiff_bytes(values, 3, {.west_m = 5e5, .north_m = -2.5, .cell_m = 0.5}));
    const auto in = OIIO::ImageInput::open(path.string());
    REQUIRE(in);
    CHECK(in->spec().width == 3);
    CHECK(in->spec().height == 2);
    CHECK(in->spec().format == OIIO::TypeDesc::FLOAT);
    CHECK(in->spec().get_string_attribute("DateTime").empty());
    std::vector<float> pixels(6);
    REQUIRE(in->read_image(0, 0, 0, 1, OIIO::TypeDesc::FLOAT, pixels.data()));
    for (std::size_t k = 0; k < 6; ++k)
        CHECK((k == 2 ? std::isnan(pixels[k]) : pixels[k] == values[k]));
    // cli/test_swath_files.py tests the place with GDAL.
}
