#include "visibility/slices/fit_range.h"

#include <algorithm>
#include <cmath>

#include "visibility/range_extent.h"

namespace sonarsim {

Interval fit_range(const Eigen::Array4f& range, Sample& sample) {
    const float r = sample.position.norm();
    const float u = sample.position.dot(sample.edge_u) / r;
    const float v = sample.position.dot(sample.edge_v) / r;
    const float depth_u = std::fabs(u);
    const float depth_v = std::fabs(v);
    const bool by_u = depth_u > depth_v;
    const float deeper = by_u ? depth_u : depth_v;
    const float edge_u = sample.edge_u.squaredNorm();
    const float edge_v = sample.edge_v.squaredNorm();
    const float bend = (edge_u - depth_u * depth_u + edge_v - depth_v * depth_v) / (2.0F * r);
    // If the foot of the perpendicular lies on the patch, the corners do not give the least range.
    // Along an edge e with t in [-1, 1] the range is r + (u t + (e^2 - u^2) t^2 / 2 r): it has no
    // minimum inside if |u| > (e^2 - u^2) / r, twice the bend. Four times the bend allows for both
    // edges.
    if (!(deeper > 4.0F * bend)) {
        const RangeExtent along_u = extent_of(edge_u, depth_u, r);
        const RangeExtent along_v = extent_of(edge_v, depth_v, r);
        return {r - along_u.before - along_v.before, r + along_u.after + along_v.after};
    }
    const float nearest = range.minCoeff();
    const float farthest = range.maxCoeff();
    const float more = 0.5F * (farthest - nearest) - depth_u - depth_v;
    const float shift = 0.5F * (farthest + nearest) - r - bend;
    Eigen::Vector3f& edge = by_u ? sample.edge_u : sample.edge_v;
    const float limit = 0.5F * deeper;
    sample.position += std::clamp(shift, -limit, limit) / (by_u ? u : v) * edge;
    edge *= 1.0F + std::clamp(more, -limit, limit) / deeper;
    return {nearest, farthest};
}

}  // namespace sonarsim
