// Labels of what lies behind thin walls.

#include "support/calibrated.h"
#include "support/labelled.h"

// A tall wall stands on a floor. The bins behind it are in its shadow with or without the floor's
// echo through it, and the label of that echo is the floor.
TEST_CASE("thin walls: shadows stay, and the echo in them is the floor's") {
    SonarConfig config = bare_sonar(small_imaging(), 4e5);
    Scene scene = floor_scene(12.0F, -1.0F, 0.4F, 4);
    const std::uint32_t wall = add_material(scene, 0.1F);
    scene.materials[wall].density_kg_m3 = 950.0;
    scene.materials[wall].sound_speed_m_s = 2460.0;
    add_rectangle(scene, {6, -1, -1}, {6, 1, 2}, wall);
    for (const EngineKind engine : engine_types) {
        const auto labelled = [&] {
            Sonar sonar = make_sonar(config, {});
            prepare_for(scene, sonar);
            return label(scene, sonar, pitched(8.0), engine).labels;
        };
        scene.materials[wall].wall_mm.reset();
        const PingLabels opaque = labelled();
        scene.materials[wall].wall_mm = 4.0;
        const PingLabels thin = labelled();
        CHECK(thin.shadow == opaque.shadow);
        CHECK(thin.visible_share == opaque.visible_share);
        std::map<int, int> before, now;  // the objects of the bins in the wall's shadow
        for (std::size_t k = 0; k < thin.size(); ++k) {
            if (thin.shadow[k] != 2) continue;
            ++before[opaque.object[k]];
            ++now[thin.object[k]];
        }
        CHECK(before.size() == 1);
        CHECK(before[0] > 200);
        CHECK(now[1] > 0.9 * before[0]);
        CHECK(now[2] == 0);
    }
}
