#include "ping/sonar.h"

#include <algorithm>

#include "core/elementary.h"

namespace sonarsim {

double head_angle_rad(const Sonar& sonar, std::uint32_t pose) {
    if (sonar.head_angles_rad.empty()) return 0.0;
    const std::size_t ping = pose / static_cast<std::uint32_t>(sonar.config.every);
    return sonar.head_angles_rad[ping % sonar.head_angles_rad.size()];
}

double column_at(const Sonar& sonar, double azimuth_rad) {
    const View& view = sonar.settings.view;
    if (sonar.equal_azimuth)
        return 0.5 * (1.0 + azimuth_rad / (0.5 * view.azimuth_rad)) * view.beams;
    const std::vector<double>& edges = sonar.azimuth_edges_rad;
    const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, azimuth_rad);
    // The beams of a line array are about equally spaced in sine.
    const double low = sincos(above[-1]).sin;
    const double share = (sincos(azimuth_rad).sin - low) / (sincos(above[0]).sin - low);
    return static_cast<double>(above - edges.begin()) - 1.0 + share;
}

Pose sensor_pose(const Sonar& sonar, const Pose& T_world_vehicle, std::uint32_t pose) {
    Pose T_world_mount = T_world_vehicle * sonar.T_vehicle_sensor;
    if (sonar.head_angles_rad.empty()) return T_world_mount;
    const Pose T_mount_head{rotation_from_rpy(0.0, 0.0, head_angle_rad(sonar, pose)),
                            Eigen::Vector3d::Zero()};
    return T_world_mount * T_mount_head;
}

}  // namespace sonarsim
