#include <OpenImageIO/imageio.h>

#include "output/dataset/strip_rows.h"
#include "output/dataset/writer.h"
#include "simulate/product/soundings.h"
#include "simulate/sonar/sonar.h"
#include "support/images.h"
#include "support/npy_data.h"
#include "support/small_mission.h"

namespace sonarsim {
Writer make_strip_writer(const WriterContext& context);
}

namespace fs = std::filesystem;

// The arrays of images: tests/golden, and cli/test_python.py without files.
TEST_CASE_FIXTURE(
    MissionInFolder,
    "series: soundings are those of the pings, and metadata what the sonars measured") {
    mission = survey_mission(out);
    const Assembly assembly = small_assembly(mission, poses);
    CHECK(run(mission).pings == 3 * 7 + 4);
    const auto engine = make_engine(assembly.scene, engine_settings(mission));
    const auto soundings = data_of<double>(out / "mbes/soundings.npy", {"<f8", {7, 40, 5}});
    REQUIRE(soundings.size() == 7 * 40 * 5);
    for (std::uint32_t k = 0; k < 7; ++k) {
        const Pose& vehicle = assembly.trajectory[k].T_world_vehicle;
        const Ping ping =
            render_ping(assembly.sonars[1], assembly.scene, *engine, vehicle, {mission.seed, k});
        const auto found = find_soundings(assembly.sonars[1], vehicle, ping);
        for (std::size_t j = 0; j < 40; ++j) {
            const double* const f = soundings.data() + (k * 40 + j) * 5;
            CHECK(f[0] == found[j].range_m);
            CHECK(f[3] == found[j].position.z());
            CHECK(f[4] == found[j].quality);
        }
    }

    // The sonars are 1.5 m above the floor of the tank, mounts at the vehicle's origin.
    const auto measured = [&](const char* name) {
        return Json::parse(read_file(out / name, 1 << 20)).at("measured");
    };
    const Json row = measured("sss/meta/000003.json");
    CHECK(row.at("altitude_m").get<double>() == approx(1.5));
    for (const char* side : {"port", "starboard"})
        CHECK(std::fabs(row.at("first_return_m").at(side).get<double>() - 1.5) < 4.7 / 90);
    const Json column = measured("sounder/meta/000004.json");
    CHECK(column.at("altitude_m").get<double>() == approx(1.5));
    CHECK(std::fabs(column.at("depth_m").get<double>() - 1.5) < 2.0 * 2.7 / 60);
    CHECK(measured("mbes/meta/000000.json").at("soundings") == 40);
}

TEST_CASE_FIXTURE(MissionInFolder, "series: a map has the means of the soundings in its cells") {
    run(survey_mission(out));
    const auto soundings = data_of<double>(out / "mbes/soundings.npy", {"<f8", {7, 40, 5}});
    const Json map = Json::parse(read_file(out / "mbes/bathymetry.json", 1 << 20));
    const int columns = map.at("columns");
    const int rows = map.at("rows");
    const double cell = map.at("cell_m");
    const auto z = pixels_of<float>(out / "mbes/bathymetry.tif", columns, rows, 1);
    std::vector<double> sum(z.size(), 0.0);
    std::vector<int> count(z.size(), 0);
    for (int k = 0; k < 280; ++k) {
        const double* const f = soundings.data() + k * 5;
        if (f[4] < map.at("least_quality").get<double>()) continue;
        const auto column =
            static_cast<int>(std::floor((f[1] - map.at("west_m").get<double>()) / cell));
        const auto row =
            static_cast<int>(std::floor((map.at("north_m").get<double>() - f[2]) / cell));
        REQUIRE(column >= 0);
        REQUIRE(column < columns);
        REQUIRE(row >= 0);
        REQUIRE(row < rows);
        sum[row * columns + column] += f[3];
        ++count[row * columns + column];
    }
    for (std::size_t i = 0; i < z.size(); ++i) {
        REQUIRE(std::isnan(z[i]) == (count[i] == 0));
        if (count[i] > 0) REQUIRE(z[i] == approx(sum[i] / count[i]));
    }
}

TEST_CASE("series: more pings than a picture can be long are averaged") {
    const TemporaryFolder temporary;
    SonarConfig config = default_sonar(SonarKind::echosounder);
    config.range_bins = 4;
    Mission mission;
    mission.sensors = {config};
    Assembly assembly;
    assembly.sonars = {make_sonar(config, {})};
    assembly.full_scales = {1.0};
    constexpr std::size_t columns = max_picture_rows + 3;  // two to a column, the last alone
    const RecordFile file(temporary.path / "echogram.npy", {"<f4", {4, columns}, true}, columns);
    const std::vector<float> one(4, 1.0F);
    file.write(1, std::as_bytes(std::span(one)));
    file.write(columns - 1, std::as_bytes(std::span(one)));
    make_strip_writer({mission, assembly, 0, columns}).write_products(file, temporary.path);
    constexpr int width = max_picture_rows / 2 + 2;
    const auto pixels = pixels_of<std::uint16_t>(temporary.path / "echogram.png", width, 4, 1);
    CHECK(pixels[0] == 32768);
    CHECK(pixels[1] == 0);
    CHECK(pixels[width - 1] == 65535);
}
