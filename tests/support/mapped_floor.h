#pragma once

#include "support/calibrated.h"
#include "support/labelled.h"
#include "support/maps.h"

namespace sonarsim::test {

inline double db(double ratio) {
    return 10.0 * std::log10(ratio);
}

/// A floor of 30 x 30 m at z = 0.
inline Scene wide_floor() {
    Scene scene = empty_scene();
    add_floor(scene, 15.0F, 0.0F, add_material(scene, 0.2F), 6);
    return scene;
}

/// 3 m above the floor and not over a border, heading off the axes.
inline Pose above_floor(double yaw_deg = 20.0) {
    return {rotation_from_rpy(0.0, 0.0, radians(yaw_deg)), {0.3, -0.4, 3.0}};
}

inline Sonar imaging(ModelKind model, int bins = 80) {
    SonarConfig config = small_imaging();
    if (model == ModelKind::calibrated) {
        config = calibrated(config, 900e3);
        config.instrument = bare(config.instrument);
    }
    config.noise.gain = 1.0;
    config.elevation_deg = 40.0;
    config.range_min_m = 4.0;
    config.range_max_m = 12.0;
    config.range_bins = bins;
    config.azimuth_bins = 32;
    config.mount.rpy_deg = {0.0, 30.0, 0.0};
    return make_sonar(config, {0.01});
}

inline Sonar sidescan(ModelKind model, double bin_m = 0.05) {
    SonarConfig config = default_sonar(SonarKind::sidescan);
    if (model == ModelKind::calibrated) {
        config = calibrated(config, 400e3);
        config.instrument = bare(config.instrument);
    }
    config.noise.gain = 1.0;
    config.range_min_m = 3.5;
    config.range_max_m = 12.5;
    config.range_bins = static_cast<int>(std::lround(9.0 / bin_m));
    return make_sonar(config, {0.01});
}

inline std::vector<float> clean_image(const Sonar& sonar, const Scene& scene, EngineKind type,
                                      const Pose& pose) {
    const auto engine = make_engine(scene, {.type = type, .octree = {}});
    return render_ping(sonar, scene, *engine, pose, {.seed = 1, .ping = 0}, direct_echoes_alone)
        .intensity;
}

}  // namespace sonarsim::test
