#include "assembly/heightmap_part.h"

#include <doctest/doctest.h>

#include <array>

#include "assembly/ping_motions.h"
#include "sonar/kinds.h"
#include "sonar/sonar_at_pose.h"
#include "support/approx.h"

using namespace sonarsim;

namespace {

/// A vehicle that goes along x at 2 m/s.
Trajectory along_x() {
    Trajectory vehicle;
    for (int k = 0; k < 8; ++k)
        vehicle.push_back({0.5 * k, {Eigen::Quaterniond::Identity(), {1.0 * k, 0.0, -5.0}}});
    return vehicle;
}

Mission mission_of(const SonarConfig& config) {
    Mission mission;
    mission.sensors = {config};
    return mission;
}

SonarConfig camera() {
    SonarConfig config = default_sonar(SonarKind::imaging);
    config.name = "fls";
    config.range_max_m = 10.0;
    return config;
}

}  // namespace

TEST_SUITE("assembly") {
    TEST_CASE("ground in range: the mounts that are drawn for pings reach as far") {
        Mission mission = mission_of(camera());
        VaryConfig rule;
        rule.key = "sensors.fls.mount.translation_m.1";
        rule.per = VaryPer::ping;
        rule.uniform = std::array{-4.0, 4.0};
        mission.vary = {rule};
        const std::vector<Sonar> sonars{make_sonar(mission.sensors[0], {})};
        const Trajectory vehicle = along_x();
        const Eigen::AlignedBox2d seen = ground_in_range(mission, sonars, vehicle, 1.0);
        Eigen::AlignedBox2d places;
        for (std::uint32_t k = 0; k < vehicle.size(); ++k) {
            const SonarAtPose then(mission, sonars[0], k);
            places.extend(Eigen::Vector2d(
                sensor_pose(*then, vehicle[k].T_world_vehicle, k).translation.head<2>()));
        }
        CHECK(places.sizes().y() > 1.0);
        CHECK((seen.min() - places.min() - Eigen::Vector2d(-10, -10)).norm() < 1e-9);
        CHECK((seen.max() - places.max() - Eigen::Vector2d(10, 10)).norm() < 1e-9);
    }

    TEST_CASE("ground in range: the last group of beams looks from further on") {
        // The last of four groups transmits 3 x 0.2 s after the first, 1.2 m from there.
        SonarConfig config = camera();
        config.moves_in_ping = true;
        config.shutter.groups = 4;
        config.shutter.period_s = 0.2;
        const Mission mission = mission_of(config);
        std::vector<Sonar> sonars{make_sonar(config, {})};
        const Trajectory vehicle = along_x();
        add_ping_motions(mission, vehicle, sonars);
        const Eigen::AlignedBox2d seen = ground_in_range(mission, sonars, vehicle, 1.0);
        CHECK(seen.min().x() == test::approx(-10.0));
        CHECK(seen.max().x() == test::approx(7.0 + 1.2 + 10.0));
    }
}
