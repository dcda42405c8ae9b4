#include "ping/sonar.h"

#include "core/elementary.h"

namespace sonarsim {

double head_angle_rad(const Sonar& sonar, std::uint32_t pose) {
    if (sonar.head_angles_rad.empty()) return 0.0;
    const std::size_t ping = pose / static_cast<std::uint32_t>(sonar.config.every);
    return sonar.head_angles_rad[ping % sonar.head_angles_rad.size()];
}

double column_at(const Sonar& sonar, double azimuth_rad) {
    const View& view = sonar.settings.view;
    const double half = 0.5 * view.azimuth_rad;
    const double share =
        sonar.equal_sine ? sincos(azimuth_rad).sin / sincos(half).sin : azimuth_rad / half;
    return 0.5 * (1.0 + share) * view.beams;
}

Pose sensor_pose(const Sonar& sonar, const Pose& T_world_vehicle, std::uint32_t pose) {
    Pose T_world_mount = T_world_vehicle * sonar.T_vehicle_sensor;
    if (sonar.head_angles_rad.empty()) return T_world_mount;
    const Pose T_mount_head{rotation_from_rpy(0.0, 0.0, head_angle_rad(sonar, pose)),
                            Eigen::Vector3d::Zero()};
    return T_world_mount * T_mount_head;
}

}  // namespace sonarsim
