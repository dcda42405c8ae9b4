#include "trace/map_error.h"

#include <doctest/doctest.h>

#include "support/draws.h"
#include "support/mapped_floor.h"
#include "trace/lay_maps.h"
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
            CHECK(error > 0.01);
            CHECK(estimate > 0.9 * error);
            CHECK(estimate < 4.0 * error);
        }
    }
}
