#include "mission/fixtures.h"

namespace sonarsim {

TEST_SUITE_BEGIN("mission");

TEST_CASE("an unknown key is refused with the key that is near, or with all that are known") {
    CHECK(refusal(smallest_mission + "    azimut_deg: 60\n") ==
          "m.yaml:6:5: unknown key 'azimut_deg' (did you mean 'azimuth_deg'?)");
    CHECK(refusal(smallest_mission + "waters: {}\n") ==
          "m.yaml:6:1: unknown key 'waters' (did you mean 'water'?)");
    CHECK(refusal(smallest_mission + "water: {colour: 35}\n") ==
          "m.yaml:6:9: unknown key 'colour'; known here: density_kg_m3, sound_speed_m_s, "
          "temperature_c, salinity_psu, depth_m, wind_m_s, content, scattering_db_per_m3, "
          "layers, profile");
    CHECK(refusal(smallest_mission + "    noise:\n      add_sigm: 0.1\n") ==
          "m.yaml:7:7: unknown key 'add_sigm' (did you mean 'add_sigma'?)");
    CHECK(
        refusal(smallest_mission + "<<: {seed: 1}\n").starts_with("m.yaml:6:1: unknown key '<<'"));
    // Long and unprintable keys do not flood the terminal.
    const std::string message =
        refusal(smallest_mission + "? \"a\\e" + std::string(900, 'b') + "\"\n: 1\n");
    CHECK(message.starts_with("m.yaml:6:3: unknown key 'a?bbb"));
    CHECK(message.find("bbb...'; known here: name, seed") != std::string::npos);
}

TEST_CASE("a required key that is missing or misspelt") {
    CHECK(refusal("seed: 1\n") == "m.yaml:1:1: 'mission' lacks the key 'scene'");
    CHECK(refusal("\nscenes: {}\n") == "m.yaml:2:1: unknown key 'scenes' (did you mean 'scene'?)");
    CHECK(refusal("scene: {file: a}\n") == "m.yaml:1:8: 'scene' lacks the key 'materials'");
    CHECK(refusal("scene: {file: a, materials: b}\n") ==
          "m.yaml:1:1: 'mission' lacks the key 'trajectory'");
    CHECK(refusal("scene: {file: a, materials: b}\ntrajectory: {file: c}\n") ==
          "m.yaml:1:1: 'mission' lacks the key 'sensors'");
    CHECK(refusal("scene: {file: a, materials: b}\ntrajectory: {file: c}\nsensors: {}\n") ==
          "m.yaml:3:10: 'sensors' must not be empty");
    CHECK(refusal("scene: {file: a, materials: b}\ntrajectory: {file: c}\n"
                  "sensors: {x: {every: 2}}\n") == "m.yaml:3:14: 'x' lacks the key 'kind'");
}

TEST_CASE("sections that are none") {
    CHECK(refusal("") == "m.yaml:1:1: 'mission' must be a section of keys, not nothing");
    CHECK(refusal("# nothing\n") == "m.yaml:1:1: 'mission' must be a section of keys, not nothing");
    CHECK(refusal("hello\n") == "m.yaml:1:1: 'mission' must be a section of keys, not 'hello'");
    CHECK(refusal("[1]\n") == "m.yaml:1:1: 'mission' must be a section of keys, not a list");
    CHECK(refusal(smallest_mission + "water: 5\n") ==
          "m.yaml:6:8: 'water' must be a section of keys, not '5'");
    CHECK(refusal(smallest_mission + "    noise:\n")
              .find("'noise' must be a section of keys, not nothing") != std::string::npos);
    CHECK(refusal(smallest_mission + "seed:\n").find("not nothing") != std::string::npos);
    CHECK(refusal(smallest_mission + "name: ~\n") ==
          "m.yaml:6:7: 'name' must be text, not nothing");
}

TEST_CASE("the kind of a sonar") {
    const std::string before =
        "scene: {file: a, materials: b}\ntrajectory: {file: c}\nsensors: {x: {kind: ";
    const std::string known = "imaging, profiling, sidescan, echosounder, scanning";
    CHECK(refusal(before + "imagin}}\n") ==
          "m.yaml:3:21: unknown kind 'imagin' (did you mean 'imaging'?); known: " + known);
    CHECK(refusal(before + "radar}}\n") == "m.yaml:3:21: unknown kind 'radar'; known: " + known);
    CHECK(refusal(before + "[imaging]}}\n") ==
          "m.yaml:3:21: 'kind' must be one of: " + known + ", not a list");
}

TEST_CASE("each kind of sonar has defaults and keys of its own") {
    const std::string before =
        "scene: {file: a, materials: b}\ntrajectory: {file: c}\nsensors: {x: {kind: ";
    const SonarConfig sidescan = parse(before + "sidescan, range_max_m: 50}}\n").sensors[0];
    CHECK(sidescan.name == "x");
    CHECK(sidescan.azimuth_deg == 170.0);
    CHECK(sidescan.elevation_deg == 0.25);
    CHECK(sidescan.range_max_m == 50.0);
    CHECK(parse(before + "profiling}}\n").sensors[0].azimuth_bins == 480);
    CHECK(parse(before + "echosounder, opening_deg: 20}}\n").sensors[0].opening_deg == 20.0);
    CHECK(refusal(before + "echosounder, elevation_deg: 20}}\n").find("unknown key") !=
          std::string::npos);
    CHECK(refusal(before + "sidescan, azimuth_bins: 20}}\n").find("unknown key") !=
          std::string::npos);
    CHECK(refusal(before + "sidescan, noise: {range_lambda_m: 0.1}}}\n").find("no range noise") !=
          std::string::npos);
}

TEST_CASE("the engine and its octree") {
    CHECK(parse(smallest_mission).engine == EngineKind::automatic);
    CHECK(parse(smallest_mission + "engine: rays\n").engine == EngineKind::rays);
    CHECK(refusal(smallest_mission + "engine: octre\n") ==
          "m.yaml:6:9: unknown engine 'octre' (did you mean 'octree'?); known: auto, rays, octree, "
          "slices");
    CHECK(parse(smallest_mission + "octree: {leaf_m: 0.05}\n").octree.leaf_m == 0.05);
    // JSON writes them so.
    CHECK(parse(smallest_mission + "engine: \"rays\"\n").engine == EngineKind::rays);
    CHECK(refusal(smallest_mission + "octree: {leaf_m: 0}\n") ==
          "m.yaml:6:18: 'leaf_m' must be at least 0.001, not '0'");
    CHECK(refusal(smallest_mission + "octree: {leaf_m: nan}\n") ==
          "m.yaml:6:18: 'leaf_m' must be a finite number, not 'nan'");
}

TEST_CASE("sensor names are folder names") {
    const std::string before = "scene: {file: a, materials: b}\ntrajectory: {file: c}\nsensors: {";
    for (const std::string& name : {std::string("a.b"), std::string("../x"), std::string("a b"),
                                    std::string("ä"), std::string(65, 'a')}) {
        CHECK(refusal(before + name + ": {kind: imaging}}\n")
                  .find("must be 1 to 64 letters, digits, '_' or '-'") != std::string::npos);
    }
    CHECK(refusal(before + "'': {kind: imaging}}\n") ==
          "m.yaml:3:11: the name '' must be 1 to 64 letters, digits, '_' or '-'");
    for (const std::string name : {"SHA256SUMS", "seabed"}) {
        CHECK(refusal(before + name + ": {kind: imaging}}\n") ==
              "m.yaml:3:11: the name '" + name +
                  "' is that of a file or folder of the dataset; take another");
    }
    const Mission mission = parse(before +
                                  "b: {kind: imaging}, 'null': {kind: imaging}, "
                                  "A-_9: {kind: imaging}}\n");
    REQUIRE(mission.sensors.size() == 3);
    CHECK(mission.sensors[0].name == "b");  // in the order of the file
    CHECK(mission.sensors[1].name == "null");
    CHECK(mission.sensors[2].name == "A-_9");
}

TEST_CASE("a trajectory has one form") {
    const auto with = [](const std::string& trajectory) {
        return refusal(
            "scene: {file: a, materials: b}\nsensors: {s: {kind: imaging}}\n"
            "trajectory: " +
            trajectory + "\n");
    };
    CHECK(with("{}") ==
          "m.yaml:3:13: 'trajectory' needs one of the keys: file, waypoints, lawnmower");
    CHECK(with("{waypoint: []}") ==
          "m.yaml:3:13: 'trajectory' needs one of the keys: file, waypoints, lawnmower (did you "
          "mean 'waypoints'?)");
    CHECK(with("{file: a, lawnmower: {}}") ==
          "m.yaml:3:23: 'trajectory' takes one of the keys: file, waypoints, lawnmower; here are "
          "file, lawnmower");
    // Every form has keys of its own.
    CHECK(with("{file: a, speed_m_s: 1}") ==
          "m.yaml:3:23: unknown key 'speed_m_s'; known here: file, rate_hz");
    CHECK(with("a.csv") == "m.yaml:3:13: 'trajectory' must be a section of keys, not 'a.csv'");
}

TEST_SUITE_END();

}  // namespace sonarsim
