#include "input/mission/resolved.h"

#include <limits>
#include <regex>

#include "input/mission/value_types.h"
#include "mission/fixtures.h"

namespace {

/// A mission with names that need quotes and numbers that need all their digits.
Mission unusual_mission() {
    Mission mission;
    mission.name = "näme \"with\" \\ quotes: # {";
    mission.seed = 18446744073709551615U;
    mission.water = {1025.1, 10000.0 / 7.0};
    mission.scene = {"/s p/a'\".glb", "/m/ü.csv"};
    mission.trajectory =
        LawnmowerTrajectoryConfig{{-1.0 / 3.0, 2}, {4, 5e6}, -6.5, 45, 3, 0.1, 1e3};
    SonarConfig sonar;
    sonar.name = "null";
    sonar.mount = {{1e-7, -2, 0.1}, {-4, 5, 0.2 + 0.1}};
    sonar.moves_in_ping = true;
    sonar.shutter = {4, ShutterOrder::interleaved, 0.07};
    sonar.noise = {0.041, 0.013, 1e-300, 0.151, false, 3.5};
    mission.sensors = {sonar, sonar};
    mission.sensors[1].name = "-";
    mission.output.folder = "/o";
    return mission;
}

}  // namespace

TEST_CASE("the resolved mission reads back as the same mission") {
    Mission mission = unusual_mission();
    CHECK(reads_back(mission));
    mission.trajectory = FileTrajectoryConfig{"/t/poses.csv", 2.5};
    CHECK(reads_back(mission));
    mission.trajectory = WaypointTrajectoryConfig{
        {{{1, 2, 3}, {4, 5, 6}}, {{-1, 0.1, 1e-9}, {7, -8, 9}}}, 3.25, 0.5};
    CHECK(reads_back(mission));
    CHECK(reads_back(parse(smallest_mission)));
}

TEST_CASE("numbers of the resolved mission are numbers of YAML 1.1, too") {
    // https://yaml.org/type/float.html and int.html: an exponent needs a point and a sign.
    const std::regex number(R"([-+]?[0-9]+(\.[0-9]*([eE][-+][0-9]+)?)?)");
    for (const double value : {0.0, -3.0, 1e6, 9e5, 2.5e22, -1e-7, 1e-300, 1.0 / 3.0, 1e23, 5e-324,
                               std::numeric_limits<double>::max()}) {
        const std::string text = yaml_text(value);
        CHECK_MESSAGE(std::regex_match(text, number), text);
        CHECK(parse_number(text) == value);
    }
    CHECK(yaml_text(std::array{1e6, 0.5}) == "[1.0e+06, 0.5]");
    CHECK(yaml_text(std::optional(9e5)) == "9.0e+05");
}

TEST_CASE("the hash knows what is rendered, not where it lies") {
    const std::string hash = mission_hash(parse(smallest_mission), sonar_keys());
    CHECK(hash.size() == 32);
    CHECK(hash.find_first_not_of("0123456789abcdef") == std::string::npos);
    const auto with = [](const std::string& setting) {
        return mission_hash(parse(smallest_mission, {setting}), sonar_keys());
    };
    CHECK(with("output.folder=/elsewhere") == hash);
    CHECK(with("water.density_kg_m3=997.0") == hash);  // the default, written out
    CHECK(mission_hash(parse_mission(smallest_mission, "m.yaml", "/other/place", {}, sonar_keys()),
                       sonar_keys()) == hash);

    CHECK(with("seed=1") != hash);
    CHECK(with("scene.file=b.glb") != hash);
    CHECK(with("scene.materials=other/a.csv") != hash);
    CHECK(with("trajectory.file=other/a.tum") != hash);
    CHECK(with("sensors.fls.noise.add_sigma=1e-300") != hash);
    CHECK(with("output.fan=false") != hash);
}

TEST_CASE("missions: the keys that differ are named, with both values") {
    const std::string one = "seed: 7\nwater: {ph: 8}\nlist: [1, 2]\nobjects: [{x: 1}, {x: 2}]\n";
    CHECK(differing_keys(one, one) == "");
    CHECK(differing_keys(one, "# a comment\n" + one) == "");
    const std::string other = "seed: 8\nwater: {}\nlist: [1, 3]\nobjects: [{x: 1}, {x: 5}]\n";
    CHECK(differing_keys(one, other) ==
          " (list: [1, 2] there, [1, 3] here; objects.1.x: 2 there, 5 here; seed: 7 there, 8 here; "
          "water.ph: 8 there, not given here)");
    CHECK(differing_keys(one, other + "a: 1\nb: 2\n").ends_with("; and 2 more)"));
    CHECK(differing_keys("objects: [{x: 1}]\n", "objects: []\n") ==
          " (objects: not given there, [] here; objects.0.x: 1 there, not given here)");
    CHECK(differing_keys("seed: [", one) == "");
}
