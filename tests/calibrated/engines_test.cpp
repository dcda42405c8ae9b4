#include "simulate/reference/reference.h"
#include "support/bounces.h"
#include "support/calibrated.h"
#include "support/draws.h"
#include "support/lattices.h"

namespace {

/// A plane bottom 5 m below the vehicle.
Scene flat_bottom() {
    return floor_scene(14.0F, -5.0F, 0.4F, 4);
}

/// Ground of ripples of drawn height, length and direction.
Scene ripples(Uniform& random) {
    Scene scene = floor_scene(12.0F, 0.0F, 0.4F, 240);
    const float turn = random.single(0.0, pi);
    const float per_m = 6.28F / random.single(0.4, 1.0);
    const float height_m = random.single(0.02, 0.05);
    for (Eigen::Vector3f& vertex : scene.vertices) {
        const float along = std::cos(turn) * vertex.x() + std::sin(turn) * vertex.y();
        vertex.z() = height_m * std::sin(per_m * along);
    }
    return scene;
}

/// The relative error of an engine's expected image, against brute force.
double error_of(const Sonar& sonar, const Scene& scene, EngineKind engine, const Pose& pose,
                const ReferenceGoal& goal) {
    const Reference truth = cast_energy_reference(Caster(scene), scene, sonar.settings,
                                                  sensor_pose(sonar, pose, 0), goal);
    return image_error(expected_image(sonar, scene, engine, pose), truth.intensity).relative_l1;
}

}  // namespace

// Stones and the beam are narrower than a column: pieces weigh as the beam at their middles.
TEST_CASE("side-scan: stones in a narrow beam are visible") {
    Uniform random(29);
    SonarConfig config = calibrated(default_sonar(SonarKind::sidescan), 4e5);
    set_range(config, 0.5, 12.0, 230);
    config.elevation_deg = 6.0;
    const Sonar sonar = make_sonar(config, {0.03});
    double error = 0.0;
    constexpr int scenes = 6;
    for (int k = 0; k < scenes; ++k) {
        Scene scene = flat_bottom();
        for (int stone = 0; stone < 300; ++stone) {
            const float x = random.single(-1.0, 1.0);
            const float y = random.single(-12.0, 12.0);
            add_sphere(scene, {x, y, -5.0F}, random.single(0.05, 0.2), 0, 12);
        }
        const double aside_m = random.between(-0.5, 0.5);
        const double up_m = random.between(0.0, 0.3);
        const Pose pose{.translation = {random.between(-0.5, 0.5), aside_m, up_m}};
        error +=
            error_of(sonar, scene, EngineKind::automatic, pose, {0.02, 64.0, 2'000'000}) / scenes;
    }
    CHECK(error < 0.04);
}

TEST_CASE("multipath of auto is that of strips, and of the paper's model that of rays") {
    const Scene scene = tank();
    SonarConfig config = small_imaging();
    config.multipath.method = MultipathMethod::exact;
    for (const ModelKind model : {ModelKind::paper, ModelKind::calibrated}) {
        const Sonar sonar =
            make_sonar(model == ModelKind::paper ? config : calibrated(config, 4e5), {0.03});
        for (const Pose& pose : tank_poses()) {
            const auto image = [&](EngineKind engine) {
                return expected_image(sonar, scene, engine, pose, multipath_alone);
            };
            const std::vector<float> rays = image(EngineKind::rays);
            const std::vector<float> strips = image(EngineKind::strips);
            CHECK(std::ranges::max(rays) > 0.0F);
            CHECK(image(EngineKind::automatic) == strips);
            if (model == ModelKind::paper) CHECK(strips == rays);  // the other takes more
            CHECK(total(strips) == approx(total(rays)).epsilon(0.03));
        }
    }
}

// The speckle of the scatterers of the scene has the mean power of the expected image, also
// where the ground is bent within a beam. Footprints that overlap add an amplitude twice.
TEST_CASE("speckle over ripples keeps the level of the expected image") {
    SonarConfig config = bare_sonar(default_sonar(SonarKind::imaging), 7.5e5);
    config.instrument.speckle.mode = SpeckleMode::scene;
    set_range(config, 1.0, 10.0, config.range_bins);
    const Sonar sonar = make_sonar(config, {0.03});
    const auto mean_db = [&](EngineKind engine) {
        Uniform random(31);
        constexpr int scenes = 8;
        double db = 0.0;  // scenes of one seed would share their scatterers
        for (int k = 0; k < scenes; ++k) {
            const Scene scene = ripples(random);
            const Pose pose = pitched(random.between(14.0, 20.0), {0.0, 0.0, 1.5});
            const auto sum = [&](const Terms& terms) -> double {
                const PingKey key{.seed = static_cast<std::uint64_t>(k)};
                return total(render_ping(sonar, scene, *engine_of(scene, engine), pose, key, terms)
                                 .intensity);
            };
            db += 10.0 * std::log10(sum({.random = 1}) / sum(direct_echoes_alone)) / scenes;
        }
        return db;
    };
    // The level of one scene is off by some 0.06 dB, the mean of eight by 0.02.
    CHECK(std::fabs(mean_db(EngineKind::strips)) < 0.06);
    CHECK(std::fabs(mean_db(EngineKind::rays)) < 0.2);
}

// Columns cut slanted triangles into wedges. As parallelograms, their energies lie in other
// bins: the error is 3.6 %.
TEST_CASE("strips: wedges of ripples have their energy where it belongs") {
    Uniform random(5);
    SonarConfig config = calibrated(small_imaging(), 7.5e5);
    set_range(config, 1.0, 10.0, 500);
    config.azimuth_bins = 96;
    config.azimuth_deg = 15.0;
    const Sonar sonar = make_sonar(config, {0.03});
    const Pose pose = pitched(17.2, {0.0, 0.0, 1.5});
    constexpr int scenes = 3;
    double error = 0.0;
    for (int k = 0; k < scenes; ++k) {
        const Scene scene = ripples(random);
        error +=
            error_of(sonar, scene, EngineKind::strips, pose, {0.005, 64.0, 4'000'000}) / scenes;
    }
    CHECK(error < 0.02);
}

// A strip as long as the bottom is wide would weigh a beam's middle as much as its edge.
TEST_CASE("rays and strips agree within twice the error goal") {
    Scene with_objects = flat_bottom();
    add_box(with_objects, {-0.6F, 1.5F, -5.0F}, {0.8F, 2.6F, -4.1F}, 0);
    add_sphere(with_objects, {0.3F, -3.0F, -4.6F}, 0.4F, 0, 48);
    SonarConfig side = calibrated(default_sonar(SonarKind::sidescan), 4e5);
    set_range(side, side.range_min_m, 12.0, 230);
    side.elevation_deg = 6.0;
    std::vector<SonarConfig> configs{side};
    // The beam may be much narrower than the view.
    for (const auto& [opening_deg, width_deg] :
         {std::pair{12.0, 0.4}, {24.0, 7.0}, {40.0, 4.0}, {24.0, 0.8}}) {
        SonarConfig& sounder =
            configs.emplace_back(calibrated(default_sonar(SonarKind::echosounder), 2e5));
        sounder.opening_deg = opening_deg;
        set_range(sounder, sounder.range_min_m, 10.0, 190);
        sounder.instrument.beam.width_deg = width_deg;
    }
    for (const Scene& scene : {flat_bottom(), with_objects}) {
        for (const SonarConfig& config : configs) {
            CAPTURE_ALL(config.opening_deg, config.instrument.beam.width_deg);
            const Sonar sonar = make_sonar(config, {0.02});
            const std::vector<float> rays = expected_image(sonar, scene, EngineKind::rays);
            const std::vector<float> strips = expected_image(sonar, scene, EngineKind::strips);
            CHECK(image_error(rays, strips).relative_l1 < 0.04);
        }
    }
}

// Nets, stairs, pipes and leaves, thinner than the rays of the goal are apart. A sum of
// energies needs their area; rays are 1.2 to 66 % off at any goal.
TEST_CASE("the energy of thin structures is right") {
    constexpr double goal = 0.03;
    double mean = 0.0;
    constexpr int scenes = 6;
    for (const std::uint32_t number : {100U, 102U, 104U, 106U, 108U, 114U}) {
        const Lattice lattice = draw_lattice(number);
        Sonar sonar = make_sonar(bare_sonar(lattice.sonar, 4e5), {goal});
        sonar.T_vehicle_sensor = Pose{};
        const double error =
            error_of(sonar, lattice.scene, EngineKind::automatic, {}, {0.01, 32.0, 400'000});
        CAPTURE(error);
        CHECK(error < 2.0 * goal);
        mean += error / scenes;
    }
    CHECK(mean < goal + 0.01);
}
