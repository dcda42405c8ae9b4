#pragma once

#include "input/mission/parse.h"
#include "support/calibrated.h"
#include "support/patches.h"

namespace sonarsim::test {

/// A sonar by a preset of configs/sensors, with these keys in place of its own, without what closed
/// forms lack: texture, reverberation and the floor of the lobes.
inline Sonar preset_sonar(const std::string& preset, const std::string& keys) {
    const std::string text =
        "scene: {file: a.glb, materials: a.csv}\n"
        "trajectory: {file: a.tum}\n"
        "sensors:\n"
        "  fls:\n"
        "    preset: sensors/" +
        preset + ".yaml\n" + keys;
    const Mission mission =
        parse_mission(text, "m.yaml", source_folder() / "configs", {}, sonar_keys());
    SonarConfig config = mission.sensors.front();
    config.instrument.speckle.texture = 0.0;
    config.instrument.receiver.reverberation_s = 0.0;
    config.instrument.beam.lobe_floor_db = no_lobe_floor_db;
    return make_sonar(config, mission.accuracy, mission.water);
}

/// The receiving array of a preset.
inline LineArray array_of(const Sonar& sonar) {
    const BeamConfig& beam = sonar.config.instrument.beam;
    LineArray array = line_array(radians(beam.width_deg), beam.side_lobe_db);
    array.quadratic_rad = beam.aberration_rad[0];
    array.cubic_rad = beam.aberration_rad[1];
    array.quartic_rad = beam.aberration_rad[2];
    return array;
}

/// A rectangle about `centre` in square patches, as it is seen from a pose. Edges have the
/// directions `along_u` and `along_v` and half lengths of `half_u_m` and `half_v_m`.
inline Samples patches(const Eigen::Vector3d& centre, const Eigen::Vector3d& along_u,
                       const Eigen::Vector3d& along_v, double half_u_m, double half_v_m,
                       double patch_m, const Pose& T_world_sensor = {}) {
    const Eigen::Quaterniond R_sensor_world = T_world_sensor.rotation.conjugate();
    const auto turned = [&](const Eigen::Vector3d& v) -> Eigen::Vector3f {
        return (R_sensor_world * v).cast<float>();
    };
    Samples out;
    for (double u = -half_u_m; u < half_u_m; u += patch_m) {
        for (double v = -half_v_m; v < half_v_m; v += patch_m) {
            const Eigen::Vector3d place =
                centre + (u + 0.5 * patch_m) * along_u + (v + 0.5 * patch_m) * along_v;
            out.items.push_back(
                patch_of(turned(place - T_world_sensor.translation), turned(along_u.cross(along_v)),
                         turned(0.5 * patch_m * along_u), turned(0.5 * patch_m * along_v)));
        }
    }
    return out;
}

/// The image [range bins, beams] of what is seen from a pose, without the receiver's noise.
inline std::vector<float> quiet_image(const Sonar& sonar, const Samples& samples, bool speckle,
                                      const Pose& pose = {}, std::uint32_t seed = 1) {
    return image_of_samples(calibrated_model_of(sonar), sonar.settings.view, samples,
                            {.random = std::size_t{speckle}}, pose, {seed, 1, 0});
}

}  // namespace sonarsim::test
