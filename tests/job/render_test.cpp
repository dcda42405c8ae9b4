#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "assembly/engines.h"
#include "core/file.h"
#include "dataset/metadata.h"
#include "job/small_job.h"
#include "product/fan.h"
#include "sonar/kinds.h"
#include "support/npy_data.h"
#include "support/small_mission.h"
#include "support/temporary_folder.h"
#include "trajectory/files.h"

using namespace sonarsim;
using namespace sonarsim::test;
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace {

std::vector<std::uint16_t> read_pixels(const fs::path& path) {
    const auto in = OIIO::ImageInput::open(path.string());
    REQUIRE(in);
    std::vector<std::uint16_t> pixels(in->spec().image_pixels());
    // 8-bit grey g is read as 257 g.
    REQUIRE(in->read_image(0, 0, 0, 1, OIIO::TypeDesc::UINT16, pixels.data()));
    return pixels;
}

}  // namespace

TEST_SUITE("job") {
    TEST_CASE("job: a render writes every file, and they agree with each other") {
        const TemporaryFolder temporary;
        const fs::path out = temporary.path / "deep" / "out";
        Mission mission = small_mission(out);
        // Low enough that noise clips some pixels whatever its draws; at 0.5 that was luck.
        constexpr float white = 0.25F;
        mission.output.full_scale = white;
        const Assembly assembly = small_assembly(mission, poses);
        const RenderSummary summary = run(mission);
        CHECK(summary.pings == pings);
        CHECK(summary.skipped == 0);
        CHECK(summary.complete);
        CHECK_FALSE(summary.stopped);
        CHECK(summary.seconds > 0.0);
        CHECK(summary.encode_seconds > 0.0);
        CHECK(summary.write_seconds > 0.0);
        CHECK(summary.counts.samples > 0);
        CHECK(contents(out).size() == 5 + pings * 4);
        CHECK(read_file(out / "mission.resolved.yaml", 1 << 20) ==
              resolved_text(mission, assembly));
        CHECK(read_file(out / "trajectory.tum", 1 << 20) == write_tum(assembly.trajectory));

        const auto engine = make_engine(assembly.scene, engine_settings(mission, assembly));
        std::uint64_t clipped_pixels = 0;
        for (const std::uint32_t pose : {0U, 3U, 6U}) {
            for (std::size_t i = 0; i < 2; ++i) {
                const Sonar& sonar = assembly.sonars[i];
                const fs::path sensor = out / sonar.config.name;
                const std::string number = "00000" + std::to_string(pose);
                Ping ping =
                    render_ping(sonar, assembly.scene, *engine,
                                assembly.trajectory[pose].T_world_vehicle, {mission.seed, pose});
                const Matrix matrix = read_npy(sensor / "polar" / (number + ".npy"));
                CHECK(matrix.rows == 48);
                CHECK(matrix.columns == 32);
                CHECK(matrix.values == ping.intensity);
                const auto image = read_pixels(sensor / "image" / (number + ".png"));
                REQUIRE(image.size() == matrix.values.size());
                std::uint64_t clipped = 0;
                for (std::size_t k = 0; k < image.size(); ++k) {
                    const double grey =
                        65535.0 * std::min(1.0, matrix.values[k] / mission.output.full_scale);
                    REQUIRE(std::fabs(image[k] - grey) < 0.51);
                    if (matrix.values[k] > white) ++clipped;
                }
                const auto fan = render_fan(make_fan_map(sonar), ping, white);
                const auto shown = read_pixels(sensor / "fan" / (number + ".png"));
                CHECK(std::ranges::equal(shown, fan, {}, {}, [](int grey) { return 257 * grey; }));
                const Json meta =
                    Json::parse(read_file(sensor / "meta" / (number + ".json"), 1 << 20));
                CHECK(meta.at("clipped_pixels") == clipped);
                CHECK(meta.at("counts").at("samples") == ping.counts.samples);
            }
        }
        for (const auto& [name, bytes] : contents(out)) {
            if (name.find("/meta/") == std::string::npos) continue;
            clipped_pixels += Json::parse(bytes).at("clipped_pixels").get<std::uint64_t>();
        }
        CHECK(clipped_pixels > 0);
        CHECK(summary.clipped_pixels == clipped_pixels);
    }

    TEST_CASE("job: output chooses what is written") {
        const TemporaryFolder temporary;
        Mission mission = small_mission(temporary.path / "out");
        mission.output.polar = false;
        mission.output.image = false;
        run(mission);
        CHECK(contents(temporary.path / "out").size() == 5 + 2 * pings);
        CHECK(fs::exists(temporary.path / "out/left/fan/000006.png"));
        CHECK_FALSE(fs::exists(temporary.path / "out/left/polar"));
    }

    TEST_CASE("job: without files nothing is written") {
        const TemporaryFolder temporary;
        const RenderSummary summary = run(small_mission(temporary.path / "out"), {.files = false});
        CHECK(summary.pings == pings);
        CHECK(summary.encode_seconds == 0.0);
        CHECK_FALSE(fs::exists(temporary.path / "out"));
    }
}
