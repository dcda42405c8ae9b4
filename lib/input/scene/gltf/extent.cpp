#include "input/scene/gltf/extent.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "core/input_limits.h"

namespace sonarsim {

namespace {

/// The rounding of a float of this size: half a unit in the last place.
double half_unit(double x) {
    int exponent = 0;
    std::frexp(x, &exponent);
    return x == 0.0 ? 0.0 : std::ldexp(1.0, exponent - 25);
}

}  // namespace

SurfaceExtent find_extent(const OpenFile& file, ReadingLimit& limit) {
    SurfaceExtent extent;
    for_each_primitive(file, limit, [&extent](const PlacedPrimitive& primitive) {
        Eigen::Vector3d farthest = Eigen::Vector3d::Zero();  // in the mesh's own axes
        std::vector<Eigen::Vector3d> placed = primitive.positions;
        for (Eigen::Vector3d& point : placed)
            point = primitive.mesh.T_world_mesh * point;
        for (const auto& [a, b, c] : primitive.triangles) {
            const std::array points{placed[a], placed[b], placed[c]};
            if (!is_finite(points) || !has_area(points)) continue;
            for (const std::uint32_t vertex : {a, b, c}) {
                farthest = farthest.cwiseMax(primitive.positions[vertex].cwiseAbs());
                if (placed[vertex].cwiseAbs().maxCoeff() > furthest_m) {
                    throw InputError(primitive.where +
                                     ": a vertex lies more than 1e8 m from the origin");
                }
                extent.box.extend(placed[vertex]);
            }
        }
        if (!primitive.has_floats) return;  // integers are exact
        const Eigen::Vector3d off =
            primitive.mesh.T_world_mesh.linear().cwiseAbs() * farthest.unaryExpr(&half_unit);
        extent.vertex_rounding_m = std::max(extent.vertex_rounding_m, off.maxCoeff());
    });
    return extent;
}

SurfaceExtent moved(const SurfaceExtent& extent, const Eigen::Affine3d& transform) {
    if (extent.box.isEmpty()) return extent;
    SurfaceExtent out;
    for (int corner = 0; corner < 8; ++corner) {
        out.box.extend(transform *
                       extent.box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(corner)));
    }
    if (out.box.min().cwiseAbs().cwiseMax(out.box.max().cwiseAbs()).maxCoeff() > furthest_m)
        throw InputError("an object lies more than 1e8 m from the origin");
    out.vertex_rounding_m =
        extent.vertex_rounding_m * transform.linear().cwiseAbs().rowwise().sum().maxCoeff();
    return out;
}

}  // namespace sonarsim
