#include "run/checks/measured_error.h"

#include <tbb/task_arena.h>

#include "support/calibrated.h"
#include "support/lattices.h"
#include "support/small_mission.h"

namespace {

/// A mission of the first sonar alone.
Mission one_sensor() {
    Mission mission = small_mission("unused");
    mission.sensors.resize(1);
    return mission;
}

std::vector<std::optional<MeasuredError>> errors_of(const Mission& mission, int threads) {
    const Assembly assembly = small_assembly(mission, 7);
    tbb::task_arena arena(threads);
    return arena.execute(
        [&] { return measure_errors(mission, assembly, *make_engine(mission, assembly)); });
}

/// The reference of the first sonar at the fourth pose, by this many rays.
Reference reference_at_3(const Mission& mission, std::uint64_t rays) {
    const Assembly assembly = small_assembly(mission, 7);
    const Sonar& sonar = assembly.sonars[0];
    return cast_reference(Caster(assembly.scene), assembly.scene, sonar,
                          sensor_pose(sonar, assembly.trajectory[3].T_world_vehicle, 3),
                          {.rays_per_bin = 1e9, .rays_max = rays});
}

}  // namespace

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
        REQUIRE(one[i]->worst());
        CHECK(*one[i]->worst()->relative_l1 < mission.accuracy.relative_l1);
        CHECK(*one[i]->mean() <= *one[i]->worst()->relative_l1);
        CHECK(one[i]->worst()->noise < 0.5 * mission.accuracy.relative_l1);
    }
    CHECK(error_warnings(mission, one).empty());
}

TEST_CASE("measured errors: a coarse octree is warned of, with the key to change") {
    Mission mission = one_sensor();
    mission.engine = EngineKind::octree;
    mission.octree_leaf_m = 0.3;
    const std::vector<Warning> warnings = error_warnings(mission, errors_of(mission, 2));
    REQUIRE(warnings.size() == 1);
    CHECK(number_of(warnings[0].code) == "W29");
    CHECK(warnings[0].about == "sensor 'front'");
    CHECK(warnings[0].cure == "use engine: auto");
}

// Bins are 1 mm deep and a few millimetres wide: smaller than 1 cm^2.
TEST_CASE("measured errors: most bins of a fine sonar that hold surface count") {
    Mission mission = one_sensor();
    auto& fine = mission.sensors[0];
    fine.azimuth_deg = 4.0;
    fine.azimuth_bins = 40;
    fine.range_bins = static_cast<int>((fine.range_max_m - fine.range_min_m) / 0.001);
    const Reference truth = reference_at_3(mission, 1'000'000);
    const auto occupied =
        std::ranges::count_if(truth.intensity, [](float value) { return value > 0.0F; });
    CHECK(occupied > 1000);
    const auto scored = std::ranges::count(truth.scored, 1);
    CAPTURE_ALL(occupied, scored);
    CHECK(10 * scored > 8 * occupied);
}

TEST_CASE("measured errors: a finer image stands in for a reference with too much noise") {
    const Lattice lattice = draw_lattice(1000);
    Mission mission = one_sensor();
    SonarConfig& fine = mission.sensors[0];
    fine = bare_sonar(lattice.sonar, 1e6);
    fine.range_bins = 1024;
    fine.azimuth_bins = 512;
    mission.accuracy.relative_l1 = 0.02;
    Assembly assembly = small_assembly(mission, 1);
    assembly.scene = lattice.scene;
    assembly.trajectory[0].T_world_vehicle = {};
    const Sonar& sonar = assembly.sonars[0];
    const auto engine = make_engine(mission, assembly);
    const auto errors = measure_errors(mission, assembly, *engine)[0];
    REQUIRE(errors);
    const PingError& ping = errors->pings.at(0);
    CAPTURE_ALL(ping.noise, *ping.relative_l1);
    REQUIRE(ping.by_finer_image);
    CHECK(json_of(*errors)["pings"][0]["by"] == "finer image");
    Sonar finest = sonar;
    finest.settings.view.relative_l1 /= 32.0;
    const auto image = [&](const Sonar& of) {
        return direct_image(of, assembly.scene, *engine, {}).intensity;
    };
    const double truth = image_error(image(sonar), image(finest)).relative_l1;
    CAPTURE_ALL(truth);
    CHECK(*ping.relative_l1 > truth / 1.5);
    CHECK(*ping.relative_l1 < 1.5 * truth);
}

// The truth has 32 times as fine a goal. A plate of 0.3 m before the wall adds narrow bounces.
TEST_CASE("measured errors: multipath counts") {
    Mission mission = one_sensor();
    mission.sensors[0].multipath.method = MultipathMethod::exact;
    for (const double goal : {0.1, 0.03}) {
        mission.accuracy.relative_l1 = goal;
        Assembly assembly = small_assembly(mission, 7);
        add_quad(assembly.scene, {-1.0F, -0.2F, 1.4F}, {-0.8F, 0.1F, 1.4F}, {-0.8F, 0.1F, 1.7F},
                 {-1.0F, -0.2F, 1.7F}, 0);
        const auto engine = make_engine(mission, assembly);
        const MeasuredError measured = *measure_errors(mission, assembly, *engine)[0];
        double truth = 0.0;
        for (const PingError& ping : measured.pings) {
            Sonar sonar = assembly.sonars[0];
            const auto image = [&] {
                constexpr Terms terms{.water = false, .random = 0};
                return render_ping(sonar, assembly.scene, *engine,
                                   assembly.trajectory[ping.pose].T_world_vehicle, {}, terms)
                    .intensity;
            };
            const std::vector<float> coarse = image();
            sonar.settings.view.relative_l1 = goal / 32.0;
            truth += image_error(coarse, image()).relative_l1 / 3.0;
        }
        CAPTURE_ALL(goal, *measured.mean(), truth);
        CHECK(*measured.mean() > truth / 1.5);
        CHECK(*measured.mean() < 1.5 * truth);
        assembly.sonars[0].settings.multipath.on = false;
        CHECK(*measured.mean() > 2.0 * *measure_errors(mission, assembly, *engine)[0]->mean());
    }
}

// A cell of 400 cm^2 is larger than the bins. Where only the noise of areas decides which bins hold
// one, fewer do so the more rays the reference has.
TEST_CASE("measured errors: cells larger than bins leave the choice of bins to the surface") {
    Mission mission = small_mission("unused");
    mission.sensors[0].noise.range_lambda_m = 0.01;
    mission.sensors[0].noise.scatterer_m = 0.2;
    mission.sensors[0].range_bins = 480;
    const auto scored = [&](std::uint64_t rays) -> double {
        return total(reference_at_3(mission, rays).scored);
    };
    const double few = scored(200'000);
    CHECK(few > 200.0);
    CHECK(scored(2'000'000) == approx(few).epsilon(0.02));
}

TEST_CASE("measured errors: only what is measured is warned of, in digits as people write them") {
    Mission mission = small_mission("unused");
    mission.engine = EngineKind::automatic;
    std::vector<std::optional<MeasuredError>> errors(mission.sensors.size());
    errors[0] = MeasuredError{{{0, std::nullopt, 0.18}, {4, 0.01, 0.002}, {6, 0.03, 0.015}}};
    CHECK(*errors[0]->mean() == approx(0.02));
    CHECK(errors[0]->worst()->pose == 6);
    CHECK(errors[0]->min_measurable() == approx(0.36));
    CHECK(error_warnings(mission, errors).empty());
    CHECK(json_of(*errors[0])["pings"][0]["relative_l1"].is_null());
    errors[0]->pings[2].relative_l1 = 0.0342;
    const std::vector<Warning> warnings = error_warnings(mission, errors);
    REQUIRE(warnings.size() == 1);
    CHECK(warnings[0].what.find("3.4 % at pose 6; accuracy.relative_l1 asks for 3 %") !=
          std::string::npos);
    CHECK(warnings[0].cure == "lower accuracy.relative_l1 to 0.015");
}

// On drawn meshes, against the truth by many more rays of other casts.
TEST_CASE("measured errors: the noise of a reference does not enter") {
    constexpr double goal = 0.03;
    std::vector<double> ratios;
    for (const std::uint32_t number : {1000U, 1014U, 1028U, 1042U, 1056U, 1070U}) {
        const Lattice lattice = draw_lattice(number);
        const Caster caster(lattice.scene);
        Sonar sonar = noise_free(lattice.sonar, goal);
        sonar.T_vehicle_sensor = Pose{};
        const View& view = sonar.settings.view;
        const Reference truth =
            cast_reference(caster, lattice.scene, view, Pose{},
                           {.noise = 0.002, .rays_max = 6'000'000, .start = 1U << 20U});
        const Reference few =
            cast_reference(caster, lattice.scene, view, Pose{},
                           {.noise = 0.5 * goal, .rays_per_bin = 4.0, .rays_max = 1'000'000});
        for (const EngineKind engine : {EngineKind::strips, EngineKind::rays}) {
            const std::vector<float> image = expected_image(sonar, lattice.scene, engine);
            const double error = image_error(image, truth.intensity, truth.scored).relative_l1;
            const double measured = error_without_noise(image, few);
            CAPTURE_ALL(number, static_cast<int>(engine), error, measured, few.noise);
            // An image that is nearly the truth has no error, though casts differ by their noise.
            CHECK(error_without_noise(truth.intensity, few) < 0.5 * few.noise);
            if (error > 1.25 * goal) CHECK((measured > goal || few.noise > 0.5 * goal));
            if (error > few.noise) ratios.push_back(measured / error);
        }
    }
    REQUIRE(ratios.size() > 4);
    std::ranges::nth_element(ratios, ratios.begin() + ratios.size() / 2);
    CHECK(ratios[ratios.size() / 2] > 1.0 / 1.5);
    CHECK(ratios[ratios.size() / 2] < 1.5);
}
