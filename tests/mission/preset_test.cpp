#include "mission/preset.h"

#include <filesystem>
#include <fstream>

#include "mission/fixtures.h"
#include "support/approx.h"
#include "support/temporary_folder.h"

namespace sonarsim {

namespace {

/// A mission in `folder` whose only sensor is `sensor`, written in one line.
Mission mission_with(const std::filesystem::path& folder, const std::string& sensor,
                     const std::vector<std::string>& settings = {}) {
    return parse_mission(
        "scene: {file: a.glb, materials: a.csv}\ntrajectory: {file: a.tum}\nsensors:\n  fls: " +
            sensor + "\n",
        "m.yaml", folder, settings, sonar_keys());
}

std::string refusal_of_preset(const std::filesystem::path& folder, const std::string& sensor) {
    try {
        mission_with(folder, sensor);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

}  // namespace

TEST_SUITE_BEGIN("mission");

TEST_CASE("a preset fills in keys, and the mission overrides it key by key") {
    const test::TemporaryFolder folder;
    std::ofstream(folder.path / "p.yaml")
        << "kind: imaging\nmodel: calibrated\nrange_max_m: 30\n"
           "instrument:\n  frequency_hz: 7e5\n  beam: {width_deg: 1.5, side_lobe_db: -20}\n";
    const Mission mission = mission_with(
        folder.path, "{preset: p.yaml, range_max_m: 20, instrument: {beam: {width_deg: 2}}}",
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

TEST_CASE("what is wrong with a preset is said where it stands") {
    const test::TemporaryFolder folder;
    CHECK(refusal_of_preset(folder.path, "{preset: none.yaml}").find("there is no preset") !=
          std::string::npos);
    std::ofstream(folder.path / "typo.yaml") << "kind: imaging\nrange_maxm: 3\n";
    CHECK(refusal_of_preset(folder.path, "{preset: typo.yaml}")
              .find("typo.yaml:2:1: unknown key 'range_maxm' (did you mean 'range_max_m'?)") !=
          std::string::npos);
    std::ofstream(folder.path / "nested.yaml") << "preset: typo.yaml\n";
    CHECK(refusal_of_preset(folder.path, "{preset: nested.yaml}")
              .find("nested.yaml:1:1: a preset cannot name a preset") != std::string::npos);
}

TEST_CASE("each model has its own keys") {
    CHECK(refusal(smallest_mission + "    instrument: {frequency_hz: 1e6}\n")
              .starts_with("m.yaml:6:5: unknown key 'instrument'"));
    CHECK(refusal(smallest_mission + "    model: calibrated\n    noise: {add_sigma: 1}\n")
              .starts_with("m.yaml:7:5: unknown key 'noise'"));
}

TEST_CASE("a fan hears no less than its azimuth") {
    const std::string model = smallest_mission + "    model: calibrated\n    azimuth_deg: 60\n";
    CHECK(parse(model + "    instrument: {beam: {view_azimuth_deg: 60}}\n").sensors.size() == 1);
    CHECK(refusal(model + "    instrument: {beam: {view_azimuth_deg: 59}}\n")
              .find("instrument.beam.view_azimuth_deg must be 0 or at least azimuth_deg") !=
          std::string::npos);
}

TEST_CASE("the speed of sound follows from the water where it is left to it") {
    const Mission mission = parse(
        smallest_mission + "water: {sound_speed_m_s: auto, temperature_c: 25, depth_m: 1000}\n");
    CHECK(mission.water.sound_speed_m_s == test::approx(1550.744).epsilon(1e-6));
}

TEST_SUITE_END();

}  // namespace sonarsim
