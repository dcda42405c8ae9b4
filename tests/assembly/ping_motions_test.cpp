#include "simulate/assembly/poses.h"
#include "simulate/assembly/scene_parts.h"
#include "simulate/trace/ping_motion.h"
#include "support/test.h"

namespace {

/// A vehicle that goes along x at 2 m/s.
Trajectory along_x() {
    Trajectory vehicle;
    for (int k = 0; k < 8; ++k)
        vehicle.push_back({0.5 * k, {Eigen::Quaterniond::Identity(), {1.0 * k, 0.0, -5.0}}});
    return vehicle;
}

SonarConfig camera() {
    SonarConfig config = default_sonar(SonarKind::imaging);
    config.name = "fls";
    config.range_max_m = 10.0;
    return config;
}

}  // namespace

TEST_CASE("ping motions: the rates of a vehicle on a circle, at the lever arm of the sonar") {
    // A vehicle goes round a circle of 20 m at 0.1 rad/s, port inwards, so at 2 m/s. The sonar
    // is 3 m ahead and looks ahead: it moves at 2 m/s forward and 0.3 m/s to port, and turns at
    // 0.1 rad/s. A central difference over 2 h is sin(0.1 h) / (0.1 h) of that, 4e-6 short.
    Trajectory trajectory;
    for (int k = 0; k < 20; ++k) {
        const double angle = 0.1 * 0.05 * k;
        trajectory.push_back({0.05 * k,
                              {rotation_from_rpy(0.0, 0.0, angle + 0.5 * pi),
                               {20.0 * std::cos(angle), 20.0 * std::sin(angle), -5.0}}});
    }
    Mission mission;
    SonarConfig config = default_sonar(SonarKind::imaging);
    config.mount.translation_m = {3.0, 0.0, 0.0};
    std::vector<Sonar> sonars{make_sonar(config, {}), make_sonar(config, {})};
    sonars[1].config.moves_in_ping = true;
    add_ping_motions(mission, trajectory, sonars);
    CHECK(!sonars[0].motions);
    REQUIRE(sonars[1].motions->size() == 20);
    const PingMotion& motion = (*sonars[1].motions)[10];
    CHECK((motion.velocity_m_s - Eigen::Vector3d(2.0, 0.3, 0.0)).norm() < 1e-4);
    CHECK((motion.turn_rad_s - Eigen::Vector3d(0.0, 0.0, 0.1)).norm() < 1e-9);
    CHECK(motion.sound_speed_m_s == mission.water.sound_speed_m_s);
    // One pose has no rates.
    trajectory.resize(1);
    add_ping_motions(mission, trajectory, sonars);
    CHECK(sonars[1].motions->front().is_still());
    sonars[1].config.multipath.method = MultipathMethod::exact;
    CHECK_THROWS_WITH_AS(add_ping_motions(mission, trajectory, sonars),
                         doctest::Contains("multipath"), InputError);
}

TEST_CASE("ping motions: a scanning head has the pattern half way in time, a fan measures") {
    // The vehicle yaws by 60 degrees a second; a place at 10 m is 13.3 ms away and back.
    Trajectory vehicle;
    for (int k = 0; k < 3; ++k)
        vehicle.push_back({0.25 * k, {rotation_from_rpy(0.0, 0.0, radians(15.0 * k)), {0, 0, 0}}});
    Mission mission;
    mission.water.sound_speed_m_s = 1500.0;
    const auto turned = [&](SonarKind kind) {
        SonarConfig config = default_sonar(kind);
        config.moves_in_ping = true;
        std::vector<Sonar> sonars{make_sonar(config, {})};
        add_ping_motions(mission, vehicle, sonars);
        const Eigen::Vector3d measured =
            measured_place((*sonars[0].motions)[1], sonars[0].settings.view.shape, {10, 0, 0});
        return std::atan2(measured.y(), measured.x());
    };
    CHECK(turned(SonarKind::imaging) == approx(-radians(0.8)).epsilon(1e-6));
    CHECK(turned(SonarKind::scanning) == approx(-radians(0.4)).epsilon(1e-6));
}

TEST_CASE("ground in range: the mounts that are drawn for pings reach as far") {
    Mission mission;
    mission.sensors = {camera()};
    VaryConfig rule;
    rule.key = "sensors.fls.mount.translation_m.1";
    rule.per = VaryPer::ping;
    rule.uniform = std::array{-4.0, 4.0};
    mission.vary = {rule};
    const std::vector<Sonar> sonars{make_sonar(mission.sensors[0], {})};
    const Trajectory vehicle = along_x();
    const Eigen::AlignedBox2d visible = ground_in_range(mission, sonars, vehicle, 1.0);
    Eigen::AlignedBox2d places;
    for (std::uint32_t k = 0; k < vehicle.size(); ++k) {
        const SonarAtPose then(mission, sonars[0], k);
        places.extend(Eigen::Vector2d(
            sensor_pose(*then, vehicle[k].T_world_vehicle, k).translation.head<2>()));
    }
    CHECK(places.sizes().y() > 1.0);
    CHECK((visible.min() - places.min() - Eigen::Vector2d(-10, -10)).norm() < 1e-9);
    CHECK((visible.max() - places.max() - Eigen::Vector2d(10, 10)).norm() < 1e-9);
}

TEST_CASE("ground in range: the last group of beams looks from further on") {
    // The last of four groups transmits 3 x 0.2 s after the first, 1.2 m from there.
    SonarConfig config = camera();
    config.moves_in_ping = true;
    config.shutter.groups = 4;
    config.shutter.period_s = 0.2;
    Mission mission;
    mission.sensors = {config};
    std::vector<Sonar> sonars{make_sonar(config, {})};
    const Trajectory vehicle = along_x();
    add_ping_motions(mission, vehicle, sonars);
    const Eigen::AlignedBox2d visible = ground_in_range(mission, sonars, vehicle, 1.0);
    CHECK(visible.min().x() == approx(-10.0));
    CHECK(visible.max().x() == approx(7.0 + 1.2 + 10.0));
}
