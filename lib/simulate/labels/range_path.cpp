#include "simulate/labels/range_path.h"

#include "simulate/trace/arrivals.h"
#include "simulate/trace/taper.h"
#include "simulate/visibility/range_extent.h"

namespace sonarsim {

RangePath range_path(const EchoPatch& patch) {
    const auto [range, d] = arrival_of(patch.position);
    const float u = d.dot(patch.edge_u);
    const float v = d.dot(patch.edge_v);
    const RangeExtent along_u = extent_of(patch.edge_u.squaredNorm(), std::fabs(u), range);
    const RangeExtent along_v = extent_of(patch.edge_v.squaredNorm(), std::fabs(v), range);
    const double depth_2 = static_cast<double>(u) * u + static_cast<double>(v) * v;
    Eigen::Vector3f path = Eigen::Vector3f::Zero();
    if (depth_2 > 0.0) {
        path = (u * patch.edge_u + v * patch.edge_v) / static_cast<float>(depth_2);
    }
    const auto [before, after] = wedge_extent(patch.wedge, u, v);
    return {.range_m = range,
            .before_m = before * (along_u.before + along_v.before),
            .after_m = after * (along_u.after + along_v.after),
            .depth_m = std::max(before, after) * (std::fabs(u) + std::fabs(v)),
            .bend = path.squaredNorm(),
            .per_range = path};
}

}  // namespace sonarsim
