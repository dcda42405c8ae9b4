#include "simulate/visibility/rays/rays_engine.h"
#include "support/test.h"

namespace {

/// The samples of a tank with the sonar `height` above an extra floor, all in metres times `unit`.
Samples samples_at(float height, double unit) {
    Scene scene = tank();
    add_floor(scene, 1.0F, 1.5F - height, 0);
    for (Eigen::Vector3f& p : scene.vertices)
        p *= static_cast<float>(unit);
    const View view{radians(60.0), radians(20.0), 0.0, unit * 10.0, 256, 32, 0.03};
    const Pose T_world_sensor{rotation_from_rpy(0.0, radians(80.0), 0.3),
                              unit * Eigen::Vector3d(0.25, 0.125, 1.5)};
    return make_rays_engine(scene)->visible_surface(view, T_world_sensor);
}

}  // namespace

TEST_CASE("rays: a scene of a millimetre is seen as the same scene of ten metres is") {
    // At this unit the sonar is 0.6 um above the floor.
    constexpr double unit = 0x1p-13;
    const Samples metres = samples_at(0.005F, 1.0);
    const Samples small = samples_at(0.005F, unit);
    CHECK(metres.dropped == 0);
    CHECK(small.dropped == 0);
    REQUIRE(small.items.size() == metres.items.size());
    for (std::size_t i = 0; i < small.items.size(); ++i) {
        const Eigen::Vector3f apart =
            small.items[i].position / static_cast<float>(unit) - metres.items[i].position;
        CHECK(apart.norm() <= 1e-6F * metres.items[i].position.norm());
    }
    // A surface that the sonar touches is dropped, whatever the unit.
    CHECK(samples_at(5e-7F, 1.0).dropped > 0);
    CHECK(samples_at(5e-7F, unit).dropped > 0);
}
