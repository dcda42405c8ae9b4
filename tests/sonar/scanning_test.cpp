#include "simulate/product/scan.h"
#include "support/sonars.h"

namespace {

SonarConfig scanning_sonar() {
    SonarConfig config = default_sonar(SonarKind::scanning);
    config.step_deg = 10.0;
    set_range(config, 0.2, 6.0, 290);  // 2 cm each
    return config;
}

/// A sphere of 0.2 m about (3, 0, 0) turned by `azimuth_deg` to port.
Scene sphere_at(double azimuth_deg) {
    const Eigen::Vector3d centre = 3.0 * direction_of(radians(azimuth_deg), 0.0);
    return sphere_scene(centre.cast<float>(), 0.2F, 0.5F);
}

}  // namespace

TEST_CASE("scanning: the head goes round and round, or to and fro over a sector") {
    SonarConfig config = scanning_sonar();
    const std::vector<double> round = scan_angles_rad(config);
    REQUIRE(round.size() == 36);
    CHECK(round.front() == approx(radians(-175)));
    CHECK(round.back() == approx(radians(175)));
    config.sector_deg = 40.0;
    const std::vector<double> sector = scan_angles_rad(config);
    REQUIRE(sector.size() == 8);
    const double expected[] = {-15, -5, 5, 15, 15, 5, -5, -15};
    for (int k = 0; k < 8; ++k)
        CHECK(sector[k] == approx(radians(expected[k])));
    // A step that does not divide the sector is rounded to one that does.
    config.step_deg = 9.0;
    CHECK(scan_steps(config) == 4);
}

TEST_CASE("scanning: a sphere is seen when the head points at it, and at its range") {
    const Scene scene = sphere_at(65.0);
    const auto engine = make_rays_engine(scene);
    const Sonar sonar = make_sonar(scanning_sonar(), {});
    for (std::uint32_t pose = 0; pose < 36; ++pose) {
        const Ping ping = render_ping(sonar, scene, *engine, Pose{}, {0, pose});
        const double angle = head_angle_rad(sonar, pose);
        // The sphere spans asin(0.2 / 3) = 3.8 degrees to either side, the beam 1; steps are 10.
        const bool aims = std::fabs(angle - radians(65)) < radians(4.0);
        const auto echo = std::ranges::find_if(ping.intensity, [](float x) { return x > 0.0F; });
        CHECK((echo != ping.intensity.end()) == aims);
        // Its near side is 2.8 m away: bin (2.8 - 0.2) / 0.02.
        if (aims) CHECK(std::abs(echo - ping.intensity.begin() - 130) <= 1);
    }
}

TEST_CASE("scanning: the metadata tell the angle of the head, `every` counts its pings") {
    SonarConfig config = scanning_sonar();
    config.every = 3;
    const Sonar sonar = make_sonar(config, {});
    CHECK(head_angle_rad(sonar, 0) == approx(radians(-175)));
    CHECK(head_angle_rad(sonar, 6) == approx(radians(-155)));
    const Scene scene = sphere_at(0.0);
    const auto engine = make_rays_engine(scene);
    const auto json = measured({sonar, Pose{}, 6, {}, {}, {}}, *engine);
    CHECK(json.at("head_angle_rad") == approx(radians(-155)));
    CHECK(json.at("altitude_m").is_null());
}
