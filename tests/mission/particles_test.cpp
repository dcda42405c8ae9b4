#include "mission/fixtures.h"
#include "mission/resolved.h"

namespace sonarsim {

namespace {

std::string with_particles(const std::string& particles, const std::string& model = "calibrated") {
    return "scene:\n  file: a.glb\n  materials: a.csv\n  particles:\n    - {name: p, position_m: "
           "[1, "
           "2, 3], " +
           particles +
           "}\ntrajectory: {file: a.tum}\nsensors:\n  fls:\n    kind: imaging\n    model: " +
           model + "\n";
}

}  // namespace

TEST_SUITE_BEGIN("mission");

TEST_CASE("particles: the keys, and their resolved form") {
    const std::string text = with_particles(
        "class: cod, kind: fish, length_m: [0.3, 0.5], count: 7, region: "
        "ellipsoid, size_m: [4, 5, 6], drift_m_s: [0.1, 0, 0]");
    const Mission mission = parse(text);
    REQUIRE(mission.scene.particles.size() == 1);
    const ParticlesConfig& fish = mission.scene.particles[0];
    CHECK(fish.class_name == "cod");
    CHECK(fish.kind == ParticleKind::fish);
    CHECK(fish.length_m == std::array{0.3, 0.5});
    CHECK(fish.count == std::array{7.0, 7.0});
    CHECK(fish.region == ParticleRegion::ellipsoid);
    CHECK(parse(text, {"scene.particles.0.count=9"}).scene.particles[0].count[1] == 9.0);
}

TEST_CASE("particles: what is refused, and where") {
    const auto is_refused = [](const std::string& particles, const std::string& why) {
        const std::string message = refusal(with_particles(particles));
        CAPTURE(message);
        CHECK(message.find(why) != std::string::npos);
        CHECK(message.find("m.yaml:5") != std::string::npos);
    };
    is_refused("kind: fish, count: 3", "length_m above 0");
    is_refused("target_strength_db: -40", "'count' must be above 0");
    is_refused("kind: fish, length_m: 0.3, count: 3, law: love", "'law' is no longer there");
    is_refused("kind: bubbles, radius_m: 0.001, length_m: 0.2, count: 3", "no other kind has one");
    is_refused("target_strength_db: -40, count: 3, rise_m_s: 1", "rise_m_s is for kind: bubbles");
    is_refused("target_strength_db: -40, count: 3, buried: true", "leave it out");
    CHECK(refusal(with_particles("target_strength_db: -40, count: 3")).empty());
    CHECK(
        refusal(with_particles("target_strength_db: -40, count: 3", "paper")).find("calibrated") !=
        std::string::npos);
}

TEST_CASE("motion in a ping: what is refused") {
    const std::string mission =
        "scene: {file: a.glb, materials: a.csv}\ntrajectory: {file: a.tum}\nsensors:\n  fls:\n"
        "    kind: imaging\n";
    CHECK(refusal(mission + "    shutter: {groups: 2}\n").find("moves_in_ping: true") !=
          std::string::npos);
    CHECK(refusal(mission + "    moves_in_ping: true\n    shutter: {groups: 2}\n").empty());
}

TEST_SUITE_END();

}  // namespace sonarsim
