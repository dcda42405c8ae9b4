#include "trace/object_motion.h"

#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "core/units.h"
#include "sonar/kinds.h"
#include "sonar/sonar.h"
#include "support/approx.h"
#include "support/patches.h"
#include "support/scenes.h"
#include "visibility/rays/rays_engine.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

constexpr double speed_of_sound = 1500.0;

PingMotion at_rest() {
    PingMotion sonar;
    sonar.sound_speed_m_s = speed_of_sound;
    return sonar;
}

Sample plate_at(const Eigen::Vector3f& position) {
    return patch_with(position, {-1.0F, 0.0F, 0.0F}, 4);
}

}  // namespace

TEST_SUITE("trace") {
    TEST_CASE("object motion: a point that comes and one that passes") {
        // Sound leaves at 0 and meets a point that comes at u after t: d - u t = c t, so at the
        // range d c / (c + u), and returns from there.
        const Eigen::Vector3d ahead(60.0, 0.0, 0.0);
        const Eigen::Vector3d comes = met_place(at_rest(), ahead, {-8.0, 0.0, 0.0});
        CHECK(comes.x() == test::approx(60.0 * 1500.0 / 1508.0).epsilon(1e-12));
        CHECK(comes.tail<2>().norm() == 0.0);
        // It passes: (c t)^2 = d^2 + (u t)^2.
        const double time = 60.0 / std::sqrt(1500.0 * 1500.0 - 64.0);
        const Eigen::Vector3d passes = met_place(at_rest(), ahead, {0.0, 8.0, 0.0});
        CHECK((passes - Eigen::Vector3d(60.0, 8.0 * time, 0.0)).norm() < 1e-11);
        CHECK(met_place(at_rest(), ahead, {0.0, 0.0, 0.0}) == ahead);
    }

    TEST_CASE("object motion: sonar and point both move, by a search for both times") {
        std::mt19937 random(5);
        std::uniform_real_distribution<double> some(-1.0, 1.0);
        const auto vector = [&](double size) -> Eigen::Vector3d {
            const double x = some(random);
            const double y = some(random);
            const double z = some(random);
            return size * Eigen::Vector3d(x, y, z);
        };
        const auto time_when = [](const auto& has_come) {
            double low = 0.0;
            double high = 1.0;
            for (int i = 0; i < 60; ++i) {
                const double t = 0.5 * (low + high);
                (has_come(t) ? high : low) = t;
            }
            return low;
        };
        for (int k = 0; k < 50; ++k) {
            PingMotion sonar = at_rest();
            sonar.velocity_m_s = vector(10.0);
            const Eigen::Vector3d u = vector(10.0);
            const Eigen::Vector3d p = vector(100.0);
            const double met =
                time_when([&](double t) { return speed_of_sound * t >= (p + t * u).norm(); });
            const Eigen::Vector3d there = p + met * u;
            const double back = time_when([&](double t) {
                return speed_of_sound * (t - met) >= (there - t * sonar.velocity_m_s).norm();
            });
            const Eigen::Vector3d seen =
                measured_place(sonar, ViewShape::fan, met_place(sonar, p, u));
            CHECK(seen.norm() == test::approx(0.5 * speed_of_sound * back).epsilon(1e-11));
            const Eigen::Vector3d direction = (there - back * sonar.velocity_m_s).normalized();
            CHECK((seen.normalized() - direction).norm() < 1e-10);
        }
    }

    // A pulse of the frequency f that runs over B in T upwards: what recedes at w has its echo
    // lowered by 2 w f / c, as the pulse has it later by 2 w f T / (c B), so w f T / B farther.
    TEST_CASE("object motion: a pulse that sweeps shifts the range by the speed of both") {
        PingMotion sonar = at_rest();
        sonar.doppler_s = 0.02;
        const Eigen::Vector3d ahead(30.0, 0.0, 0.0);
        const double unshifted = met_place(at_rest(), ahead, {3.0, 0.0, 0.0}).x();
        CHECK(met_place(sonar, ahead, {3.0, 0.0, 0.0}).x() ==
              test::approx(unshifted + 0.06).epsilon(1e-12));
        PingMotion goes = at_rest();
        goes.velocity_m_s = {2.0, 0.5, 0.0};
        const double range = measured_place(goes, ViewShape::fan, ahead).norm();
        goes.doppler_s = 0.02;
        const Eigen::Vector3d seen = measured_place(goes, ViewShape::fan, ahead);
        CHECK(seen.norm() == test::approx(range - 0.04).epsilon(1e-12));
        CHECK((unmoved_place(goes, ViewShape::fan, seen) - ahead).norm() < 1e-9);
    }

    // An object turns about z by w at 20 m ahead; a patch 2 m to port of its middle moves by 2 w
    // towards the sonar. A later transmission finds it turned on.
    TEST_CASE(
        "object motion: patches of an object that turns, at this transmission or a later one") {
        const std::vector<ObjectMotion> all{{.instance = 4,
                                             .centre_m = {20.0, 0.0, 0.0},
                                             .velocity_m_s = {0.0, 0.0, 0.0},
                                             .turn_rad_s = {0.0, 0.0, 0.5}}};
        for (const double later_s : {0.0, 0.4}) {
            std::vector<Sample> samples{plate_at({20.0F, 2.0F, 0.0F}),
                                        plate_at({20.0F, 2.0F, 0.0F})};
            samples[1].instance = 3;
            move_objects({all, later_s}, at_rest(), {}, std::span<Sample>(samples));
            double time = 0.0;  // from the transmission, by iteration: it comes 800 times nearer
            Eigen::Vector3d place;
            double angle = 0.0;
            for (int k = 0; k < 6; ++k) {
                angle = 0.5 * (later_s + time);
                place = {20.0 - 2.0 * std::sin(angle), 2.0 * std::cos(angle), 0.0};
                time = place.norm() / speed_of_sound;
            }
            // Within the ping the patch goes straight for the time: an arc of 5e-5 m at most.
            CHECK((samples[0].position.cast<double>() - place).norm() < 1e-4);
            const Eigen::Vector3d normal(-std::cos(angle), -std::sin(angle), 0.0);
            CHECK((samples[0].normal.cast<double>() - normal).norm() < 1e-4);
            CHECK(samples[0].height_m == test::approx(-normal.dot(place)).epsilon(1e-4));
            CHECK(samples[1].position == plate_at({20.0F, 2.0F, 0.0F}).position);
        }
    }

    TEST_CASE("object motion: particles go on in the ping, and one at rest stays to the bit") {
        const Scene scene = empty_scene();
        const auto engine = make_rays_engine(scene);
        const View view = fan_of_50_m();
        Particles particles;
        for (const double speed : {0.0, 4.0}) {
            Particle& fish = particles.all.emplace_back();
            fish.start_m = {30.0, 1.0, 0.0};
            fish.velocity_m_s = {-speed, 0.0, 0.0};
        }
        const auto seen = seen_particles(particles, 0.0, view, {}, *engine, {}, at_rest());
        const auto still = seen_particles(particles, 0.0, view, {}, *engine, {}, {});
        REQUIRE(seen.samples.size() == 2);
        CHECK(seen.samples[0].position == still.samples[0].position);
        const Eigen::Vector3d met = met_place(at_rest(), {30.0, 1.0, 0.0}, {-4.0, 0.0, 0.0});
        CHECK((seen.samples[1].position.cast<double>() - met).norm() < 1e-5);
        CHECK(still.samples[1].position == still.samples[0].position);
    }
}
