#include "mission/fixtures.h"

namespace {

const std::string files = "scene: {file: a, materials: b}\ntrajectory: {file: c}\n";
const std::string one_sensor = "scene: {file: a, materials: b}\nsensors: {s: {kind: imaging}}\n";

std::string particles(const std::string& model) {
    return "}\ntrajectory: {file: a.tum}\nsensors:\n  fls:\n    kind: imaging\n    model: " +
           model + "\n";
}

}  // namespace

TEST_CASE("an unknown key is refused with the key that is near, or with all that are known") {
    check_refused(
        smallest_mission,
        {{"    azimut_deg: 60\n", "6:5: unknown key 'azimut_deg' (did you mean 'azimuth_deg'?)"},
         {"    noise:\n      add_sigm: 0.1\n",
          "7:7: unknown key 'add_sigm' (did you mean 'add_sigma'?)"},
         {"<<: {seed: 1}\n",
          "6:1: unknown key '<<'; known here: name, seed, water, scene, trajectory, vehicle, "
          "sensors, accuracy, engine, octree_leaf_m, classes, labels, output, variants, vary"},
         {"    instrument: {frequency_hz: 1e6}\n",
          "6:5: unknown key 'instrument'; it needs model: calibrated"},
         {"    model: calibrated\n    noise: {add_sigma: 1}\n",
          "7:5: unknown key 'noise'; it needs model: paper"}});
    // Long and unprintable keys do not flood the terminal.
    const std::string message =
        refusal(smallest_mission + "? \"a\\e" + std::string(900, 'b') + "\"\n: 1\n");
    CHECK(message.starts_with("m.yaml:6:3: unknown key 'a?bbb"));
    CHECK(message.find("bbb...'; known here: name, seed") != std::string::npos);
}

TEST_CASE("a required key that is missing or misspelt, and sections that are none") {
    check_refused(
        "", {
                {"seed: 1\n", "1:1: 'mission' lacks the key 'scene'"},
                {"scene: {file: a}\n", "1:8: 'scene' lacks the key 'materials'"},
                {"scene: {file: a, materials: b}\n", "1:1: 'mission' lacks the key 'trajectory'"},
                {files + "sensors: {}\n", "3:10: 'sensors' must not be empty"},
                {files + "sensors: {x: {every: 2}}\n", "3:14: 'x' lacks the key 'kind'"},
                {"scene: {file: '', materials: b}\n", "1:15: 'file' must not be empty"},
                {"scene: {file: \"a\\0b\", materials: b}\n",
                 "1:15: 'file' must not hold control characters"},
                {"scene: {file: [a], materials: b}\n", "1:15: 'file' must be text, not a list"},
                {"", "1:1: 'mission' must be a section of keys, not nothing"},
                {"hello\n", "1:1: 'mission' must be a section of keys, not 'hello'"},
            });
    check_refused(
        smallest_mission,
        {{"    noise:\n", "6:5: 'noise' must be a section of keys, not nothing"},
         {"seed:\n", "6:1: 'seed' must be a whole number from 0 to 2^64 - 1, not nothing"},
         {"name: ~\n", "6:7: 'name' must be text, not nothing"}});
}

TEST_CASE("kinds of sonars, engines and places") {
    const std::string known = "imaging, profiling, sidescan, echosounder, scanning";
    check_refused(
        files + "sensors: {x: {kind: ",
        {{"imagin", "3:21: unknown kind 'imagin' (did you mean 'imaging'?); known: " + known},
         {"[imaging]", "3:21: 'kind' must be one of: " + known + ", not a list"},
         {"echosounder, elevation_deg: 20",
          "3:34: unknown key 'elevation_deg'; this kind of sonar has none, leave it out"},
         {"sidescan, noise: {range_lambda_m: 0.1}",
          "3:38: a side-scan sonar has no range noise: range_lambda_m must be 0"},
         {"sidescan, moves_in_ping: true",
          "3:46: moves_in_ping of a side-scan, echosounder or scanning sonar needs model: "
          "calibrated; the paper's beams have no pattern that turns during a ping"}},
        "}}\n");
    check_refused(
        smallest_mission,
        {{"engine: octre\n",
          "6:9: unknown engine 'octre' (did you mean 'octree'?); known: auto, rays, octree, "
          "strips"},
         {"engine: slices\n", "6:9: unknown engine 'slices'; known: auto, rays, octree, strips"},
         {"octree_leaf_m: nan\n", "6:16: 'octree_leaf_m' must be a finite number, not 'nan'"},
         {"    shutter: {groups: 2}\n",
          "6:14: shutter.groups needs moves_in_ping: true: a sonar at rest during a ping "
          "has all beams from one pose"}});
    check_refused(
        "scene: {materials: a.csv, objects: [{",
        {{"file: a, scale: 0", "1:54: 'scale' must be at least 1e-06, not '0'"},
         {"file: a, place: on_botom",
          "1:54: unknown place 'on_botom' (did you mean 'on_bottom'?); known: free, on_bottom"},
         {"file: a, units: inch", "1:54: unknown units 'inch'; known: m, mm, cm, km, in, ft"},
         {"file: a, exclude: Light",
          "1:47: unknown key 'exclude'; known here: name, file, class, position_m, rpy_deg, scale, "
          "material, units, up, place, bury_m, align, trajectory"}},
        "}]}\ntrajectory: {file: a}\nsensors: {x: {kind: imaging}}\n");
}

TEST_CASE("names of sensors are folder names, that of a mission stays in its folder") {
    const std::string no_name = "' must be 1 to 64 letters, digits, '_' or '-'";
    const std::string taken = "' is that of a file or folder of the dataset; take another";
    std::vector<Refused> cases{{"''", "3:11: the name '" + no_name}};
    for (const std::string& name : {std::string("a.b"), std::string("../x"), std::string("a b"),
                                    std::string("ä"), std::string(65, 'a')})
        cases.push_back({name, "3:11: the name " + in_quotes(name) + no_name.substr(1)});
    for (const std::string name : {"SHA256SUMS", "seabed"})
        cases.push_back({name, "3:11: the name '" + name + taken});
    check_refused(files + "sensors: {", cases, ": {kind: imaging}}\n");
    for (const char* name : {"..", ".", "a/b", "/tmp/x", "SHA256SUMS"}) {
        CHECK(refusal(smallest_mission + "name: " + name + "\n") ==
              "m.yaml:6:7: 'name' names a folder: at most 200 bytes, without '/', not SHA256SUMS");
    }
}

TEST_CASE("a value outside its range is refused at its place") {
    check_refused(
        smallest_mission,
        {{"    azimuth_deg: 360.1\n", "6:18: 'azimuth_deg' must be at most 360, not '360.1'"},
         {"    azimuth_bins: 4294967297\n",
          "6:19: 'azimuth_bins' must be at most 8192, not '4294967297'"},
         {"    noise: {add_sigma: -1}\n", "6:24: 'add_sigma' must be at least 0, not '-1'"},
         {"output: {full_scale: 0}\n", "6:22: 'full_scale' must be above 0, not '0'"}});
    // The edges themselves are in.
    CHECK(refusal(smallest_mission +
                  "    azimuth_deg: 360\n    elevation_deg: 180\n    range_min_m: 0\n"
                  "    range_bins: 8192\n    azimuth_bins: 8192\n    every: 1\n"
                  "accuracy: {relative_l1: 0.5}\n") == "");
}

TEST_CASE("every fault is reported at its place") {
    const auto faults = [](const std::string& text) { return fault_of([&] { parse(text); }); };
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

TEST_CASE("a trajectory has one form, with keys and ranges of its own") {
    const std::string points = "{waypoints: [{position_m: [0,0,0]}, {position_m: [1,0,0]}], ";
    const std::string lines = "{lawnmower: {area_min_m: [0, 0], area_max_m: [9, 9]";
    check_refused(
        one_sensor + "trajectory: ",
        {{"{}", "3:13: 'trajectory' needs one of the keys: file, waypoints, lawnmower, look_at"},
         {"{waypoint: []}",
          "3:13: 'trajectory' needs one of the keys: file, waypoints, lawnmower, look_at (did you "
          "mean "
          "'waypoints'?)"},
         {"{file: a, lawnmower: {}}",
          "3:23: 'trajectory' takes one of the keys: file, waypoints, lawnmower, look_at; here are "
          "file, "
          "lawnmower"},
         {"{file: a, speed_m_s: 1}", "3:23: unknown key 'speed_m_s'; known here: file, rate_hz"},
         {"{file: a, rate_hz: -1}", "3:32: 'rate_hz' must be at least 0, not '-1'"},
         {points + "rate_hz: 0}", "3:82: 'rate_hz' must be above 0, not '0'"},
         {"{waypoints: [{position_m: [0,0]}]}",
          "3:25: 'waypoints' must have at least 2 items, not 1"},
         {"{waypoints: [{position_m: [0,0]}, {}]}",
          "3:39: 'position_m' must be a list of 3 numbers, not of 2"},
         {"{waypoints: [{}, {}]}", "3:26: 'waypoints.0' lacks the key 'position_m'"},
         {"{waypoints: [1, 2]}", "3:26: 'waypoints.0' must be a section of keys, not '1'"},
         {"{lawnmower: {area_min_m: [0, 9], area_max_m: [9, 9], z_m: 0}}",
          "3:58: area_min_m must be below area_max_m in x and in y (area_min_m is [0, 9], "
          "area_max_m is [9, 9])"}},
        "\n");
    for (const std::string& sound :
         {std::string("{file: a, rate_hz: 0}"), points + "rate_hz: 5}", lines + ", z_m: 1}}"})
        CHECK(refusal(one_sensor + "trajectory: " + sound + "\n") == "");
}

TEST_CASE("checks across keys stand at the key that was written last") {
    check_refused(
        smallest_mission,
        {{"    range_max_m: 5\n    range_min_m: 5\n",
          "7:18: range_min_m must be below range_max_m (range_min_m is 5, range_max_m is 5)"},
         // Only range_max_m is written; the default of range_min_m is 0.1.
         {"    range_max_m: 0.05\n",
          "6:18: range_min_m must be below range_max_m (range_min_m is 0.1, range_max_m is 0.05)"},
         // 1e-4 m over 512 bins is 2e-7 m a bin.
         {"    range_min_m: 1\n    range_max_m: 1.0001\n",
          "7:18: range bins must be wider than a micrometre (range_min_m is 1, range_max_m is "
          "1.0001, range_bins is 512)"},
         {"    model: calibrated\n    azimuth_deg: 60\n    instrument: {beam: {view_azimuth_deg: "
          "59}}\n",
          "8:17: instrument.beam.view_azimuth_deg must be 0 or at least azimuth_deg (azimuth_deg "
          "is "
          "60)"}});
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

TEST_CASE("labels and classes, and keys that are gone with what to do instead") {
    const std::string known =
        "instance, share, second, class, material, elevation, height, shadow, multipath, clean, "
        "direct_only, multipath_only, objects, fan";
    check_refused(
        smallest_mission,
        {{"output: {labels: maybe}\n",
          "6:18: 'labels' must be true, false or a list of: " + known + ", not 'maybe'"},
         {"output: {labels: [shadows]}\n",
          "6:19: unknown labels 'shadows' (did you mean 'shadow'?); known: " + known},
         {"output: {labels: [clean, clean]}\n", "6:26: 'clean' stands twice in 'labels'"},
         {"classes:\n  - {nodes: a}\n",
          "7:5: a rule for classes needs the keys 'nodes' or 'materials', and 'class'"},
         {"classes: {}\n", "6:10: 'classes' must be a list, not a section of keys"},
         {"output: {labels: [instance, coco]}\n", "6:29: unknown labels 'coco'; known: " + known}});
}

TEST_CASE("particles: what is refused, and where") {
    const std::string before =
        "scene:\n  file: a.glb\n  materials: a.csv\n  particles:\n"
        "    - {name: p, position_m: [1, 2, 3], ";
    const std::string points = "target_strength_db: -40, count: 3";
    const std::string one =
        "targets need one of target_strength_db, length_m and radius_m "
        "(target_strength_db is not given, length_m is ";
    check_refused(
        before,
        {{"count: 3", "5:7: " + one + "[0, 0], radius_m is [0, 0])"},
         {"radius_m: 0.001, length_m: 0.2, count: 3",
          "5:67: " + one + "[0.2, 0.2], radius_m is [0.001, 0.001])"},
         {"length_m: [0, 0.2], count: 3",
          "5:50: length_m and radius_m must be above 0 (length_m is [0, 0.2], radius_m is [0, 0])"},
         {"target_strength_db: -40", "5:7: 'count' must be above 0 (count is [0, 0])"},
         {points + ", rise_m_s: 1",
          "5:85: rise_m_s is for bubbles, which have a radius_m; others have a drift_m_s (rise_m_s "
          "is 1)"}},
        particles("calibrated"));
    check_refused(before,
                  {{points,
                    "8:3: scene.particles and scene.water_surface.scatters need model: calibrated "
                    "on all sensors"}},
                  particles("paper"));
    CHECK(refusal(before + points + particles("calibrated")).empty());
}
