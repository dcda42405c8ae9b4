#include "simulate/assembly/brightness.h"

#include "simulate/assembly/poses.h"
#include "support/calibrated.h"
#include "support/small_mission.h"

namespace {

std::vector<double> scales_of(const Mission& mission) {
    return small_assembly(mission, 9).full_scales;
}

}  // namespace

TEST_CASE("spread pings: in the middle of equal parts, on poses with a ping") {
    using Poses = std::vector<std::uint32_t>;
    CHECK(sample_pings(12, 1, 3) == Poses{2, 6, 10});
    // Poses 0, 3, 6 and 9 have pings: the halves are {0, 3} and {6, 9}.
    CHECK(sample_pings(12, 3, 2) == Poses{3, 9});
    CHECK(sample_pings(2, 1, 5) == Poses{0, 1});
    CHECK(sample_pings(0, 1, 5).empty());
}

TEST_CASE("brightness: auto has two digits and grows with the gain") {
    Mission mission = small_mission("out");
    mission.output.full_scale = 0.0;
    for (SonarConfig& sensor : mission.sensors)
        sensor.noise = {.gain = 0.5};
    const std::vector<double> half = scales_of(mission);
    mission.sensors[0].noise.gain = 50.0;
    const std::vector<double> more = scales_of(mission);
    // Without noise an intensity is proportional to the gain; a power of ten moves no digit.
    CHECK(more[0] / half[0] == approx(100.0));
    CHECK(more[1] == half[1]);
    mission.sensors[1].range_max_m = 0.11;  // the walls are farther away
    CHECK(scales_of(mission)[1] == 1.0);
    // No echo of a surface with reflection below 1 is above the gain.
    for (const double scale : half) {
        CHECK(scale > 0.0);
        CHECK(scale <= 0.5);
        const double digits = scale * std::pow(10.0, 1.0 - std::floor(std::log10(scale)));
        CHECK(std::fabs(digits - std::round(digits)) < 1e-9);
    }
}

TEST_CASE("brightness: water does not decide what is white in a profile") {
    // Most bins of the second sonar lie before and behind the tank's walls, in scattering water.
    Mission mission = small_mission("out");
    mission.output.full_scale = 0.0;
    SonarConfig& clear = mission.sensors[0];
    clear = calibrated(clear, 9e5);
    set_range(clear, clear.range_min_m, 30.0, 144);
    clear.elevation_deg = 4.0;
    mission.sensors[1] = clear;
    mission.sensors[1].name = "coastal";
    mission.sensors[1].instrument.usual_water = WaterContent::coastal;
    const std::vector<double> scales = scales_of(mission);
    CHECK(scales[1] / scales[0] == approx(1.0).epsilon(0.1));
}
