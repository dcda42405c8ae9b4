#include "visibility/view_parts.h"

#include <doctest/doctest.h>

#include <cmath>

#include "core/units.h"
#include "support/draws.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE("view parts") {
    TEST_CASE("the beams of a part are beams of the whole view") {
        Draws draws(3);
        for (int draw = 0; draw < 20; ++draw) {
            View view{.azimuth_rad = radians(static_cast<double>(draws.between(20, 150))),
                      .elevation_rad = radians(20.0),
                      .range_min_m = 1.0,
                      .range_max_m = 25.0,
                      .range_bins = 64,
                      .beams = 13 + static_cast<int>(draws.between(0, 300))};
            Pose pose;
            pose.translation = {1.0, 2.0, 3.0};
            pose.rotation = rotation_from_rpy(0.1, 0.3, static_cast<double>(draws.between(-3, 3)));
            const std::vector<Sight> parts = parts_of(view, pose);
            REQUIRE(parts.size() == 2);
            for (const Sight& part : parts) {
                CHECK(part.view.beams == 6);
                CHECK(part.view.range_bins == view.range_bins);
                // The middle of each beam of the part, in the frame of the whole view.
                int first = -1;
                for (int beam = 0; beam < 6; ++beam) {
                    const double azimuth =
                        part.view.azimuth_rad * ((beam + 0.5) / part.view.beams - 0.5);
                    const Eigen::Vector3d point(10.0 * std::cos(azimuth), 10.0 * std::sin(azimuth),
                                                0.0);
                    REQUIRE(beam_of(part.view, point.cast<float>()) == beam);
                    const Eigen::Vector3d in_whole =
                        pose.rotation.conjugate() * (part.T_world_sensor.rotation * point);
                    const int of_whole = beam_of(view, in_whole.cast<float>());
                    if (beam == 0) first = of_whole;
                    CHECK(of_whole >= 0);
                    CHECK(of_whole == first + beam);
                }
            }
        }
    }

    TEST_CASE("a view of few beams, and one that is no fan, is its only part") {
        View view{.azimuth_rad = 1.0,
                  .elevation_rad = 0.3,
                  .range_min_m = 1.0,
                  .range_max_m = 9.0,
                  .range_bins = 8,
                  .beams = 12};
        CHECK(parts_of(view, {}).size() == 1);
        CHECK(parts_of(view, {}).front().view == view);
        view.beams = 2;
        view.shape = ViewShape::port_starboard;
        CHECK(parts_of(view, {}).front().view == view);
    }
}
