#include <OpenImageIO/imageio.h>

#include "output/dataset/labelled_ping.h"
#include "run/job/run_job.h"
#include "simulate/assembly/engines.h"
#include "simulate/sonar/kinds.h"
#include "support/npy_data.h"
#include "support/small_mission.h"
#include "support/sonars.h"

using namespace sonarsim;
using namespace sonarsim::test;
namespace fs = std::filesystem;

namespace {

constexpr int labelled_poses = 4;

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
    // The facts of objects: cli/test_objects.py.
    TEST_CASE("labels: files say what the labels of the pings say") {
        const TemporaryFolder temporary;
        const fs::path& out = temporary.path;
        Mission mission = survey_mission(out);
        mission.sensors.push_back(default_sonar(SonarKind::scanning));
        mission.sensors.back().name = "scan";
        mission.sensors.back().range_bins = 60;
        mission.sensors[0].multipath.method = MultipathMethod::cluster;
        mission.output.labels = {Label::instance, Label::share, Label::elevation, Label::clean};
        const Assembly assembly = small_assembly(mission, labelled_poses);
        CHECK(run_job(mission, assembly, {}, {}, std::atomic<bool>(false)).complete);
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
        const std::vector<float> port_bins = sidescan_row(
            mission.sensors[2], render_ping(assembly.sonars[2], assembly.scene, *engine,
                                            assembly.trajectory[0].T_world_vehicle,
                                            {mission.seed, 0}, without_random_terms));
        for (int k = 0; k < 192; ++k)
            CHECK((row[k] > 0) == (port_bins[k] > 0.0F));
        const auto echo =
            data_of<std::uint16_t>(out / "sounder/instance.npy", {"<u2", {60, 2}, true});
        const PingLabels sounder = labels_of(3);
        CHECK(std::equal(sounder.object.begin(), sounder.object.end(), echo.begin()));
        data_of<float>(out / "scan/elevation.npy", {"<f4", {4, 60}});
    }
}
