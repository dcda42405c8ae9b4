#include <string>

#include "mission/fixtures.h"

namespace sonarsim {

TEST_SUITE_BEGIN("mission");

TEST_CASE("a value outside its range is refused at its place") {
    struct Case {
        const char* line;
        const char* message;
    };
    // Sensor keys have four blanks; "    azimuth_deg: 0" begins its value in column 18.
    for (const Case& one : {
             Case{"    azimuth_deg: 0", "18: 'azimuth_deg' must be at least 0.001, not '0'"},
             {"    azimuth_deg: 360.1", "18: 'azimuth_deg' must be at most 360, not '360.1'"},
             {"    azimuth_bins: 4294967297",
              "19: 'azimuth_bins' must be at most 8192, not '4294967297'"},
             {"    every: 0", "12: 'every' must be at least 1, not '0'"},
             {"    noise: {add_sigma: -1}", "24: 'add_sigma' must be at least 0, not '-1'"},
             {"    mount: {translation_m: [0, 0, 2e9]}",
              "35: 'translation_m' must be at most 1e+08, not '2e9'"},
             {"output: {full_scale: 0}", "22: 'full_scale' must be above 0, not '0'"},
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

TEST_CASE("every fault is reported at its place") {
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
    // A section of unknown kind is not checked further; the other sections are.
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
          "m.yaml:3:58: area_min_m must be below area_max_m in x and in y "
          "(area_min_m is [0, 9], area_max_m is [9, 9])");
}

TEST_CASE("checks across keys stand at the key that was written last") {
    CHECK(
        refusal(smallest_mission + "    range_max_m: 5\n    range_min_m: 5\n") ==
        "m.yaml:7:18: range_min_m must be below range_max_m (range_min_m is 5, range_max_m is 5)");
    // Only range_max_m is written; the default of range_min_m is 0.1.
    CHECK(refusal(smallest_mission + "    range_max_m: 0.05\n") ==
          "m.yaml:6:18: range_min_m must be below range_max_m (range_min_m is 0.1, range_max_m is "
          "0.05)");
    CHECK(refusal(smallest_mission + "    range_min_m: 20\n", {"sensors.fls.range_max_m=15"}) ==
          "--set sensors.fls.range_max_m=15: range_min_m must be below range_max_m (range_min_m is "
          "20, range_max_m is 15)");
    // 1e-4 m over 512 bins is 2e-7 m a bin.
    CHECK(refusal(smallest_mission + "    range_min_m: 1\n    range_max_m: 1.0001\n") ==
          "m.yaml:7:18: range bins must be wider than a micrometre (range_min_m is 1, range_max_m "
          "is 1.0001, range_bins is 512)");
    // A side-scan's waterfall has a column per bin from nadir on: here of a centimetre.
    const auto from = [](const std::string& range_min_m, const std::string& range_max_m) {
        return refusal(smallest_mission + "    range_bins: 100\n    range_min_m: " + range_min_m +
                           "\n    range_max_m: " + range_max_m + "\n",
                       {"sensors.fls.kind=sidescan"});
    };
    CHECK(from("655", "656") == "");
    CHECK(from("656", "657") ==
          "m.yaml:8:18: a side-scan's waterfall begins at nadir: range_min_m "
          "must be at most 65536 range bins (range_min_m is 656, range_max_m is 657, range_bins is "
          "100)");
}

TEST_SUITE_END();

}  // namespace sonarsim
