#include <OpenImageIO/imageio.h>
#include <doctest/doctest.h>

#include <cstring>
#include <nlohmann/json.hpp>

#include "assembly/engines.h"
#include "core/file.h"
#include "dataset/labelled_ping.h"
#include "format/npy.h"
#include "job/run_job.h"
#include "sonar/kinds.h"
#include "support/npy_data.h"
#include "support/small_mission.h"
#include "support/sonars.h"
#include "support/temporary_folder.h"

using namespace sonarsim;
using namespace sonarsim::test;
namespace fs = std::filesystem;

namespace {

constexpr int labelled_poses = 4;

const std::vector<Label> all_labels = {
    Label::instance,    Label::share,          Label::second,  Label::class_name, Label::material,
    Label::elevation,   Label::height,         Label::shadow,  Label::multipath,  Label::clean,
    Label::direct_only, Label::multipath_only, Label::objects, Label::fan};

Mission labelled_mission(const fs::path& folder) {
    Mission mission = survey_mission(folder);
    SonarConfig scanning = default_sonar(SonarKind::scanning);
    scanning.name = "scan";
    scanning.range_bins = 60;
    mission.sensors.push_back(scanning);
    mission.sensors[0].multipath.method = MultipathMethod::cluster;
    mission.output.labels = all_labels;
    return mission;
}

Assembly labelled_assembly(const Mission& mission) {
    return small_assembly(mission, labelled_poses);
}

RenderSummary run_labelled(const Mission& mission, int threads = 0) {
    RenderOptions options;
    options.threads = threads;
    return run_job(mission, labelled_assembly(mission), options, {}, std::atomic<bool>(false));
}

std::vector<std::uint16_t> grey_pixels(const fs::path& path) {
    const auto in = OIIO::ImageInput::open(path.string());
    REQUIRE(in);
    REQUIRE(in->spec().format == OIIO::TypeDesc::UINT16);
    std::vector<std::uint16_t> pixels(in->spec().image_pixels());
    REQUIRE(in->read_image(0, 0, 0, 1, OIIO::TypeDesc::UINT16, pixels.data()));
    return pixels;
}

}  // namespace

TEST_SUITE("dataset") {
    TEST_CASE("labels: files say what the labels of the pings say") {
        const TemporaryFolder temporary;
        const fs::path out = temporary.path / "out";
        const Mission mission = labelled_mission(out);
        const Assembly assembly = labelled_assembly(mission);
        CHECK(run_labelled(mission).complete);
        const auto engine = make_engine(assembly.scene, engine_settings(mission, assembly));
        const auto labels_of = [&](int sensor) {
            const Sonar& sonar = assembly.sonars[sensor];
            const TracedPing traced =
                trace(sonar, assembly.scene, *engine, assembly.trajectory[0].T_world_vehicle, 0);
            return label_ping(traced, sonar.settings, assembly.scene, assembly.objects, *engine,
                              plan_labels(mission, assembly, sonar).request);
        };
        const PingLabels front = labels_of(0);
        const auto instance = grey_pixels(out / "front/instance/000000.png");
        const auto share = grey_pixels(out / "front/share/000000.png");
        const Matrix elevation = read_npy(out / "front/elevation/000000.npy");
        const Matrix clean = read_npy(out / "front/clean/000000.npy");
        REQUIRE(instance.size() == front.size());
        REQUIRE(clean.values.size() == front.size());
        std::uint64_t occupied = 0;
        for (int i = 0; i < front.range_bins; ++i) {
            for (int j = 0; j < front.beams; ++j) {
                const std::size_t pixel = static_cast<std::size_t>(i) * front.beams + j;
                const std::size_t bin = static_cast<std::size_t>(j) * front.range_bins + i;
                REQUIRE(instance[pixel] == front.object[bin]);
                REQUIRE(std::fabs(share[pixel] / 65535.0 - front.share[bin]) < 1e-5);
                REQUIRE((clean.values[pixel] > 0.0F) == (front.object[bin] > 0));
                REQUIRE(std::isnan(elevation.values[pixel]) ==
                        std::isnan(front.elevation_rad[bin]));
                occupied += front.object[bin] > 0;
            }
        }
        CHECK(occupied > 50);

        const auto row = data_of<std::uint16_t>(out / "sss/instance.npy", {"<u2", {4, 192}});
        const PingLabels sss = labels_of(2);
        const std::vector<float> port_bins = sidescan_row(
            mission.sensors[2], render_ping(assembly.sonars[2], assembly.scene, *engine,
                                            assembly.trajectory[0].T_world_vehicle,
                                            {mission.seed, 0}, without_random_terms));
        for (int k = 0; k < 192; ++k)
            CHECK((row[k] > 0) == (port_bins[k] > 0.0F));
        CHECK(std::ranges::count_if(sss.object, [](auto id) { return id > 0; }) > 0);
        const auto echo =
            data_of<std::uint16_t>(out / "sounder/instance.npy", {"<u2", {60, 2}, true});
        const PingLabels sounder = labels_of(3);
        CHECK(std::equal(sounder.object.begin(), sounder.object.end(), echo.begin()));
        data_of<float>(out / "scan/elevation.npy", {"<f4", {4, 60}});

        const auto json = nlohmann::json::parse(read_file(out / "dataset.json", 1 << 20));
        CHECK(json["labels"]["instances"].size() == assembly.objects.objects.size());
        CHECK(json["sensors"][2]["records"]["file"] == "sss/waterfall.npy");
        CHECK(json["sensors"][2]["label_records"]["instance"]["file"] == "sss/instance.npy");
        const auto seen =
            nlohmann::json::parse(read_file(out / "front/objects/000000.json", 1 << 20));
        std::uint64_t area = 0;
        for (const auto& object : seen["objects"])
            area += object["area_bins"].get<std::uint64_t>();
        CHECK(area == occupied);
        const auto in_strip = nlohmann::json::parse(read_file(out / "sss/objects.json", 1 << 20));
        CHECK(in_strip["picture"] == "waterfall.png");
        CHECK(in_strip["width"] == 192);
        CHECK(in_strip["height"] == labelled_poses);
        std::uint64_t in_port = 0;
        for (const auto& object : in_strip["objects"])
            in_port += object["side"] == "port" ? object["area_px"].get<std::uint64_t>() : 0;
        std::uint64_t expected = 0;
        for (std::size_t k = 0; k < 4U * 192U; ++k)
            expected += row[k] > 0 && k % 192 < 96;
        CHECK(in_port == expected);
        CHECK(fs::exists(out / "scan/objects_0000.json"));
        CHECK_FALSE(fs::exists(out / "sss/objects"));
    }

    TEST_CASE("labels: the same bytes for any number of threads, after a resume and overwritten") {
        const TemporaryFolder temporary;
        const fs::path one = temporary.path / "one";
        const fs::path two = temporary.path / "two";
        run_labelled(labelled_mission(one), 1);
        run_labelled(labelled_mission(two), 2);
        CHECK(contents(one / "front") == contents(two / "front"));
        CHECK(contents(one / "sss") == contents(two / "sss"));
        CHECK(contents(one / "scan") == contents(two / "scan"));

        const auto before = contents(two);
        fs::remove(two / "front/instance/000001.png");
        const RenderSummary summary = run_labelled(labelled_mission(two), 2);
        CHECK(summary.complete);
        CHECK(summary.pings == 1);
        CHECK(contents(two) == before);

        Mission plain = labelled_mission(two);
        plain.output.labels.clear();
        RenderOptions options;
        options.overwrite = true;
        run_job(plain, labelled_assembly(plain), options, {}, std::atomic<bool>(false));
        CHECK_FALSE(fs::exists(two / "front/instance"));
        CHECK_FALSE(fs::exists(two / "sss/instance.npy"));
        CHECK(fs::exists(two / "sss/waterfall.npy"));
    }
}
