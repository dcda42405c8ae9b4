#include "simulate/assembly/particles.h"

#include "core/decibel.h"
#include "simulate/sonar/sonar.h"
#include "simulate/trace/particles.h"
#include "support/statistics.h"

namespace {

const Trajectory three_poses{{10.0, {}}, {11.0, {}}, {12.5, {}}};

ParticlesConfig school(ParticleRegion region, double count) {
    return {.name = "school",
            .class_name = "herring",
            .length_m = {0.2, 0.3},
            .count = {count, count},
            .region = region,
            .position_m = {100.0, -50.0, -10.0},
            .size_m = {20.0, 10.0, 4.0},
            .drift_m_s = {0.5, 0.0, 0.0}};
}

/// The particles that a sonar gets, and the scene with their instances.
struct Drawn {
    Scene scene;
    std::vector<Sonar> sonars;
    const Particles& particles() const {
        return dynamic_cast<const Particles&>(*sonars[0].settings.sources.at(0));
    }
};

Drawn draw(const ParticlesConfig& config, std::uint64_t seed) {
    Mission mission;
    mission.seed = seed;
    mission.scene.particles = {config};
    Drawn out;
    out.scene = empty_scene();
    out.scene.instances = {"floor"};
    SonarConfig sonar = default_sonar(SonarKind::imaging);
    sonar.model = ModelKind::calibrated;
    out.sonars.push_back(make_sonar(sonar, {}));
    add_particles(mission, three_poses, out.scene, out.sonars);
    return out;
}

}  // namespace

// A uniform draw in a box is uniform along each axis. In an ellipsoid the cube of the scaled
// radius is uniform, and so is the height over the radius. Significance 1e-3 each.
TEST_CASE("particles: evenly distributed in a box and in an ellipsoid") {
    for (const ParticleRegion region : {ParticleRegion::box, ParticleRegion::ellipsoid}) {
        ParticlesConfig config = school(region, 3000.0);
        config.rise_m_s = 0.5;
        const Drawn drawn = draw(config, 5);
        std::vector<double> first, second, lengths;
        for (const Particle& particle : drawn.particles().all()) {
            const Eigen::Vector3d middle(100.0, -50.0, -10.0);
            const Eigen::Vector3d scaled =
                (particle.start_m - middle).cwiseQuotient(Eigen::Vector3d(10.0, 5.0, 2.0));
            const bool box = region == ParticleRegion::box;
            const double radius = scaled.norm();
            // Rising keeps it within the ellipsoid.
            const Eigen::Vector3d risen = place_at(particle, 3.1) - middle;
            if (!box)
                CHECK(std::hypot((risen.x() - 1.55) / 10.0, risen.y() / 5.0, risen.z() / 2.0) <
                      1.0 + 1e-9);
            first.push_back(box ? 0.5 * (scaled.x() + 1.0) : std::pow(radius, 3));
            second.push_back(0.5 * (box ? scaled.y() + 1.0 : scaled.z() / radius + 1.0));
            // Love: the strength goes with 19.1 log L.
            const double db = db_of_power(particle.section_m2);
            const double f_khz = 1e-3 * drawn.sonars[0].config.instrument.frequency_hz;
            const double length_cm = std::pow(10.0, (db + 62.0 + 0.9 * std::log10(f_khz)) / 19.1);
            lengths.push_back((length_cm - 20.0) / 10.0);
            CHECK(particle.velocity_m_s == Eigen::Vector3d(0.5, 0.0, 0.5));
        }
        const auto uniform = [](double x) { return std::min(1.0, std::max(0.0, x)); };
        for (const auto& drawn_shares : {first, second, lengths})
            CHECK(ks_p_value(drawn_shares, uniform) > 1e-3);
    }
}

TEST_CASE("particles: keyed by the seed, timed from the first ping") {
    const Drawn one = draw(school(ParticleRegion::box, 5.0), 5);
    const auto start_of = [](const Drawn& drawn) { return drawn.particles().all()[0].start_m; };
    CHECK(start_of(draw(school(ParticleRegion::box, 5.0), 5)) == start_of(one));
    CHECK(start_of(draw(school(ParticleRegion::box, 5.0), 6)) != start_of(one));
    CHECK(one.particles().time_s(2) == 2.5);
}

TEST_CASE("particles: single targets and groups are instances") {
    const Drawn few = draw(school(ParticleRegion::box, 3.0), 5);
    CHECK(few.scene.instances ==
          std::vector<std::string>{"floor", "school_1", "school_2", "school_3"});
    CHECK(few.scene.instance_classes ==
          std::vector<std::string>{"", "herring", "herring", "herring"});
    CHECK(few.scene.materials.back().name == "fish");
    const Drawn many = draw(school(ParticleRegion::box, 500.0), 5);
    CHECK(many.scene.instances == std::vector<std::string>{"floor", "school"});
    CHECK(many.particles().all()[499].instance == 1);
    ParticlesConfig taken = school(ParticleRegion::box, 3.0);
    taken.name = "floor";
    CHECK_THROWS_WITH_AS(draw(taken, 5), doctest::Contains("'floor'"), InputError);
}
