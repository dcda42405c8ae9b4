#include "mission/parse.h"

#include <filesystem>
#include <fstream>

#include "mission/fixtures.h"
#include "sonar/kinds.h"

namespace sonarsim {

TEST_SUITE_BEGIN("mission");

TEST_CASE("what a mission leaves out takes the defaults of the structs") {
    const Mission mission = parse(smallest_mission);
    CHECK(mission.name == "m");
    CHECK(mission.seed == 0);
    CHECK(mission.scene.file == "/base/a.glb");
    CHECK(mission.scene.materials == "/base/a.csv");
    CHECK(std::get<FileTrajectoryConfig>(mission.trajectory).file == "/base/a.tum");
    CHECK(std::get<FileTrajectoryConfig>(mission.trajectory).rate_hz == 0.0);
    CHECK(mission.output.folder == std::filesystem::current_path() / "out" / "m");
    Mission defaults = mission;
    defaults.water = {};
    defaults.accuracy = {};
    defaults.sensors[0] = {};
    defaults.sensors[0].name = "fls";
    CHECK(yaml_of(mission) == yaml_of(defaults));
}

TEST_CASE("waypoints") {
    const std::string rest =
        "scene: {file: a, materials: b}\nsensors: {s: {kind: imaging}}\ntrajectory:\n";
    const Mission mission = parse(rest +
                                  "  waypoints:\n"
                                  "    - position_m: [0, 0, 1]\n"
                                  "    - {position_m: [4, 0, 1], rpy_deg: [0, 0, 90]}\n"
                                  "  speed_m_s: 2\n");
    Mission expected = mission;
    expected.trajectory =
        WaypointTrajectoryConfig{{{{0, 0, 1}, {0, 0, 0}}, {{4, 0, 1}, {0, 0, 90}}}, 2, 10};
    CHECK(yaml_of(mission) == yaml_of(expected));

    CHECK(refusal(rest + "  waypoints: [{position_m: [0, 0, 1]}]\n") ==
          "m.yaml:4:14: 'waypoints' must have at least 2 items, not 1");
    CHECK(refusal(rest + "  waypoints: [{}, {}]\n") ==
          "m.yaml:4:15: 'waypoints.0' lacks the key 'position_m'");
    CHECK(refusal(rest + "  waypoints: [1, 2]\n") ==
          "m.yaml:4:15: 'waypoints.0' must be a section of keys, not '1'");
    CHECK(refusal(rest + "  waypoints: {}\n") ==
          "m.yaml:4:14: 'waypoints' must be a list, not a section of keys");
}

TEST_CASE("numbers are decimal and booleans are true and false") {
    CHECK(parse(smallest_mission + "seed: 010\n").seed == 10);
    CHECK(parse(smallest_mission + "    every: 0010\n").sensors[0].every == 10);
    const std::string key = "    azimuth_deg: ";
    CHECK(parse(smallest_mission + key + "010\n").sensors[0].azimuth_deg == 10.0);
    for (const char* text : {"0x10", "0o10", "1_000", "1,5", "1 2", "12deg", "1e999", "1:30",
                             ".nan", "nan", "inf", "-.inf", "-inf", "infinity"}) {
        CHECK(refusal(smallest_mission + key + text + "\n") ==
              "m.yaml:6:18: 'azimuth_deg' must be a finite number, not '" + std::string(text) +
                  "'");
    }
    for (const char* text : {"on", "yes", "True", "TRUE", "y", "1"}) {
        CHECK(refusal(smallest_mission + "output: {raw: " + text + "}\n") ==
              "m.yaml:6:15: 'raw' must be true or false, not '" + std::string(text) + "'");
    }
    CHECK(refusal(smallest_mission + "output: {raw: \"true\"}\n") ==
          "m.yaml:6:15: 'raw' must be true or false, not the quoted text 'true'");
    CHECK(refusal(smallest_mission + key + "'60'\n") ==
          "m.yaml:6:18: 'azimuth_deg' must be a finite number, not the quoted text '60'");
    CHECK(refusal(smallest_mission + key + "[60]\n") ==
          "m.yaml:6:18: 'azimuth_deg' must be a finite number, not a list");
    for (const char* text : {"1.0", "1e2", "9223372036854775808"}) {
        CHECK(refusal(smallest_mission + "    every: " + text + "\n") ==
              "m.yaml:6:12: 'every' must be a whole number, not '" + std::string(text) + "'");
    }
    for (const char* text : {"-1", "18446744073709551616", "1.5", "abc"}) {
        CHECK(refusal(smallest_mission + "seed: " + text + "\n") ==
              "m.yaml:6:7: 'seed' must be a whole number from 0 to 2^64 - 1, not '" +
                  std::string(text) + "'");
    }
}

TEST_CASE("paths") {
    CHECK(refusal("scene: {file: '', materials: b}\n") == "m.yaml:1:15: 'file' must not be empty");
    CHECK(refusal("scene: {file: \"a\\0b\", materials: b}\n") ==
          "m.yaml:1:15: 'file' must not hold control characters");
    CHECK(refusal("scene: {file: [a], materials: b}\n") ==
          "m.yaml:1:15: 'file' must be text, not a list");
    const auto here = std::filesystem::current_path();
    const Mission mission = parse_mission(smallest_mission, "m.yaml", "", {}, sonar_keys());
    CHECK(mission.scene.file == here / "a.glb");
    // The default output folder starts at the current directory, a given one at the mission.
    CHECK(parse(smallest_mission + "output: {folder: o/p}\n").output.folder == "/base/o/p");
}

TEST_CASE("the name of a mission cannot leave the output folder") {
    for (const char* name : {"..", ".", "a/b", "/tmp/x", "SHA256SUMS"}) {
        CHECK(refusal(smallest_mission + "name: " + name + "\n") ==
              "m.yaml:6:7: 'name' names a folder: at most 200 bytes, without '/', not "
              "SHA256SUMS");
    }
    CHECK(parse(smallest_mission + "name: 5\n").name == "5");
    CHECK(parse(smallest_mission + "name: \"see tests/\\\"x\"\n", {"name=tëst"}).name == "tëst");
}

TEST_CASE("load_mission reads a file and refuses what is none") {
    const auto folder = std::filesystem::temp_directory_path() / "sonarsim_mission_test";
    std::filesystem::create_directories(folder);
    const auto file = folder / "harbour.v2.yaml";
    std::ofstream(file) << smallest_mission;
    const Mission mission = load_mission({file, folder}, sonar_keys());
    CHECK(mission.name == "harbour.v2");
    CHECK(mission.scene.file == folder / "a.glb");

    std::ofstream(file) << std::string((1U << 20) + 1, '#');
    CHECK_THROWS_WITH_AS(
        load_mission({file, folder}, sonar_keys()),
        (file.string() + ": is 1048577 bytes long; at most 1048576 are read").c_str(), InputError);
    CHECK_THROWS_AS(load_mission({folder, folder}, sonar_keys()), InputError);
    CHECK_THROWS_AS(load_mission({folder / "missing.yaml", folder}, sonar_keys()), InputError);
    std::filesystem::remove_all(folder);
    CHECK(refusal(std::string((1U << 20) + 1, '#')) == "m.yaml: is larger than 1 MiB");
}

TEST_SUITE_END();

}  // namespace sonarsim
