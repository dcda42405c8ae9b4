#include "simulate/trace/wake.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace sonarsim {

namespace {

Sample sample_of(const Eigen::Vector3f& place, float section_m2, SampleKind kind) {
    return {.position = place,
            .edge_u = Eigen::Vector3f::Zero(),
            .edge_v = Eigen::Vector3f::Zero(),
            .normal = -place.normalized(),
            .height_m = place.norm(),
            .area_m2 = section_m2,
            .material = 0,
            .instance = 0,
            .kind = kind};
}

}  // namespace

double length_within(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from,
                     const Eigen::Vector3d& to) {
    const Eigen::Array3d way = (to - from).array();
    const Eigen::Array3d one = (box.min() - from).array() / way;
    const Eigen::Array3d other = (box.max() - from).array() / way;
    const double begin = std::max(one.min(other).maxCoeff(), 0.0);
    const double end = std::min(one.max(other).minCoeff(), 1.0);
    return std::max(end - begin, 0.0) * way.matrix().norm();
}

void Wake::add(const TraceContext& context, const PingMotion& /*motion*/, std::uint32_t /*pose*/,
               Samples& samples) const {
    const Pose& T_world_sensor = context.T_world_sensor;
    const Eigen::Vector3d& sonar = T_world_sensor.translation;
    const Eigen::Quaterniond to_sensor = T_world_sensor.rotation.conjugate();
    std::vector<Sample> own;
    std::vector<SightPoint> sights;
    const Eigen::Array3d from = config_.box_m.min().array() + 0.5 * config_.cell_m;
    const auto section = static_cast<float>(config_.scattering_per_m * std::pow(config_.cell_m, 3));
    for (double x = from.x(); x < config_.box_m.max().x(); x += config_.cell_m) {
        for (double y = from.y(); y < config_.box_m.max().y(); y += config_.cell_m) {
            for (double z = from.z(); z < config_.box_m.max().z(); z += config_.cell_m) {
                const Eigen::Vector3d place = to_sensor * (Eigen::Vector3d(x, y, z) - sonar);
                own.push_back(sample_of(place.cast<float>(), section, kind_));
                sights.push_back({own.back().position});
            }
        }
    }
    const std::vector<bool> visible = context.engine.visible(T_world_sensor, sights);
    for (std::size_t k = 0; k < own.size(); ++k) {
        if (visible[k]) samples.items.push_back(own[k]);
    }
    for (Sample& sample : samples.items) {
        const Eigen::Vector3d place = T_world_sensor.rotation * sample.position.cast<double>();
        const double length = length_within(config_.box_m, sonar, sonar + place);
        sample.strength *= std::exp(-2.0F * config_.absorption_per_m * static_cast<float>(length));
    }
}

}  // namespace sonarsim
