#include "simulate/ping/sonar.h"

#include <algorithm>

#include "core/elementary.h"

namespace sonarsim {

double head_angle_rad(const Sonar& sonar, std::uint32_t pose) {
    if (sonar.head_angles_rad.empty()) return 0.0;
    const std::size_t ping = pose / static_cast<std::uint32_t>(sonar.config.every);
    return sonar.head_angles_rad[ping % sonar.head_angles_rad.size()];
}

ColumnFinder::ColumnFinder(const Sonar& sonar) : sonar_(sonar) {
    for (const double edge_rad : sonar.azimuth_edges_rad)
        sines_.push_back(sincos(edge_rad).sin);
}

double ColumnFinder::operator()(double azimuth_rad) const {
    const View& view = sonar_.settings.view;
    if (sonar_.equal_azimuth)
        return 0.5 * (1.0 + azimuth_rad / (0.5 * view.azimuth_rad)) * view.beams;
    const std::vector<double>& edges = sonar_.azimuth_edges_rad;
    const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, azimuth_rad);
    const auto column = static_cast<std::size_t>(above - edges.begin() - 1);
    // The beams of a line array are about equally spaced in sine.
    const double low = sines_[column];
    const double share = (sincos(azimuth_rad).sin - low) / (sines_[column + 1] - low);
    return static_cast<double>(column) + share;
}

Pose sensor_pose(const Sonar& sonar, const Pose& T_world_vehicle, std::uint32_t pose) {
    Pose T_world_mount = T_world_vehicle * sonar.T_vehicle_sensor;
    if (sonar.head_angles_rad.empty()) return T_world_mount;
    const Pose T_mount_head{rotation_from_rpy(0.0, 0.0, head_angle_rad(sonar, pose)),
                            Eigen::Vector3d::Zero()};
    return T_world_mount * T_mount_head;
}

}  // namespace sonarsim
