#include "visibility/slices/fit_range.h"

#include <algorithm>
#include <cmath>

#include "visibility/range_extent.h"

namespace sonarsim {

Extent fit_range(const Eigen::Array4f& range, Sample& sample) {
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
    // Beside the foot of the perpendicular the corners do not tell of the least range. Along t in
    // [-1, 1] of an edge e the range is r + (u t + (e^2 - u^2) t^2 / 2 r): it has no least value
    // within where |u| > (e^2 - u^2) / r, twice the bend. Twice as much leaves room for both edges.
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
