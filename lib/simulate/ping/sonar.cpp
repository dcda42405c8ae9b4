#include "simulate/ping/sonar.h"

#include <algorithm>

#include "core/elementary.h"

namespace sonarsim {

namespace {

Ping form_group(const TracedPing& traced, const PingSettings& settings, const Scene& scene,
                const PingKey& key, int group, const Terms& terms) {
    Ping ping;
    ping.range_bins = settings.view.range_bins;
    ping.beams = settings.view.beams;
    ping.intensity.resize(static_cast<std::size_t>(ping.range_bins) * ping.beams);
    ping.counts = traced.counts;
    ping.seconds = traced.seconds;
    if (!terms.multipath) ping.counts.multipath = {};
    settings.model->form(traced,
                         {.view = settings.view,
                          .scene = scene,
                          .draws = {.seed = key.seed,
                                    .sensor = settings.stream,
                                    .ping = key.ping,
                                    .group = static_cast<std::uint32_t>(group)},
                          .terms = terms},
                         ping);
    return ping;
}

}  // namespace

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

Ping form_image(const TracedPing& traced, const PingSettings& settings, const Scene& scene,
                const PingKey& key, const Terms& terms) {
    const auto form = [&](const TracedPing& group, int number) {
        return form_group(group, settings, scene, key, number, terms);
    };
    const auto take_beam = [](const Ping& from, int beam, Ping& to) {
        for (auto at = static_cast<std::size_t>(beam); at < to.intensity.size();
             at += static_cast<std::size_t>(to.beams))
            to.intensity[at] = from.intensity[at];
    };
    const auto add_counts = [](const Ping& from, Ping& to) {
        to.counts += from.counts;
        to.seconds += from.seconds;
    };
    Ping ping = by_groups(traced, form, take_beam, add_counts);
    divide(ping.counts, 1 + traced.later_groups.size());
    return ping;
}

}  // namespace sonarsim
