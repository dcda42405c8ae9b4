#pragma once

#include <algorithm>
#include <optional>

#include "simulate/visibility/engine.h"

namespace sonarsim {

/// A footprint is a trapezoid: its sides are two fixed angles across, so its width grows with the
/// distance from the axis about which these angles turn. At the end of `edge_u` its width is 1 + u
/// of the mean, at the other end 1 - u.
struct Taper {
    float u = 0.0F, v = 0.0F;
};

/// The taper of a footprint in a view of this shape; none without a shape. With ranges from r to
/// 1.3 r, as engines leave patches on flat ground, the width differs by 13 % from that of a
/// parallelogram. Strips of a cone lie between parallel lines.
inline Taper taper_of(const Sample& sample, std::optional<ViewShape> shape) {
    if (!shape || (*shape == ViewShape::cone && !sample.widens_from_axis)) return {};
    Eigen::Vector3f from_axis = sample.position;
    if (*shape == ViewShape::fan) from_axis.z() = 0.0F;
    if (*shape == ViewShape::cone) from_axis.x() = 0.0F;
    const float distance2 = from_axis.squaredNorm();
    if (!(distance2 > 0.0F)) return {};
    const float u = from_axis.dot(sample.edge_u) / distance2;
    const float v = from_axis.dot(sample.edge_v) / distance2;
    // A footprint that reaches the axis has no width there.
    const float reach = std::max(1.0F, std::fabs(u) + std::fabs(v));
    return {u / reach, v / reach};
}

/// The taper of a footprint with its wedge. Where both narrow one end, it has no width there.
inline Taper trapezoid_of(const Sample& sample, std::optional<ViewShape> shape) {
    Taper out = taper_of(sample, shape);
    out.u = std::clamp(out.u + sample.wedge, -1.0F, 1.0F);
    return out;
}

/// The middle about which a footprint is cut along `edge_u`: the wedge's pieces have its centroid.
inline Eigen::Vector3f middle_of(const Sample& sample, int parts) {
    const float thinner = 1.0F / static_cast<float>(parts);
    return sample.position - sample.wedge / 3.0F * (1.0F - thinner * thinner) * sample.edge_u;
}

/// The extents of a footprint on either side of its centroid along a direction, over |u| + |v|.
struct WedgeExtent {
    float before = 1.0F, after = 1.0F;
};

/// The corners of a wedge lie (+-1 - wedge / 3) u +- (1 +- wedge) v from its centroid.
inline WedgeExtent wedge_extent(float wedge, float u, float v) {
    const float depth = std::fabs(u) + std::fabs(v);
    if (wedge == 0.0F || !(depth > 0.0F)) return {};
    const auto reach = [&](float along) {
        return std::max(along * (1.0F - wedge / 3.0F) + (1.0F + wedge) * std::fabs(v),
                        -along * (1.0F + wedge / 3.0F) + (1.0F - wedge) * std::fabs(v)) /
               depth;
    };
    return {reach(-u), reach(u)};
}

}  // namespace sonarsim
