#include "run/checks/measured_error.h"

#include <tbb/task_arena.h>

#include "simulate/assembly/engines.h"
#include "support/small_mission.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

std::vector<std::optional<MeasuredError>> errors_of(const Mission& mission, int threads) {
    const Assembly assembly = small_assembly(mission, 7);
    tbb::task_arena arena(threads);
    return arena.execute(
        [&] { return measure_errors(mission, assembly, *make_engine(mission, assembly)); });
}

}  // namespace

TEST_SUITE_BEGIN("validation");

TEST_CASE("measured errors: the same for any number of threads, and below the goal of the rays") {
    Mission mission = small_mission("unused");
    mission.engine = EngineKind::rays;
    const auto one = errors_of(mission, 1);
    const auto two = errors_of(mission, 2);
    REQUIRE(one.size() == mission.sensors.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
        REQUIRE(one[i]);
        CHECK(one[i]->pings.size() == 3);
        CHECK(json_of(*one[i]) == json_of(*two[i]));
        CHECK(one[i]->worst().without_noise() < mission.accuracy.relative_l1);
        CHECK(one[i]->mean() <= one[i]->worst().relative_l1);
        CHECK(one[i]->worst().noise > 0.0);
    }
    CHECK(error_warnings(mission, one).empty());
}

TEST_CASE("measured errors: a coarse octree is warned of, with the key to change") {
    Mission mission = small_mission("unused");
    mission.sensors.resize(1);
    mission.engine = EngineKind::octree;
    mission.octree.leaf_m = 0.3;
    const std::vector<Warning> warnings = error_warnings(mission, errors_of(mission, 2));
    REQUIRE(warnings.size() == 1);
    CHECK(number_of(warnings[0].code) == "W29");
    CHECK(warnings[0].about == "sensor 'front'");
    CHECK(warnings[0].cure == "use engine: auto");
}

// A cell of 400 cm^2 is larger than the bins. Where only the noise of areas decides which bins hold
// one, fewer do so the more rays the reference has.
TEST_CASE("measured errors: cells larger than bins leave the choice of bins to the surface") {
    Mission mission = small_mission("unused");
    mission.sensors[0].noise.range_lambda_m = 0.01;
    mission.sensors[0].noise.scatterer_m = 0.2;
    mission.sensors[0].range_bins = 480;
    const Assembly assembly = small_assembly(mission, 7);
    const Caster caster(assembly.scene);
    const Sonar& sonar = assembly.sonars[0];
    const Pose pose = sensor_pose(sonar, assembly.trajectory[3].T_world_vehicle, 3);
    const auto scored = [&](std::uint64_t rays) {
        const Reference truth = cast_reference(caster, assembly.scene, sonar, pose,
                                               {.rays_per_bin = 1e9, .rays_max = rays});
        return static_cast<double>(std::ranges::count(truth.scored, 1));
    };
    const double few = scored(200'000);
    CHECK(few > 200.0);
    CHECK(scored(2'000'000) == test::approx(few).epsilon(0.02));
}

TEST_CASE("measured errors: what the noise of the reference explains is no reason to warn") {
    Mission mission = small_mission("unused");
    mission.engine = EngineKind::automatic;
    std::vector<std::optional<MeasuredError>> errors(mission.sensors.size());
    errors[0] = MeasuredError{{{0, 0.05, 0.03}, {4, 0.01, 0.0}}};
    CHECK(errors[0]->mean() == test::approx(0.03));
    CHECK(errors[0]->worst().pose == 0);
    CHECK(error_warnings(mission, errors).empty());
    errors[0]->pings[1].relative_l1 = 0.045;
    const std::vector<Warning> warnings = error_warnings(mission, errors);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].what.find("at pose 4") != std::string::npos);
    CHECK(warnings[0].cure == "lower accuracy.relative_l1 to 0.02");
}

TEST_SUITE_END();
