#include "input/mission/parse.h"

#include "input/mission/preset.h"
#include "mission/fixtures.h"

namespace {

/// A mission whose only sensor has this preset, followed by `more` keys.
Mission mission_with(const std::string& preset, const std::string& more = "",
                     const std::vector<std::string>& settings = {}) {
    const TemporaryFolder folder;
    write_file(folder.path / "p.yaml", preset);
    return parse_mission(
        "scene: {file: a.glb, materials: a.csv}\ntrajectory: {file: a.tum}\n"
        "sensors:\n  fls: {preset: p.yaml" +
            more + "}\n",
        "m.yaml", folder.path, settings, sonar_keys());
}

}  // namespace

TEST_CASE("names and paths of a mission") {
    const Mission mission = parse(smallest_mission);
    CHECK(mission.name == "m");
    CHECK(mission.scene.file == "/base/a.glb");
    CHECK(mission.scene.materials == "/base/a.csv");
    CHECK(std::get<FileTrajectoryConfig>(mission.trajectory).file == "/base/a.tum");
    CHECK(std::get<FileTrajectoryConfig>(mission.trajectory).rate_hz == 0.0);
    // The default output folder starts at the current directory, a given one at the mission.
    const auto here = std::filesystem::current_path();
    CHECK(mission.output.folder == here / "out" / "m");
    CHECK(parse(smallest_mission + "output: {folder: o/p}\n").output.folder == "/base/o/p");
    CHECK(parse_mission(smallest_mission, "m.yaml", "", {}, sonar_keys()).scene.file ==
          here / "a.glb");
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

TEST_CASE("load_mission reads a file and refuses what is none") {
    const TemporaryFolder temporary;
    const std::filesystem::path& folder = temporary.path;
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
    CHECK(refusal(std::string((1U << 20) + 1, '#')) == "m.yaml: is larger than 1 MiB");
}

TEST_CASE("a preset fills in keys, and the mission overrides it key by key") {
    const Mission mission = mission_with(
        "kind: imaging\nmodel: calibrated\nrange_max_m: 30\n"
        "instrument:\n  frequency_hz: 7e5\n  beam: {width_deg: 1.5, side_lobe_db: -20}\n",
        ", range_max_m: 20, instrument: {beam: {width_deg: 2}}",
        {"sensors.fls.instrument.receiver.bits=12"});
    const SonarConfig& sonar = mission.sensors[0];
    CHECK(sonar.model == ModelKind::calibrated);
    CHECK(sonar.range_max_m == 20.0);
    CHECK(sonar.instrument.frequency_hz == 7e5);
    CHECK(sonar.instrument.beam.width_deg == 2.0);
    CHECK(sonar.instrument.beam.side_lobe_db == -20.0);
    CHECK(sonar.instrument.receiver.bits == 12);
    CHECK(sonar.preset.empty());
}

// A preset that does not exist: cli/test_refusals.py.
TEST_CASE("what is wrong with a preset is said where it stands") {
    for (const auto& [preset, words] :
         {std::pair("kind: imaging\nrange_maxm: 3\n",
                    "p.yaml:2:1: unknown key 'range_maxm' (did you mean 'range_max_m'?)"),
          {"preset: other.yaml\n", "p.yaml:1:1: a preset cannot name a preset"}})
        CHECK_THROWS_WITH_AS(mission_with(preset), doctest::Contains(words), InputError);
}

TEST_CASE("values that are read: engines, labels, classes, water, sensors in their order") {
    CHECK(parse(smallest_mission).engine == EngineKind::automatic);
    CHECK(parse(smallest_mission + "engine: \"rays\"\n").engine == EngineKind::rays);  // as JSON
    CHECK(parse(smallest_mission + "octree_leaf_m: 0.05\n").octree_leaf_m == 0.05);
    CHECK(parse(smallest_mission + "output: {labels: false}\n").output.labels.empty());
    CHECK(parse(smallest_mission + "output: {labels: true}\n").output.labels.size() == 14);
    CHECK(parse(smallest_mission + "name: 5\n").name == "5");
    CHECK(parse(smallest_mission +
                "water: {sound_speed_m_s: auto, temperature_c: 25, depth_m: 1000}\n")
              .water.sound_speed_m_s == approx(1550.744).epsilon(6e-7));  // Mackenzie's own check
    CHECK(parse(smallest_mission +
                "    model: calibrated\n    azimuth_deg: 60\n    instrument: {beam: "
                "{view_azimuth_deg: 60}}\n")
              .sensors.size() == 1);
    CHECK(refusal(smallest_mission + "    moves_in_ping: true\n    shutter: {groups: 2}\n") == "");
    const Mission mission = parse(smallest_mission +
                                  "  'null': {kind: imaging}\n  A-_9: {kind: imaging}\n"
                                  "output: {labels: [shadow, instance]}\n"
                                  "classes:\n  - {nodes: 'ship_*', class: ship, instance: s1}\n"
                                  "  - {nodes: '*', class: other}\n");
    CHECK(mission.output.labels == std::vector<Label>{Label::instance, Label::shadow});
    REQUIRE(mission.classes.size() == 2);
    CHECK(mission.classes[0].instance == "s1");
    CHECK(mission.classes[1].nodes == "*");
    CHECK(mission.classes[1].place.text() == "m.yaml:11:5");
    REQUIRE(mission.sensors.size() == 3);
    CHECK(mission.sensors[1].name == "null");
    CHECK(mission.sensors[2].name == "A-_9");
    CHECK(reads_back(mission));
}
