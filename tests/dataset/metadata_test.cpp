#include "dataset/metadata.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/build_info.h"
#include "core/units.h"
#include "mission/resolved.h"
#include "sonar/kinds.h"
#include "support/approx.h"
#include "support/small_mission.h"

using namespace sonarsim;
using namespace sonarsim::test;
using Json = nlohmann::ordered_json;

TEST_SUITE("dataset") {
    TEST_CASE("metadata: dataset.json holds the files and the edges of every bin") {
        const Mission mission = small_mission("out");
        Assembly assembly = small_assembly(mission, 7);
        assembly.scene.rejects = {3, 2, 1};
        assembly.scene.vertex_rounding_m = 0.25;
        const std::vector<Writers> writers = make_writers(mission, assembly);
        const Json json = Json::parse(json_text(
            describe_dataset(mission, assembly, make_layout(mission, writers, 7), writers)));
        CHECK(json.at("format") == "sonarsim dataset");
        CHECK(json.at("format_version") == 3);
        CHECK(json.at("program_version") == build_info().version);
        CHECK(json.at("complete") == false);
        CHECK(json.at("mission") == "small");
        CHECK(json.at("mission_hash") == mission_hash(mission, sonar_keys()));
        CHECK(json.at("seed").get<std::uint64_t>() == 18446744073709551615U);
        CHECK(json.at("poses") == 7);
        // Dropped parts are counted, also if there are none.
        const Json& scene = json.at("scene");
        CHECK(scene.at("triangles") == assembly.scene.triangles.size());
        CHECK(scene.at("vertex_rounding_m") == 0.25);
        CHECK(scene.at("dropped").at("degenerate_triangles") == 3);
        CHECK(scene.at("dropped").at("non_finite_triangles") == 2);
        CHECK(scene.at("dropped").at("skipped_primitives") == 1);
        REQUIRE(json.at("sensors").size() == 2);
        const Json& left = json.at("sensors")[1];
        CHECK(left.at("name") == "left");
        CHECK(left.at("kind") == "imaging");
        CHECK(left.at("every") == 3);
        CHECK(left.at("pings") == 3);
        CHECK(left.at("files").at("polar") == "left/polar/%06d.npy");
        CHECK(left.at("files").at("meta") == "left/meta/%06d.json");
        const std::vector<double> ranges = left.at("range_edges_m");
        const std::vector<double> azimuths = left.at("azimuth_edges_rad");
        CHECK(ranges == assembly.sonars[1].range_edges_m);
        CHECK(azimuths == assembly.sonars[1].azimuth_edges_rad);
        CHECK(ranges.size() == 49);
        CHECK(ranges.front() == 0.1);
        CHECK(ranges.back() == 10.0);
        CHECK(azimuths.front() == test::approx(-radians(30)));
        // The mount of the left sonar is turned by 90 degrees about z: q = (0, 0, sin 45, cos 45).
        const std::vector<double> q = left.at("T_vehicle_sensor").at("quaternion_xyzw");
        CHECK(q[2] == test::approx(std::sqrt(0.5)));
        CHECK(q[3] == test::approx(std::sqrt(0.5)));
        // The apex of a 60 degree fan: the middle of the lower edge.
        const Json& fan = left.at("fan");
        CHECK(fan.at("apex_px")[0] == 0.5 * fan.at("width_px").get<double>());
        CHECK(fan.at("apex_px")[1].get<double>() ==
              test::approx(fan.at("height_px").get<double>()));
    }

    TEST_CASE("metadata: a ping has its time, pose and draws") {
        const Mission mission = small_mission("out");
        Assembly assembly = small_assembly(mission, 7);
        // The vehicle at (1, 2, 3), turned by 90 degrees to port: its bow, and with it the sonar
        // half a metre ahead, points along the world's y.
        assembly.trajectory[3].T_world_vehicle = {rotation_from_rpy(0, 0, 0.5 * pi),
                                                  Eigen::Vector3d(1, 2, 3)};
        Ping ping;
        ping.counts.samples = 11;
        ping.counts.dropped_samples = 14;
        ping.counts.negative_pixels = 12;
        const TracedPing traced;
        const FinishedPing finished{{3, 0}, assembly.sonars[0], traced, ping, Json(), 13};
        const Json json = Json::parse(json_text(describe_ping(mission, assembly, finished)));
        CHECK(json.at("sensor") == "front");
        CHECK(json.at("settings") == "mission.resolved.yaml#/sensors/front");
        CHECK(json.at("ping") == 3);
        CHECK(json.at("time_s") == test::approx(0.3));
        const std::vector<double> vehicle = json.at("T_world_vehicle").at("position_m");
        CHECK(vehicle == std::vector<double>{1, 2, 3});
        const std::vector<double> sensor = json.at("T_world_sensor").at("position_m");
        CHECK(sensor[0] == test::approx(1.0));
        CHECK(sensor[1] == test::approx(2.5));
        CHECK(sensor[2] == test::approx(3.0));
        const std::vector<double> q = json.at("T_world_sensor").at("quaternion_xyzw");
        CHECK(q[2] == test::approx(std::sqrt(0.5)));
        CHECK(q[3] == test::approx(std::sqrt(0.5)));
        CHECK(json.at("random").at("seed").get<std::uint64_t>() == 18446744073709551615U);
        CHECK(json.at("random").at("stream") == assembly.sonars[0].settings.stream);
        CHECK(json.at("random").at("ping") == 3);
        CHECK(json.at("full_scale") == 0.5);
        CHECK(json.at("clipped_pixels") == 13);
        CHECK(json.at("counts").at("samples") == 11);
        CHECK(json.at("counts").at("dropped_samples") == 14);
        CHECK(json.at("counts").at("negative_pixels") == 12);
    }

    TEST_CASE("metadata: numbers are the shortest that read back, names may be any bytes") {
        CHECK(json_text({{"x", 0.1}}) == "{\n \"x\": 0.1\n}\n");
        CHECK(json_text({{"x", 1.0 / 3.0}}) == "{\n \"x\": 0.3333333333333333\n}\n");
        CHECK(json_text({{"x", "a\xff"}}) == "{\n \"x\": \"a\xef\xbf\xbd\"\n}\n");
    }
}
