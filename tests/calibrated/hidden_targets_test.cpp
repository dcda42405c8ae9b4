#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "calibrated/target_fixtures.h"
#include "support/approx.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE("calibrated") {
    // The highlight of a sphere of radius a has a normal distribution of RMS a s across. What a
    // wall leaves of it is the integral of that.
    TEST_CASE("targets: what a wall hides of a highlight has no echo") {
        const Sonar sonar = target_sonar(SonarKind::imaging);
        const double radius = 0.3;
        const double range = 8.0;
        const double slope = std::tan(radians(slope_deg));
        const BallScene open({range, 0.0, 0.0}, radius, 48);
        const double whole = energy_by(with_targets(sonar, open.scene), open.scene,
                                       *engine_of(open.scene, EngineKind::rays));
        for (const double edge : {-1.5, -0.7, 0.0, 0.4, 1.0}) {  // in units of a s
            BallScene hidden({range, 0.0, 0.0}, radius, 48);
            // The wall stands at half of the range to the highlight.
            const double y = 0.5 * edge * radius * slope;
            const auto at = [&](double across, double up) {
                return Eigen::Vector3f(static_cast<float>(0.5 * (range - radius)),
                                       static_cast<float>(across), static_cast<float>(up));
            };
            add_quad(hidden.scene, at(y, -2.0), at(3.0, -2.0), at(3.0, 2.0), at(y, 2.0), 0);
            hidden.scene.materials.push_back({.name = "dark", .lambert_db = -200.0});
            hidden.scene.materials.back().slope_rms_deg = 0.0;
            for (std::size_t t = hidden.scene.triangles.size() - 2;
                 t < hidden.scene.triangles.size(); ++t)
                hidden.scene.triangle_material[t] = 1;
            const double left = energy_by(with_targets(sonar, hidden.scene), hidden.scene,
                                          *engine_of(hidden.scene, EngineKind::rays));
            const double expected = 0.5 * std::erfc(-edge / std::sqrt(2.0));
            CAPTURE(edge);
            CHECK(left / whole == test::approx(expected).epsilon(0.15));
        }
    }

    // A sphere that scatters by Lambert's rule has the echo sin^2(grazing angle) dA, that is
    // sqrt(1 - y^2 - z^2) dy dz seen from afar, in radii. Beyond y = t it is the integral of
    // pi / 2 (1 - y^2), a share of 1/2 - (3 t - t^3) / 4.
    TEST_CASE("targets: a wall hides the share of a rough sphere that lies behind it") {
        const Sonar sonar = target_sonar(SonarKind::imaging);
        const double radius = 0.2;
        const double range = 10.0;
        const auto energy = [&](const BallScene& ball) {
            return energy_by(with_targets(sonar, ball.scene), ball.scene,
                             *engine_of(ball.scene, EngineKind::rays));
        };
        const BallScene open({range, 0.0, 0.0}, radius, 24);
        const auto without_facets = [](BallScene ball) {
            ball.scene.materials[0].slope_rms_deg = 0.0;
            return ball;
        };
        const double whole = energy(without_facets(open));
        std::mt19937 random(27);
        std::uniform_real_distribution<double> uniform(-1.0, 1.0);
        double squares = 0.0;
        constexpr int draws = 24;
        for (int draw = 0; draw < draws; ++draw) {
            const double edge = 0.5 * uniform(random);
            const double turn = pi * uniform(random);
            BallScene hidden = without_facets(open);
            // The wall stands at half of the range and is out of the image's last bins.
            const auto at = [&](double across, double up) {
                return Eigen::Vector3f(
                    static_cast<float>(0.5 * range),
                    static_cast<float>(across * std::cos(turn) - up * std::sin(turn)),
                    static_cast<float>(across * std::sin(turn) + up * std::cos(turn)));
            };
            const double y = 0.5 * edge * radius;
            hidden.scene.materials.push_back({.name = "dark", .lambert_db = -200.0});
            hidden.scene.materials.back().slope_rms_deg = 0.0;
            add_quad(hidden.scene, at(y, -2.0), at(3.0, -2.0), at(3.0, 2.0), at(y, 2.0), 1);
            const double expected = 0.5 + 0.25 * (3.0 * edge - edge * edge * edge);
            const double off = decibels(energy(hidden) / whole / expected);
            CAPTURE(edge);
            CAPTURE(turn);
            CHECK(std::fabs(off) < 1.0);
            squares += off * off / draws;
        }
        CHECK(std::sqrt(squares) < 0.4);
    }
}
