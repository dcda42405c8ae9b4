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
    return floor_scene(15.0F, 0.0F, 0.2F, 6);
}

/// The floor in fields of 2 cm, of materials of 0.1 and 0.3 or of strengths of 0.4 and 1.6, which
/// send back as much as the plain one of 0.2.
struct SmallFields {
    Scene plain = wide_floor();
    Scene by_material, by_strength;

    SmallFields() {
        const std::uint32_t dark = add_material(plain, 0.1F);
        const std::uint32_t bright = add_material(plain, 0.3F);
        for (Material& material : plain.materials) {
            material.slope_rms_deg = 0.0;
            material.lambert_db = db(static_cast<double>(material.reflection));
        }
        by_material = by_strength = plain;
        const TexelFrame frame = square_frame(1400, 28.0);
        lay(by_material,
            material_texels(
                frame, {dark, bright},
                [](int row, int column) { return static_cast<std::uint16_t>((row + column) % 2); }),
            {});
        lay(by_strength, {}, strengths(frame, [](int row, int column) {
                return (row + column) % 2 == 0 ? 0.4F : 1.6F;
            }));
    }
};

/// 3 m above the floor and not over a border, heading off the axes.
inline Pose above_floor(double yaw_deg = 20.0) {
    return {rotation_from_rpy(0.0, 0.0, radians(yaw_deg)), {0.3, -0.4, 3.0}};
}

inline Sonar imaging(ModelKind model, int bins = 80) {
    SonarConfig config = small_imaging();
    if (model == ModelKind::calibrated) config = bare_sonar(config, 900e3);
    config.noise.gain = 1.0;
    config.elevation_deg = 40.0;
    set_range(config, 4.0, 12.0, bins);
    config.azimuth_bins = 32;
    config.mount.rpy_deg = {0.0, 30.0, 0.0};
    return make_sonar(config, {0.01});
}

inline Sonar sidescan(ModelKind model, double bin_m = 0.05) {
    SonarConfig config = default_sonar(SonarKind::sidescan);
    if (model == ModelKind::calibrated) config = bare_sonar(config, 400e3);
    config.noise.gain = 1.0;
    set_range(config, 3.5, 12.5, static_cast<int>(std::lround(9.0 / bin_m)));
    return make_sonar(config, {0.01});
}

}  // namespace sonarsim::test
