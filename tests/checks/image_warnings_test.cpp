#include "run/checks/find_warnings.h"
#include "simulate/sonar/sonar.h"
#include "support/small_mission.h"

namespace {

using Sentences = std::vector<std::string>;

Sentences sentences(const std::vector<Warning>& warnings) {
    Sentences out;
    for (const Warning& warning : warnings)
        out.push_back(sentence(warning));
    return out;
}

/// The tank with two sonars, "front" and "left", and ten pings of each that saw enough.
struct Run {
    Mission mission = small_mission("out");
    Assembly assembly;
    std::vector<SensorSummary> sensors;

    Run() {
        SensorSummary well;
        well.pings = 10;
        well.counts.samples = 1000;
        well.counts.echoes = 1000;
        well.counts.occupied_bins = 500;
        well.brightest = 0.4F;
        sensors = {well, well};
    }

    /// Sonars as the mission now has them.
    Sentences warnings() {
        assembly = small_assembly(mission, 3);
        return sentences(image_warnings(mission, assembly, sensors));
    }
};

SonarConfig line_array() {
    SonarConfig config = default_sonar(SonarKind::imaging);
    config.name = "fls";
    config.model = ModelKind::calibrated;
    config.azimuth_deg = 30.0;
    config.azimuth_bins = 64;
    config.range_bins = 128;
    return config;
}

}  // namespace

TEST_CASE_FIXTURE(Run, "image warnings: none where all is well, or where nothing was rendered") {
    CHECK(warnings().empty());
    sensors = {SensorSummary{}, SensorSummary{}};
    CHECK(warnings().empty());
}

TEST_CASE_FIXTURE(Run, "image warnings: a blind sensor next to a seeing one") {
    for (const std::uint64_t pings : {10U, 1U}) {
        sensors[1].dark_pings = pings;
        sensors[1].brightest = pings == 10 ? 0.0F : 0.4F;
        CHECK(warnings() ==
              Sentences{fmt::format("W12 sensor 'left': {} of 10 pings are blind: they see no "
                                    "surface within the range; sonarsim validate prints the reason "
                                    "as W13 to W17; the trajectory may leave the scene",
                                    pings)});
    }
}

TEST_CASE_FIXTURE(Run, "image warnings: a full scale far above or below what is seen") {
    mission.output.full_scale = 1e6;
    const Sentences dark = warnings();
    REQUIRE(dark.size() == 2);
    CHECK(dark[0] ==
          "W20 sensor 'front': its brightest pixel is 0.4, which is grey level 0 of 255 in fans; "
          "lower output.full_scale (1e+06)");
    // 255 sqrt(0.4 / full_scale) = 16 at a full scale of 101.6.
    mission.output.full_scale = 101.0;
    CHECK(warnings().empty());
    mission.output.full_scale = 102.0;
    CHECK(warnings().size() == 2);
    // 5 % of the 500 occupied bins are 25.
    mission.output.full_scale = 0.1;
    sensors[1].clipped_pixels = 25;
    CHECK(warnings().empty());
    sensors[1].clipped_pixels = 26;
    CHECK(
        warnings() ==
        Sentences{"W19 sensor 'left': 5.2 % of its occupied bins are above output.full_scale (0.1) "
                  "and white in pictures; the brightest is 0.4; raise output.full_scale"});
}

TEST_CASE_FIXTURE(Run, "warnings before pings: a material as the water") {
    assembly = small_assembly(mission, 1);
    Material& material = assembly.scene.materials[0];
    material.name = "Jelly";
    material.density_kg_m3 = 998.0;
    material.sound_speed_m_s = 1480.0;
    const auto warned = [&] {
        return std::ranges::count(
            sentences(warnings_before_pings(mission, assembly)),
            "W09 material 'Jelly': it (998 kg/m^3, 1480 m/s) reflects 2.5e-07 of the power in "
            "this water (997 kg/m^3, 1480 m/s): its impedance is that of the water; check the "
            "materials' CSV and the water block");
    };
    material.reflection = 2.5e-7F;
    CHECK(warned() == 1);
    material.reflection = 1e-4F;
    CHECK(warned() == 0);
}

TEST_CASE("memory: the key that would bring it down is what takes most") {
    SonarConfig config = line_array();
    CHECK(ping_memory(make_sonar(config, {})).key == "range_bins");
    config.azimuth_bins = 512;
    CHECK(ping_memory(make_sonar(config, {})).key == "azimuth_bins");
    config = line_array();
    config.instrument.beam.view_azimuth_deg = 180.0;
    CHECK(ping_memory(make_sonar(config, {})).key == "instrument.beam.view_azimuth_deg");
}

TEST_CASE("memory: guard beams narrower than the array resolves take no more") {
    SonarConfig config = line_array();
    config.azimuth_deg = 1.0;
    config.azimuth_bins = 512;
    config.instrument.beam.view_azimuth_deg = 179.0;
    // The array resolves a degree with 2.7 columns: 2 x 237 beams, not 91,136.
    const Sonar sonar = make_sonar(config, {});
    CHECK(sonar.settings.view.guards.count > 200);
    CHECK(sonar.settings.view.guards.count < 280);
    CHECK(ping_memory(sonar).bytes < 1e8);
}

TEST_CASE("memory: W26 where pings on all threads have no room") {
    const std::vector<Sonar> sonars{make_sonar(line_array(), {})};
    const double one = ping_memory(sonars[0]).bytes;
    CHECK(memory_warnings(sonars, 4, 4.0 * one).empty());
    CHECK(memory_warnings(sonars, 1, one).empty());
    const std::vector<Warning> found = memory_warnings(sonars, 4, 3.9 * one);
    REQUIRE(found.size() == 1);
    CHECK(sentence(found[0]).starts_with("W26 sensor 'fls': a ping takes about"));
    CHECK(found[0].cure.starts_with("lower range_bins"));
    CHECK(!memory_warnings(sonars, 1, 0.9 * one).empty());
}
