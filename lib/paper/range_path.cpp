#include "paper/range_path.h"

#include "paper/footprint.h"
#include "trace/arrivals.h"

namespace sonarsim {

RangePath range_path(const Sample& sample, const Eigen::Vector3f& axis) {
    const auto [range, departure, d] = arrival_of(sample.position);
    const float u = d.dot(sample.edge_u);
    const float v = d.dot(sample.edge_v);
    const RangeExtent along_u = extent_of(sample.edge_u.squaredNorm(), std::fabs(u), range);
    const RangeExtent along_v = extent_of(sample.edge_v.squaredNorm(), std::fabs(v), range);
    const double depth_2 = static_cast<double>(u) * u + static_cast<double>(v) * v;
    Eigen::Vector3f path = Eigen::Vector3f::Zero();
    if (depth_2 > 0.0) {
        path = (u * sample.edge_u + v * sample.edge_v) / static_cast<float>(depth_2);
    }
    return {.range_m = range,
            .rise_m = sample.position.dot(axis),
            .before_m = along_u.before + along_v.before,
            .after_m = along_u.after + along_v.after,
            .depth_m = std::fabs(u) + std::fabs(v),
            .bend = path.squaredNorm(),
            .slope = path.dot(axis)};
}

double echo_of(const Sample& sample, double range_m, const Material& material) {
    const double reflection = material.reflection;
    return sample.area_m2 * reflection * std::min(sample.height_m / range_m, 1.0);
}

}  // namespace sonarsim
