#include "checks/image_warnings.h"

#include <doctest/doctest.h>

#include "job/run_job.h"
#include "support/small_mission.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

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
    std::vector<std::string> warnings() {
        assembly = small_assembly(mission, 3);
        return judge();
    }
    std::vector<std::string> judge() const { return image_warnings(mission, assembly, sensors); }

    /// "left" saw nothing.
    void blind_left() {
        sensors[1].dark_pings = sensors[1].pings;
        sensors[1].counts = {};
        sensors[1].brightest = 0.0F;
    }
};

using Warnings = std::vector<std::string>;

}  // namespace

TEST_SUITE("dataset") {
    TEST_CASE("image warnings: none where all is well, or where nothing was rendered") {
        Run run;
        CHECK(run.warnings().empty());
        run.sensors = {SensorSummary{}, SensorSummary{}};
        CHECK(run.warnings().empty());
    }

    TEST_CASE("image warnings: a blind sensor beside a seeing one") {
        Run run;
        run.blind_left();
        CHECK(run.warnings() ==
              Warnings{"sensor 'left' saw no surface in any of its 10 pings: check its mount, the "
                       "trajectory's attitudes, its field of view and range_max_m"});
        run.sensors[1].dark_pings = 7;
        run.sensors[1].brightest = 0.4F;
        CHECK(run.warnings() ==
              Warnings{"sensor 'left' saw no surface in 7 of its 10 pings: check the trajectory "
                       "and the range"});
        run.sensors[1].dark_pings = 1;
        CHECK(run.warnings() ==
              Warnings{"sensor 'left' saw no surface in 1 of its 10 pings: check the trajectory "
                       "and the range"});
        run.sensors[1].dark_pings = 0;
        CHECK(run.warnings().empty());
    }

    TEST_CASE("image warnings: a range band that holds nothing") {
        Run run;
        run.blind_left();
        run.mission.sensors[1].range_min_m = 100.0;
        run.mission.sensors[1].range_max_m = 110.0;
        const Warnings beyond = run.warnings();
        REQUIRE(beyond.size() == 1);
        CHECK(
            beyond[0].starts_with("sensor 'left' saw no surface in any of its 10 pings: all of "
                                  "the scene lies within "));
        CHECK(beyond[0].ends_with(" m, range_min_m is 100: lower it"));

        for (TimedPose& pose : run.assembly.trajectory)
            pose.T_world_vehicle.translation.x() += 1000.0;
        const Warnings away = run.judge();
        REQUIRE(away.size() == 1);
        CHECK(away[0].find("the scene is never nearer than ") != std::string::npos);
        CHECK(
            away[0].ends_with("range_max_m is 110: check the trajectory's coordinates or raise "
                              "range_max_m"));

        run.mission.sensors[1].range_min_m = 2.0;
        run.sensors[1].counts.echoes = run.sensors[1].counts.out_of_range = 640;
        CHECK(run.warnings() ==
              Warnings{"sensor 'left' saw no surface in any of its 10 pings: all of the 640 echoes "
                       "in its field of view lie outside 2 to 110 m: check range_min_m and "
                       "range_max_m"});
    }

    TEST_CASE("image warnings: range noise that pushes echoes out of the range") {
        Run run;
        run.mission.sensors[0].noise.range_lambda_m = 1e6;
        run.sensors[0].counts.out_of_range = 996;
        CHECK(run.warnings() ==
              Warnings{"sensor 'front': 99.6 % of its echoes were dropped outside the range: "
                       "noise.range_lambda_m shifts them by 1e+06 m on average, and the range is "
                       "9.9 m long; lower it"});
        // As many echoes outside the range, but not for the noise.
        run.mission.sensors[0].noise.range_lambda_m = 0.05;
        CHECK(run.warnings().empty());
    }

    TEST_CASE("image warnings: a material as the water") {
        Run run;
        run.assembly = small_assembly(run.mission, 1);
        Material& material = run.assembly.scene.materials[0];
        material.name = "Jelly";
        material.density_kg_m3 = 998.0;
        material.sound_speed_m_s = 1480.0;
        material.reflection = 2.5e-7F;
        CHECK(run.judge() ==
              Warnings{"material 'Jelly' (998 kg/m^3, 1480 m/s) reflects 2.5e-07 of the power in "
                       "this water (997 kg/m^3, 1480 m/s) and is as good as invisible: check the "
                       "materials' CSV and the water block"});
        material.reflection = 1e-4F;
        CHECK(run.judge().empty());
        run.sensors[0].brightest = 0.0F;
        CHECK(run.judge() ==
              Warnings{"sensor 'front' saw surface in 500 bins, and all of its images are black: "
                       "the materials there reflect nothing in this water"});
    }

    TEST_CASE("image warnings: a full scale far above or below what is seen") {
        Run run;
        run.mission.output.full_scale = 1e6;
        const Warnings dark = run.warnings();
        REQUIRE(dark.size() == 2);
        CHECK(dark[0] ==
              "sensor 'front': its brightest pixel is 0.4, grey level 0 of 65535 in images and 0 "
              "of 255 in fans: lower output.full_scale from 1e+06 to about 0.4");
        // 255 sqrt(0.4 / full_scale) = 16 at a full scale of 101.6.
        run.mission.output.full_scale = 101.0;
        CHECK(run.warnings().empty());
        run.mission.output.full_scale = 102.0;
        CHECK(run.warnings().size() == 2);
        run.mission.output.full_scale = 0.1;
        run.sensors[1].clipped_pixels = 77;
        CHECK(run.warnings() == Warnings{"sensor 'left': 77 pixels are above output.full_scale "
                                         "(0.1) and white in the PNG files; the brightest is 0.4"});
    }

    TEST_CASE("image warnings: a sector thinner than a pixel of its fan") {
        Run run;
        run.mission.sensors[0].azimuth_deg = 0.001;
        const Warnings thin = run.warnings();
        REQUIRE(thin.size() == 1);
        CHECK(
            thin[0].starts_with("sensor 'front': its fans show next to nothing, for azimuth_deg "
                                "of 0.001 is 0.00017 m wide at range_max_m and a pixel "));
        run.mission.output.fan = false;
        CHECK(run.warnings().empty());
    }

    TEST_CASE("image warnings: a run counts what they are made from") {
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
