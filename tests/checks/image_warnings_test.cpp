#include <doctest/doctest.h>

#include "checks/find_warnings.h"
#include "job/run_job.h"
#include "support/small_mission.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

using Sentences = std::vector<std::string>;

Sentences sentences(const std::vector<Warning>& warnings) {
    Sentences out;
    for (const Warning& warning : warnings)
        out.push_back(sentence(warning));
    return out;
}

/// The warnings without a ping, but for W01: the tank's materials have no real speed of sound.
std::vector<Warning> before_pings(const Mission& mission, const Assembly& assembly) {
    std::vector<Warning> out = warnings_before_pings(mission, assembly);
    std::erase_if(out, [](const Warning& w) { return w.code == WarningCode::reading; });
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

    /// "left" saw nothing.
    void blind_left() {
        sensors[1].dark_pings = sensors[1].pings;
        sensors[1].counts = {};
        sensors[1].brightest = 0.0F;
    }
};

}  // namespace

TEST_SUITE("checks") {
    TEST_CASE("image warnings: none where all is well, or where nothing was rendered") {
        Run run;
        CHECK(run.warnings().empty());
        run.sensors = {SensorSummary{}, SensorSummary{}};
        CHECK(run.warnings().empty());
    }

    TEST_CASE("image warnings: a blind sensor next to a seeing one") {
        Run run;
        run.blind_left();
        CHECK(run.warnings() ==
              Sentences{
                  "W12 sensor 'left': 10 of 10 pings are blind: they see no surface within the "
                  "range; sonarsim validate prints the reason as W13 to W17; the trajectory may "
                  "leave the scene"});
        run.sensors[1].brightest = 0.4F;
        for (const std::uint64_t pings : {7U, 1U}) {
            run.sensors[1].dark_pings = pings;
            const Sentences some = run.warnings();
            REQUIRE(some.size() == 1);
            CHECK(some[0].starts_with(fmt::format("W12 sensor 'left': {} of 10 pings", pings)));
        }
        run.sensors[1].dark_pings = 0;
        CHECK(run.warnings().empty());
    }

    TEST_CASE("image warnings: a full scale far above or below what is seen") {
        Run run;
        run.mission.output.full_scale = 1e6;
        const Sentences dark = run.warnings();
        REQUIRE(dark.size() == 2);
        CHECK(
            dark[0] ==
            "W20 sensor 'front': its brightest pixel is 0.4, which is grey level 0 of 255 in fans; "
            "lower output.full_scale (1e+06)");
        // 255 sqrt(0.4 / full_scale) = 16 at a full scale of 101.6.
        run.mission.output.full_scale = 101.0;
        CHECK(run.warnings().empty());
        run.mission.output.full_scale = 102.0;
        CHECK(run.warnings().size() == 2);
        // 5 % of the 500 occupied bins are 25.
        run.mission.output.full_scale = 0.1;
        run.sensors[1].clipped_pixels = 25;
        CHECK(run.warnings().empty());
        run.sensors[1].clipped_pixels = 26;
        CHECK(run.warnings() ==
              Sentences{
                  "W19 sensor 'left': 5.2 % of its occupied bins are above output.full_scale (0.1) "
                  "and white in pictures; the brightest is 0.4; raise output.full_scale"});
    }

    TEST_CASE("warnings before pings: a material as the water") {
        Run run;
        run.assembly = small_assembly(run.mission, 1);
        Material& material = run.assembly.scene.materials[0];
        material.name = "Jelly";
        material.density_kg_m3 = 998.0;
        material.sound_speed_m_s = 1480.0;
        material.reflection = 2.5e-7F;
        CHECK(sentences(before_pings(run.mission, run.assembly)) ==
              Sentences{"W09 material 'Jelly': it (998 kg/m^3, 1480 m/s) reflects 2.5e-07 of the "
                        "power in this water (997 kg/m^3, 1480 m/s): its impedance is that of the "
                        "water; check the materials' CSV and the water block"});
        material.reflection = 1e-4F;
        CHECK(before_pings(run.mission, run.assembly).empty());
    }

    TEST_CASE("warnings: every row of the table has its number and a limit") {
        for (const WarningText& row : warning_table()) {
            const std::string number = number_of(row.code);
            CAPTURE(number);
            CHECK(row.what != std::string());
            CHECK(row.limit != std::string());
        }
        // In the docs "N" stands for a number and "..." for a text.
        CHECK(warning_table_markdown().find("| W11 | in N of N pings it is inside '...' | move "
                                            "the trajectory or the object |") != std::string::npos);
    }

    TEST_CASE("image warnings: a run counts blind pings") {
        Mission mission = small_mission("out");
        mission.sensors[1].range_min_m = 100.0;
        mission.sensors[1].range_max_m = 101.0;
        const Assembly assembly = small_assembly(mission, 4);  // "left" pings at poses 0 and 3
        const RenderSummary summary = run_job(mission, assembly, {.files = false}, {}, {false});
        REQUIRE(summary.sensors.size() == 2);
        CHECK(summary.sensors[0].pings == 4);
        CHECK(summary.sensors[0].dark_pings == 0);
        CHECK(summary.sensors[0].brightest > 0.0F);
        CHECK(summary.sensors[1].pings == 2);
        CHECK(summary.sensors[1].dark_pings == 2);
        CHECK(summary.sensors[0].counts.samples + summary.sensors[1].counts.samples ==
              summary.counts.samples);
        CHECK(image_warnings(mission, assembly, summary.sensors).size() == 1);
    }
}
