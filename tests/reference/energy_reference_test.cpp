#include "simulate/reference/energy_reference.h"

#include "simulate/reference/image_error.h"
#include "simulate/visibility/make_engine.h"
#include "support/calibrated.h"

using namespace sonarsim;
using namespace sonarsim::test;

namespace {

Sonar coarse_sonar(SonarKind kind) {
    SonarConfig config = calibrated(default_sonar(kind), 4e5);
    config.range_min_m = 0.5;
    config.range_max_m = 12.0;
    config.range_bins = 96;
    config.azimuth_bins = 32;
    return make_sonar(config, {0.01});
}

}  // namespace

TEST_SUITE_BEGIN("validation");

// The rays represent a fully visible floor to within rounding, so their image and that of many
// single points are the same integral.
TEST_CASE("the calibrated reference agrees with the engines") {
    Scene scene = empty_scene();
    const std::uint32_t rock = add_material(scene, 0.4F);
    add_floor(scene, 30.0F, -4.0F, rock, 4);
    add_sphere(scene, {5.0F, 0.5F, -3.5F}, 0.5F, rock, 48);
    const Caster caster(scene);
    Sonar hears_more = coarse_sonar(SonarKind::imaging);
    hears_more.settings.view.elevation_rad = radians(120.0);
    hears_more.settings.guard_beams.count = hears_more.settings.view.beams / 2;
    for (const Sonar& sonar :
         {coarse_sonar(SonarKind::imaging), hears_more, coarse_sonar(SonarKind::sidescan),
          coarse_sonar(SonarKind::echosounder)}) {
        const SonarKind kind = sonar.config.kind;
        const Pose T_world_vehicle{
            rotation_from_rpy(0.0, kind == SonarKind::imaging ? radians(35.0) : 0.0, 0.0),
            Eigen::Vector3d::Zero()};
        const Reference reference =
            cast_energy_reference(caster, scene, sonar.settings,
                                  sensor_pose(sonar, T_world_vehicle, 0), {0.01, 16.0, 30'000'000});
        EngineSettings engine;
        engine.type = EngineKind::rays;
        const Ping ping = render_ping(sonar, scene, *make_engine(scene, engine), T_world_vehicle,
                                      {}, direct_echoes_alone);
        const ImageError error = image_error(ping.intensity, reference.intensity);
        CAPTURE(name_of(kind));
        CAPTURE(sonar.settings.guard_beams.count);
        CAPTURE(reference.moved);
        CHECK(error.relative_l1 < 0.02 + reference.moved);
        CHECK(reference.apart < 0.03);
    }
}

TEST_SUITE_END();
