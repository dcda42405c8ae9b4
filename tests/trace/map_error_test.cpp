#include "trace/map_error.h"

#include <doctest/doctest.h>

#include "support/draws.h"
#include "support/mapped_floor.h"
#include "support/sanitized.h"
#include "trace/lay_maps.h"
#include "trace/traced_ping.h"
#include "visibility/image_change.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE("map error") {
    TEST_CASE("the estimated error of maps covers that against pieces an eighth as large") {
        // Texels of 10 cm, each drawn from -6 to 6 dB. The estimate is one of a part of the
        // samples.
        for (const bool side : {false, true}) {
            Draws draws(21);
            Scene scene = wide_floor();
            const Sonar sonar = side ? sidescan(ModelKind::paper) : imaging(ModelKind::paper);
            const View& view = sonar.settings.view;
            const Pose pose = sensor_pose(sonar, above_floor(), 0);
            const auto engine = make_engine(scene, {.type = EngineKind::slices, .octree = {}});
            const Samples seen = engine->visible_surface(view, pose);
            lay(scene, {}, strengths(square_frame(1, 28.0), [](int, int) { return 2.0F; }));
            CHECK(error_of_maps(scene, view, pose, seen) == 0.0);
            lay(scene, {}, strengths(square_frame(280, 28.0), [&](int, int) {
                    return static_cast<float>(
                        std::pow(10.0, 0.1 * static_cast<double>(draws.between(-6, 6))));
                }));
            const auto image = [&](double size) {
                Samples samples = seen;
                std::vector<Sample> none;
                lay_maps(*scene.maps, view, pose, samples, none, size);
                return mean_echoes(scene, view, samples);
            };
            const double error = image_change(image(1.0), image(0.125));
            const double estimate = error_of_maps(scene, view, pose, seen);
            CAPTURE(side);
            CAPTURE(error);
            CAPTURE(estimate);
            // Strips of a side-scan lie within their bins, and have exact means there.
            CHECK(error < (side ? 2e-4 : 2e-2));
            CHECK(estimate >= (side ? 0.0 : 0.9 * error));
            CHECK(estimate < 4.0 * error);
        }
    }

    TEST_CASE("the estimated error of maps covers that of chequered maps at any heading") {
        // A side-scan meets few borders: an estimate from a part of its samples would miss them.
        Draws draws(22);
        for (int draw = 0; draw < (test::sanitized ? 4 : 24); ++draw) {
            const bool side = draw % 2 == 0;
            Scene scene = wide_floor();
            const Sonar sonar = side ? sidescan(ModelKind::paper) : imaging(ModelKind::paper);
            const View& view = sonar.settings.view;
            const double yaw_deg = static_cast<double>(draws.between(0, 90));
            const Pose pose = sensor_pose(sonar, above_floor(yaw_deg), 0);
            const auto engine = make_engine(scene, {.type = EngineKind::slices, .octree = {}});
            const Samples seen = engine->visible_surface(view, pose);
            const int n = draws.whole(9, 60);
            lay(scene, {}, strengths(square_frame(n, 28.0), [](int row, int column) {
                    return (row + column) % 2 == 0 ? 2.0F : 0.5F;
                }));
            const auto image = [&](double size) {
                Samples samples = seen;
                std::vector<Sample> none;
                lay_maps(*scene.maps, view, pose, samples, none, size);
                return mean_echoes(scene, view, samples);
            };
            const double error = image_change(image(1.0), image(0.0625));
            const double estimate = error_of_maps(scene, view, pose, seen);
            CAPTURE(side);
            CAPTURE(yaw_deg);
            CAPTURE(n);
            CAPTURE(error);
            CAPTURE(estimate);
            constexpr double nothing = 1e-4;  // a hundredth of the finest goal that is asked for
            CHECK(estimate > error - nothing);
            CHECK(estimate < 5.0 * error + nothing);
        }
    }
}
