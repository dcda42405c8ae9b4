#include "format/id_png.h"

#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <array>
#include <random>
#include <vector>

#include "core/file.h"
#include "format/png.h"
#include "support/temporary_folder.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

template <class T>
std::vector<T> decoded(const std::string& bytes, const OIIO::TypeDesc& type) {
    const TemporaryFolder temporary;
    write_file(temporary.path / "a.png", bytes);
    const auto in = OIIO::ImageInput::open((temporary.path / "a.png").string());
    REQUIRE(in);
    REQUIRE(in->spec().format == type);
    std::vector<T> values(in->spec().image_pixels() * in->spec().nchannels);
    REQUIRE(in->read_image(0, 0, 0, in->spec().nchannels, type, values.data()));
    return values;
}

}  // namespace

TEST_SUITE("dataset") {
    TEST_CASE("PNG of ids: another library reads back what was written") {
        std::mt19937 random(5);
        for (const int kind : {0, 1, 2, 3}) {
            CAPTURE(kind);
            for (const auto& [width, height] :
                 {std::pair(1, 1), {3, 2}, {257, 4}, {130, 33}, {1024, 600}}) {
                std::vector<std::uint16_t> ids(static_cast<std::size_t>(width) * height);
                for (std::size_t k = 0; k < ids.size(); ++k) {
                    if (kind == 1) ids[k] = static_cast<std::uint16_t>(random());
                    if (kind == 2) ids[k] = static_cast<std::uint16_t>(k / 777 % 5);
                    if (kind == 3) ids[k] = random() % 50 == 0 ? 65535 : 144;
                }
                const std::string bytes = id_png_bytes(ids, width, height);
                CHECK(static_cast<double>(bytes.size()) <= png_bytes_at_most(width, height, 2));
                CHECK(decoded<std::uint16_t>(bytes, OIIO::TypeDesc::UINT16) == ids);
            }
        }
        const std::vector<std::uint16_t> blank(512 * 256, 0);
        CHECK(id_png_bytes(blank, 256, 512).size() < 4000);
    }
}
