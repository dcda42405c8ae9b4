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
    CHECK(mission.water == WaterConfig{});
    CHECK(mission.accuracy == AccuracyConfig{});
    CHECK(mission.scene.file == "/base/a.glb");
    CHECK(mission.scene.materials == "/base/a.csv");
    CHECK(std::get<FileTrajectoryConfig>(mission.trajectory).file == "/base/a.tum");
    CHECK(std::get<FileTrajectoryConfig>(mission.trajectory).rate_hz == 0.0);
    CHECK(mission.output.folder == std::filesystem::current_path() / "out" / "m");
    SonarConfig sonar;
    sonar.name = "fls";
    CHECK(mission.sensors == std::vector{sonar});
}

TEST_CASE("every key arrives where it belongs") {
    const Mission mission = parse(R"(
name: all keys
seed: 18446744073709551615
water: {density_kg_m3: 1025, sound_speed_m_s: 1500.5}
scene: {file: ../s/a.glb, materials: /abs/../m.csv}
trajectory:
  lawnmower:
    area_min_m: [-1, -2.5]
    area_max_m: [1e1, +3]
    z_m: -4
    heading_deg: 90
    line_spacing_m: 2
    speed_m_s: 0.5
    rate_hz: 20
sensors:
  port-1:
    kind: imaging
    mount: {translation_m: [1, 2, 3], rpy_deg: [-4, 5, 6]}
    every: 3
    azimuth_deg: 60
    elevation_deg: 12
    range_min_m: 0.5
    range_max_m: 8
    range_bins: 100
    azimuth_bins: 50
    noise:
      range_lambda_m: 0.04
      scatterer_m: 0.01
      add_sigma: 0.08
      mult_sigma: 0.15
      scale_with_range: false
      lobe_sigma_deg: 7
  2:
    kind: imaging
accuracy: {relative_l1: 0.1}
engine: octree
octree: {leaf_m: 0.05, memory_mb: 100, literal: true}
output:
  folder: ../o
  polar: false
  image: false
  fan: false
  meta: false
  fan_width_px: 300
  full_scale: 0.25
)");
    CHECK(mission.name == "all keys");
    CHECK(mission.seed == 18446744073709551615U);
    CHECK(mission.water == WaterConfig{1025, 1500.5});
    CHECK(mission.scene == SceneConfig{"/s/a.glb", "/m.csv"});
    CHECK(std::get<LawnmowerTrajectoryConfig>(mission.trajectory) ==
          LawnmowerTrajectoryConfig{{-1, -2.5}, {10, 3}, -4, 90, 2, 0.5, 20});
    REQUIRE(mission.sensors.size() == 2);
    SonarConfig port;
    port.name = "port-1";
    port.mount = {{1, 2, 3}, {-4, 5, 6}};
    port.every = 3;
    port.azimuth_deg = 60;
    port.elevation_deg = 12;
    port.range_min_m = 0.5;
    port.range_max_m = 8;
    port.range_bins = 100;
    port.azimuth_bins = 50;
    port.noise = {0.04, 0.01, 0.08, 0.15, false, 7};
    CHECK(mission.sensors[0] == port);
    CHECK(mission.sensors[1].name == "2");
    CHECK(mission.accuracy == AccuracyConfig{0.1});
    CHECK(mission.engine == EngineKind::octree);
    CHECK(mission.octree == OctreeConfig{0.05, 100, true});
    CHECK(mission.output == OutputConfig{"/o", false, false, false, false, false, 300, {}, 0.25});
}

TEST_CASE("waypoints") {
    const std::string rest =
        "scene: {file: a, materials: b}\nsensors: {s: {kind: imaging}}\ntrajectory:\n";
    const Mission mission = parse(rest +
                                  "  waypoints:\n"
                                  "    - position_m: [0, 0, 1]\n"
                                  "    - {position_m: [4, 0, 1], rpy_deg: [0, 0, 90]}\n"
                                  "  speed_m_s: 2\n");
    CHECK(std::get<WaypointTrajectoryConfig>(mission.trajectory) ==
          WaypointTrajectoryConfig{{{{0, 0, 1}, {0, 0, 0}}, {{4, 0, 1}, {0, 0, 90}}}, 2, 10});

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
        CHECK(refusal(smallest_mission + "output: {fan: " + text + "}\n") ==
              "m.yaml:6:15: 'fan' must be true or false, not '" + std::string(text) + "'");
    }
    CHECK(refusal(smallest_mission + "output: {fan: \"true\"}\n") ==
          "m.yaml:6:15: 'fan' must be true or false, not the quoted text 'true'");
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

TEST_CASE("a value outside its range is refused at its place") {
    struct Case {
        const char* line;
        const char* message;
    };
    // Sensor keys have four blanks; "    azimuth_deg: 0" begins its value in column 18.
    for (const Case& one : {
             Case{"    azimuth_deg: 0", "18: 'azimuth_deg' must be at least 0.001, not '0'"},
             {"    azimuth_deg: 360.1", "18: 'azimuth_deg' must be at most 360, not '360.1'"},
             {"    elevation_deg: -1", "20: 'elevation_deg' must be at least 0.001, not '-1'"},
             {"    elevation_deg: 181", "20: 'elevation_deg' must be at most 180, not '181'"},
             {"    range_min_m: -0.1", "18: 'range_min_m' must be at least 0, not '-0.1'"},
             {"    range_max_m: 0", "18: 'range_max_m' must be above 0, not '0'"},
             {"    range_bins: 0", "17: 'range_bins' must be at least 1, not '0'"},
             {"    range_bins: 8193", "17: 'range_bins' must be at most 8192, not '8193'"},
             {"    azimuth_bins: 0", "19: 'azimuth_bins' must be at least 1, not '0'"},
             {"    azimuth_bins: 4294967297",
              "19: 'azimuth_bins' must be at most 8192, not '4294967297'"},
             {"    every: 0", "12: 'every' must be at least 1, not '0'"},
             {"    noise: {add_sigma: -1}", "24: 'add_sigma' must be at least 0, not '-1'"},
             {"    noise: {mult_sigma: -1}", "25: 'mult_sigma' must be at least 0, not '-1'"},
             {"    noise: {range_lambda_m: -1}",
              "29: 'range_lambda_m' must be at least 0, not '-1'"},
             {"    noise: {scatterer_m: 0}", "26: 'scatterer_m' must be at least 1e-04, not '0'"},
             {"    noise: {lobe_sigma_deg: -1}",
              "29: 'lobe_sigma_deg' must be at least 0, not '-1'"},
             {"    mount: {translation_m: [0, 0, 2e9]}",
              "35: 'translation_m' must be at most 1e+08, not '2e9'"},
             {"water: {density_kg_m3: 0}", "24: 'density_kg_m3' must be at least 1e-09, not '0'"},
             {"water: {sound_speed_m_s: -5}",
              "26: 'sound_speed_m_s' must be at least 1e-09, not '-5'"},
             {"water: {density_kg_m3: 1e308}",
              "24: 'density_kg_m3' must be at most 1e+09, not '1e308'"},
             {"accuracy: {relative_l1: 0}", "25: 'relative_l1' must be at least 1e-04, not '0'"},
             {"accuracy: {relative_l1: 0.6}", "25: 'relative_l1' must be at most 0.5, not '0.6'"},
             {"output: {full_scale: 0}", "22: 'full_scale' must be above 0, not '0'"},
             {"output: {fan_width_px: -1}", "24: 'fan_width_px' must be at least 0, not '-1'"},
         }) {
        CHECK(refusal(smallest_mission + one.line + "\n") ==
              "m.yaml:6:" + std::string(one.message));
    }
    // The edges themselves are in.
    CHECK(refusal(smallest_mission +
                  "    azimuth_deg: 360\n    elevation_deg: 180\n    range_min_m: 0\n"
                  "    range_bins: 8192\n    azimuth_bins: 8192\n    every: 1\n"
                  "accuracy: {relative_l1: 0.5}\n") == "");
}

TEST_CASE("every fault is told, each where it stands") {
    const auto faults = [](const std::string& text) {
        try {
            parse(text);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(faults(smallest_mission +
                 "    azimut_deg: 60\n    range_bins: many\n    range_min_m: -1\n"
                 "output: {fan: yes, polr: true}\nseed: -1\n") ==
          "m.yaml:10:7: 'seed' must be a whole number from 0 to 2^64 - 1, not '-1'\n"
          "m.yaml:8:18: 'range_min_m' must be at least 0, not '-1'\n"
          "m.yaml:7:17: 'range_bins' must be a whole number, not 'many'\n"
          "m.yaml:6:5: unknown key 'azimut_deg' (did you mean 'azimuth_deg'?)\n"
          "m.yaml:9:15: 'fan' must be true or false, not 'yes'\n"
          "m.yaml:9:20: unknown key 'polr' (did you mean 'polar'?)");
    // Of a section whose kind is not known nothing else can be told; the others are read.
    CHECK(faults("scene: {file: a}\nsensors: {s: {kind: imagin, every: 0}}\n") ==
          "m.yaml:1:8: 'scene' lacks the key 'materials'\n"
          "m.yaml:1:1: 'mission' lacks the key 'trajectory'\n"
          "m.yaml:2:21: unknown kind 'imagin' (did you mean 'imaging'?); known: imaging, "
          "profiling, sidescan, echosounder, scanning");
}

TEST_CASE("ranges of the trajectory forms") {
    const auto with = [](const std::string& trajectory) {
        return refusal(
            "scene: {file: a, materials: b}\nsensors: {s: {kind: imaging}}\n"
            "trajectory: " +
            trajectory + "\n");
    };
    const std::string points = "{waypoints: [{position_m: [0,0,0]}, {position_m: [1,0,0]}], ";
    CHECK(with("{file: a, rate_hz: 0}") == "");
    CHECK(with("{file: a, rate_hz: -1}") == "m.yaml:3:32: 'rate_hz' must be at least 0, not '-1'");
    CHECK(with(points + "rate_hz: 5}") == "");
    CHECK(with(points + "rate_hz: 0}") == "m.yaml:3:82: 'rate_hz' must be above 0, not '0'");
    CHECK(with(points + "speed_m_s: 0}") == "m.yaml:3:84: 'speed_m_s' must be above 0, not '0'");
    CHECK(with("{waypoints: [{position_m: [0,0]}]}") ==
          "m.yaml:3:25: 'waypoints' must have at least 2 items, not 1");
    CHECK(with("{waypoints: [{position_m: [0,0]}, {}]}") ==
          "m.yaml:3:39: 'position_m' must be a list of 3 numbers, not of 2");
    const auto lawnmower = [&](const std::string& more) {
        return with("{lawnmower: {area_min_m: [0, 0], area_max_m: [9, 9]" + more + "}}");
    };
    CHECK(lawnmower(", z_m: 1") == "");
    CHECK(lawnmower("") == "m.yaml:3:25: 'lawnmower' lacks the key 'z_m'");
    CHECK(lawnmower(", z_m: 1, line_spacing_m: 0") ==
          "m.yaml:3:90: 'line_spacing_m' must be above 0, not '0'");
    CHECK(with("{lawnmower: {area_min_m: [0, 9], area_max_m: [9, 9], z_m: 0}}") ==
          "m.yaml:3:58: area_min_m must be below area_max_m in x and in y");
}

TEST_CASE("checks across keys stand at the key that was written last") {
    CHECK(refusal(smallest_mission + "    range_max_m: 5\n    range_min_m: 5\n") ==
          "m.yaml:7:18: range_min_m must be below range_max_m");
    // Only range_max_m is written; the default of range_min_m is 0.1.
    CHECK(refusal(smallest_mission + "    range_max_m: 0.05\n") ==
          "m.yaml:6:18: range_min_m must be below range_max_m");
    CHECK(refusal(smallest_mission + "    range_min_m: 20\n", {"sensors.fls.range_max_m=15"}) ==
          "--set sensors.fls.range_max_m=15: range_min_m must be below range_max_m");
    // 1e-4 m over 512 bins is 2e-7 m a bin.
    CHECK(refusal(smallest_mission + "    range_min_m: 1\n    range_max_m: 1.0001\n") ==
          "m.yaml:7:18: range bins must be wider than a micrometre");
    // A side-scan's waterfall has a column per bin from nadir on: here of a centimetre.
    const auto from = [](const std::string& range_min_m, const std::string& range_max_m) {
        return refusal(smallest_mission + "    range_bins: 100\n    range_min_m: " + range_min_m +
                           "\n    range_max_m: " + range_max_m + "\n",
                       {"sensors.fls.kind=sidescan"});
    };
    CHECK(from("655", "656") == "");
    CHECK(from("656", "657") ==
          "m.yaml:8:18: a side-scan's waterfall begins at nadir: range_min_m "
          "must be at most 65536 range bins");
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
    for (const char* name : {"..", ".", "a/b", "/tmp/x"}) {
        CHECK(refusal(smallest_mission + "name: " + name + "\n") ==
              "m.yaml:6:7: 'name' names a folder: at most 200 bytes, without '/'");
    }
    CHECK(parse(smallest_mission + "name: 5\n").name == "5");
    CHECK(parse(smallest_mission + "name: \"see tests/\\\"x\"\n", {"name=tëst"}).name == "tëst");
}

TEST_CASE("load_mission reads a file and refuses what is none") {
    const std::vector<std::string> none;
    const auto folder = std::filesystem::temp_directory_path() / "sonarsim_mission_test";
    std::filesystem::create_directories(folder);
    const auto file = folder / "harbour.v2.yaml";
    std::ofstream(file) << smallest_mission;
    const Mission mission = load_mission(file, none, sonar_keys());
    CHECK(mission.name == "harbour.v2");
    CHECK(mission.scene.file == folder / "a.glb");

    std::ofstream(file) << std::string((1U << 20) + 1, '#');
    CHECK_THROWS_WITH_AS(
        load_mission(file, none, sonar_keys()),
        (file.string() + ": is 1048577 bytes long; at most 1048576 are read").c_str(), InputError);
    CHECK_THROWS_AS(load_mission(folder, none, sonar_keys()), InputError);
    CHECK_THROWS_AS(load_mission(folder / "missing.yaml", none, sonar_keys()), InputError);
    std::filesystem::remove_all(folder);
    CHECK(refusal(std::string((1U << 20) + 1, '#')) == "m.yaml: is larger than 1 MiB");
}

TEST_CASE("the example missions are valid") {
    const std::filesystem::path root = SONARSIM_SOURCE_DIR;
    const Mission mission = load_mission(root / "configs/tank_imaging.yaml", {}, sonar_keys());
    CHECK(mission.name == "tank_imaging");
    CHECK(mission.scene.file == root / "scenes/tank.glb");
    CHECK(mission.sensors.at(0).range_bins == 512);
    for (const char* name : {"seafloor_bathymetry", "seafloor_sidescan", "tank_echosounder"}) {
        const std::filesystem::path file = root / "configs" / (std::string(name) + ".yaml");
        CHECK(load_mission(file, {}, sonar_keys()).name == name);
        CHECK(load_mission(file, {}, sonar_keys()).sensors.size() == 1);
    }
    CHECK(load_mission(root / "configs/survey.yaml", {}, sonar_keys()).sensors.size() == 4);
}

TEST_SUITE_END();

}  // namespace sonarsim
