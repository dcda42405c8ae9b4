#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>

#include "core/error.h"
#include "core/file.h"
#include "core/units.h"
#include "format/open_file.h"
#include "job/run_job.h"
#include "job/verify.h"
#include "scene/images/read_image.h"
#include "support/approx.h"
#include "support/npy_data.h"
#include "support/small_mission.h"
#include "support/temporary_folder.h"

using namespace sonarsim;
using namespace sonarsim::test;
namespace fs = std::filesystem;

namespace {

constexpr int polar_poses = 3;

fs::path run_polar(const TemporaryFolder& temporary, const char* name, PolarFormat polar,
                   FanFormat fan = FanFormat::none, int threads = 2, Pack pack = Pack::none) {
    Mission mission = small_mission(temporary.path / name);
    mission.output.polar = polar;
    mission.output.fan = fan;
    mission.output.pack = pack;
    mission.output.labels = {Label::instance, Label::elevation, Label::semantic};
    RenderOptions options;
    options.threads = threads;
    const Assembly assembly = small_assembly(mission, polar_poses);
    CHECK(run_job(mission, assembly, options, {}, std::atomic<bool>(false)).complete);
    return temporary.path / name;
}

/// The bytes of all channels of a file, each [row, column], by OpenImageIO.
std::map<std::string, std::string> channels_of(const fs::path& path,
                                               std::map<std::string, OIIO::TypeDesc>& types) {
    const auto in = OIIO::ImageInput::open(path.string());
    REQUIRE(in);
    const OIIO::ImageSpec spec = in->spec();
    std::string pixels(spec.image_pixels() * spec.pixel_bytes(true), '\0');
    REQUIRE(in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UNKNOWN, pixels.data()));
    std::map<std::string, std::string> channels;
    std::size_t offset = 0;
    for (int k = 0; k < spec.nchannels; ++k) {
        const std::size_t size = spec.channelformat(k).size();
        std::string& out = channels[spec.channelnames[k]];
        types[spec.channelnames[k]] = spec.channelformat(k);
        for (std::size_t at = offset; at < pixels.size(); at += spec.pixel_bytes(true))
            out += pixels.substr(at, size);
        offset += size;
    }
    return channels;
}

template <class T>
std::vector<T> numbers_in(const std::string& bytes) {
    std::vector<T> numbers(bytes.size() / sizeof(T));
    std::memcpy(numbers.data(), bytes.data(), bytes.size());
    return numbers;
}

/// Equal bit by bit, since NaN marks bins without an elevation.
bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), 4 * a.size()) == 0;
}

std::vector<std::uint16_t> grey_numbers(const fs::path& path) {
    const auto in = OIIO::ImageInput::open(path.string());
    REQUIRE(in);
    std::vector<std::uint16_t> pixels(in->spec().image_pixels());
    REQUIRE(in->read_image(0, 0, 0, 1, OIIO::TypeDesc::UINT16, pixels.data()));
    return pixels;
}

std::vector<std::string> errors_of(const fs::path& folder) {
    const std::atomic<bool> go(false);
    return verify_dataset(folder, 1, nullptr, go).errors;
}

}  // namespace

TEST_SUITE("dataset") {
    TEST_CASE("polar: OpenEXR holds the image, its labels and its borders") {
        const TemporaryFolder temporary;
        const fs::path arrays = run_polar(temporary, "npy", PolarFormat::npy);
        const fs::path layers = run_polar(temporary, "exr", PolarFormat::exr);
        CHECK(errors_of(layers).empty());
        CHECK_FALSE(fs::exists(layers / "front/polar/000000.npy"));
        for (const char* ping : {"front/%/000000", "left/%/000000"}) {
            const auto file = [&](const fs::path& folder, const char* kind, const char* end) {
                std::string path = ping;
                return folder / path.replace(path.find('%'), 1, kind).append(end);
            };
            std::map<std::string, OIIO::TypeDesc> types;
            const auto channels = channels_of(file(layers, "polar", ".exr"), types);
            REQUIRE(channels.size() == 5);
            CHECK(types["Y"] == OIIO::TypeDesc::FLOAT);
            CHECK(types["elevation.Y"] == OIIO::TypeDesc::FLOAT);
            CHECK(types["instance.Y"] == OIIO::TypeDesc::UINT32);
            CHECK(types["semantic.Y"] == OIIO::TypeDesc::HALF);
            CHECK(same_bits(numbers_in<float>(channels.at("Y")),
                            read_npy(file(arrays, "polar", ".npy")).values));
            CHECK(same_bits(numbers_in<float>(channels.at("elevation.Y")),
                            read_npy(file(layers, "elevation", ".npy")).values));
            const auto ids = numbers_in<std::uint32_t>(channels.at("instance.Y"));
            CHECK(std::ranges::equal(ids, grey_numbers(file(layers, "instance", ".png"))));
            CHECK(std::ranges::max(ids) > 0);
        }
        const auto in = OIIO::ImageInput::open((layers / "front/polar/000000.exr").string());
        REQUIRE(in);
        const OIIO::ParamValue* edges = in->spec().find_attribute("sonarsim:azimuth_edges_rad");
        REQUIRE(edges);
        REQUIRE(edges->type().arraylen == in->spec().width + 1);
        const auto* azimuth = static_cast<const float*>(edges->data());
        const Mission mission = small_mission("");
        CHECK(azimuth[0] == test::approx(-radians(0.5 * mission.sensors[1].azimuth_deg)));
        CHECK(in->spec().get_string_attribute("DateTime").empty());
        // As a map it would have ids and intensities as numbers of one type.
        CHECK_THROWS_WITH_AS(read_image(layers / "front/polar/000000.exr"),
                             doctest::Contains("channels of different types are not read"),
                             InputError);
    }

    TEST_CASE("polar: TIFF holds the image, and the program itself reads it") {
        const TemporaryFolder temporary;
        const fs::path arrays = run_polar(temporary, "npy", PolarFormat::npy);
        const fs::path pictures = run_polar(temporary, "tiff", PolarFormat::tiff);
        CHECK(errors_of(pictures).empty());
        const Matrix expected = read_npy(arrays / "front/polar/000000.npy");
        const Image image = read_image(pictures / "front/polar/000000.tif");
        CHECK(static_cast<std::size_t>(image.height) == expected.rows);
        CHECK(same_bits(image.values, expected.values));
        std::map<std::string, OIIO::TypeDesc> types;
        const auto channels = channels_of(pictures / "front/polar/000000.tif", types);
        REQUIRE(channels.size() == 1);
        CHECK(same_bits(numbers_in<float>(channels.begin()->second), expected.values));
    }

    TEST_CASE("polar: threads and archives do not change the bytes, and damage is found") {
        const TemporaryFolder temporary;
        const fs::path one = run_polar(temporary, "one", PolarFormat::exr, FanFormat::jpeg, 1);
        const fs::path two = run_polar(temporary, "two", PolarFormat::exr, FanFormat::jpeg, 2);
        const fs::path packed =
            run_polar(temporary, "packed", PolarFormat::exr, FanFormat::webp, 2, Pack::tar);
        for (const char* file : {"front/polar/000000.exr", "front/fan/000000.jpg"})
            CHECK(read_file(one / file, 1 << 26) == read_file(two / file, 1 << 26));
        CHECK(errors_of(packed).empty());
        const fs::path damaged = one / "front/polar/000000.exr";
        fs::resize_file(damaged, fs::file_size(damaged) - 5);
        const std::vector<std::string> errors = errors_of(one);
        REQUIRE(errors.size() == 1);
        CHECK(errors[0].find("does not open: does not end after its last row") !=
              std::string::npos);
    }

    TEST_CASE("OpenEXR: a cut or changed header ends in a message") {
        const TemporaryFolder temporary;
        const fs::path out = run_polar(temporary, "exr", PolarFormat::exr);
        const std::string whole = read_file(out / "front/polar/000000.exr", 1 << 26);
        CHECK_NOTHROW(open_bytes("a.exr", whole));
        for (std::size_t bytes = 0; bytes < 1200; bytes += 7)
            CHECK_THROWS_AS(open_bytes("a.exr", whole.substr(0, bytes)), std::runtime_error);
        for (std::size_t at = 0; at < 700; ++at) {
            std::string changed = whole;
            changed[at] = '\xff';
            try {
                open_bytes("a.exr", changed);
            } catch (const std::runtime_error&) {
                // A message is as good as a text that is only named otherwise.
            }
        }
    }

    TEST_CASE("fan: JPEG and WebP show what the PNG shows") {
        const TemporaryFolder temporary;
        const auto fan_of = [&](const char* name, FanFormat format, const char* file) {
            const fs::path out = run_polar(temporary, name, PolarFormat::none, format);
            CHECK(errors_of(out).empty());
            return grey_numbers(out / "front/fan" / file);
        };
        const auto exact = fan_of("png", FanFormat::png, "000000.png");
        for (const auto& lossy : {fan_of("jpeg", FanFormat::jpeg, "000000.jpg"),
                                  fan_of("webp", FanFormat::webp, "000000.webp")}) {
            REQUIRE(lossy.size() == exact.size());
            double apart = 0.0;
            for (std::size_t k = 0; k < exact.size(); ++k)
                apart +=
                    std::abs(static_cast<int>(exact[k]) - static_cast<int>(lossy[k])) / 65535.0;
            CHECK(apart / static_cast<double>(exact.size()) < 0.03);
        }
        CHECK(std::ranges::max(exact) > 30000);
    }
}
