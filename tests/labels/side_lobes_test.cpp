// Labels of a calibrated side-scan sonar, whose traced view is wider than its beam.
#include <doctest/doctest.h>

#include <cmath>

#include "support/calibrated.h"
#include "support/labelled.h"
#include "support/scenes.h"

using namespace sonarsim;
using namespace sonarsim::test;

TEST_SUITE_BEGIN("ping");

TEST_CASE("side-scan labels: surface in side lobes does not brighten a shadow") {
    // The sensor's x axis points down, y to port, z along the track. The floor lies 3 m below. A
    // plate 6 m to port stands 1 m high and hides the floor from y = 6 to y = 9, at ranges from
    // sqrt(45) to sqrt(90) m. It is 0.3 m long: the main lobe of 0.5 degrees is 0.06 m wide there
    // at -3 dB, the traced view of 4 degrees 0.47 m.
    SonarConfig config = calibrated(default_sonar(SonarKind::sidescan), 4e5);
    config.name = "sss";
    config.range_max_m = 12.0;
    config.range_bins = 240;
    config.elevation_deg = 8.0;
    config.instrument = bare(config.instrument);
    config.instrument.beam.width_deg = 1.5;
    Sonar sonar = make_sonar(config, {0.02});
    sonar.T_vehicle_sensor = Pose{};
    Scene scene = empty_scene();
    const std::uint32_t m = add_material(scene, 0.4F);
    add_quad(scene, {3, -30, -30}, {3, 30, -30}, {3, 30, 30}, {3, -30, 30}, m);
    add_quad(scene, {2, 6, -0.3F}, {3, 6, -0.3F}, {3, 6, 0.3F}, {2, 6, 0.3F}, m);
    Scene bare_floor = scene;
    bare_floor.triangles.resize(2);
    bare_floor.triangle_material.resize(2);
    bare_floor.triangle_instance.resize(2);
    for (const EngineKind type : {EngineKind::slices, EngineKind::rays}) {
        CAPTURE(type);
        const Labelled out = label(scene, sonar, Pose{}, type);
        const Labelled open = label(bare_floor, sonar, Pose{}, type);
        constexpr int port = 1;
        for (int i = 0; i < out.labels.range_bins; ++i) {
            CAPTURE(i);
            const std::size_t at = out.at(i, port);
            const bool dark =
                i > bin_at(sonar, std::sqrt(45.0)) + 1 && i < bin_at(sonar, std::sqrt(90.0)) - 1;
            if (dark) CHECK(out.labels.shadow[at] > 0);
            if (dark) CHECK(out.labels.object[at] == 0);
            CHECK(open.labels.shadow[at] == 0);
        }
    }
}

TEST_SUITE_END();
