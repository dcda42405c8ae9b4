#include <doctest/doctest.h>

#include <cmath>
#include <random>

#include "calibrated/target_fixtures.h"
#include "support/approx.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

/// A ball and a dark wall `distance_m` off, which hides what lies beyond a line that is `edge_m`
/// off the axis, turned about it.
BallScene behind_wall(BallScene ball, double distance_m, double edge_m, double turn_rad) {
    const auto at = [&](double across, double up) -> Eigen::Vector3f {
        return Eigen::Vector3d(distance_m, across * std::cos(turn_rad) - up * std::sin(turn_rad),
                               across * std::sin(turn_rad) + up * std::cos(turn_rad))
            .cast<float>();
    };
    ball.scene.materials.push_back({.name = "dark", .lambert_db = -200.0, .slope_rms_deg = 0.0});
    add_quad(ball.scene, at(edge_m, -2.0), at(3.0, -2.0), at(3.0, 2.0), at(edge_m, 2.0), 1);
    return ball;
}

}  // namespace

TEST_SUITE("calibrated") {
    // The highlight of a sphere of radius a has a normal distribution of RMS a s across.
    TEST_CASE("targets: what a wall hides of a highlight has no echo") {
        const Sonar sonar = target_sonar(SonarKind::imaging);
        const BallScene open({8.0, 0.0, 0.0}, 0.3, 48);
        const double whole = energy_by_rays(sonar, open.scene);
        for (const double edge : {-1.5, -0.7, 0.0, 0.4, 1.0}) {  // in units of a s
            // The wall stands at half of the range to the highlight.
            const double y = 0.5 * edge * 0.3 * std::tan(radians(slope_deg));
            const BallScene hidden = behind_wall(open, 0.5 * (8.0 - 0.3), y, 0.0);
            CAPTURE(edge);
            CHECK(energy_by_rays(sonar, hidden.scene) / whole ==
                  test::approx(0.5 * std::erfc(-edge / std::sqrt(2.0))).epsilon(0.15));
        }
    }

    // A sphere that scatters by Lambert's rule has the echo sqrt(1 - y^2 - z^2) dy dz, in radii.
    // Beyond y = t lies a share of 1/2 - (3 t - t^3) / 4.
    TEST_CASE("targets: a wall hides the share of a rough sphere that lies behind it") {
        const Sonar sonar = target_sonar(SonarKind::imaging);
        BallScene open({10.0, 0.0, 0.0}, 0.2, 24);
        open.scene.materials[0].slope_rms_deg = 0.0;
        const double whole = energy_by_rays(sonar, open.scene);
        std::mt19937 random(27);
        std::uniform_real_distribution<double> uniform(-1.0, 1.0);
        double squares = 0.0;
        constexpr int draws = 24;
        for (int draw = 0; draw < draws; ++draw) {
            const double edge = 0.5 * uniform(random);
            const double turn = pi * uniform(random);
            const BallScene hidden = behind_wall(open, 5.0, 0.5 * edge * 0.2, turn);
            const double expected = 0.5 + 0.25 * (3.0 * edge - edge * edge * edge);
            const double off = db_of_power(energy_by_rays(sonar, hidden.scene) / whole / expected);
            CAPTURE(edge);
            CAPTURE(turn);
            CHECK(std::fabs(off) < 1.0);
            squares += off * off / draws;
        }
        CHECK(std::sqrt(squares) < 0.4);
    }
}
