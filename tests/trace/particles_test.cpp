#include "simulate/trace/particles.h"

#include "simulate/visibility/rays/rays_engine.h"
#include "support/test.h"

namespace {

Particle particle_at(double x, double y, double z) {
    return {.start_m = {x, y, z}, .velocity_m_s = {0.0, 0.0, 0.0}, .section_m2 = 0.25F};
}

const View wide_fan{radians(90.0), radians(20.0), 0.5, 20.0, 100, 32, 0.03};

}  // namespace

TEST_CASE("particles: they drift, and bubbles rise and begin anew") {
    Particle fish = particle_at(1.0, 2.0, -3.0);
    fish.velocity_m_s = {0.5, -0.25, 0.0};
    CHECK((place_at(fish, 4.0) - Eigen::Vector3d(3.0, 1.0, -3.0)).norm() < 1e-12);
    // From 4 m below the top of 10 m at 0.3 m/s: after 20 s it is 2 m above the bottom.
    Particle bubble = particle_at(0.0, 0.0, -6.0);
    bubble.velocity_m_s = {0.1, 0.0, 0.3};
    bubble.bottom_m = -12.0;
    bubble.top_m = -2.0;
    CHECK((place_at(bubble, 20.0) - Eigen::Vector3d(2.0, 0.0, -10.0)).norm() < 1e-12);
    CHECK((place_at(bubble, 2.0) - Eigen::Vector3d(0.2, 0.0, -5.4)).norm() < 1e-12);
}

// A wall 8 m ahead, 4 m wide: at 12 m its shadow ends 3 m from the axis.
TEST_CASE("particles: those in view that no surface hides") {
    const Scene scene = rectangle_scene({8, -2, -5}, {8, 2, 5}, 0.4F);
    const auto engine = make_rays_engine(scene);
    const Particles particles(
        {particle_at(7.0, 0.0, 0.0), particle_at(9.0, 0.0, 0.0), particle_at(12.0, 2.9, 0.0),
         particle_at(12.0, 3.1, 0.0), particle_at(-5.0, 0.0, 0.0), particle_at(5.0, 5.2, 0.0),
         particle_at(5.0, 0.0, 1.0), particle_at(19.0, 9.0, 0.0), particle_at(18.0, -7.0, 0.0),
         particle_at(7.0, 0.0, -1.2)},
        {});
    const auto numbers_of = [](const Samples& samples) {
        std::vector<std::uint32_t> numbers;
        for (const Sample& sample : samples.items)
            numbers.push_back(sample.number);
        return numbers;
    };
    Samples visible;
    particles.add({wide_fan, scene, *engine, Pose{}}, {}, 0, visible);
    // 5 is outside in azimuth, 6 at 11.3 degrees of elevation, 7 beyond 20 m.
    CHECK(numbers_of(visible) == std::vector<std::uint32_t>{0, 3, 8, 9});
    CHECK((visible.items[1].position - Eigen::Vector3f(12.0F, 3.1F, 0.0F)).norm() < 1e-5F);
    CHECK(visible.items[1].area_m2 == 0.25F);
    // From a sonar behind the wall that looks back, past whose edge it sees 5.
    const Pose back{rotation_from_rpy(0.0, 0.0, pi), {16.0, 0.0, 0.0}};
    Samples behind;
    particles.add({wide_fan, scene, *engine, back}, {}, 0, behind);
    CHECK(numbers_of(behind) == std::vector<std::uint32_t>{1, 2, 3, 5});
}
