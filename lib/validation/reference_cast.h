#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "scene/scene.h"
#include "validation/surface_points.h"
#include "visibility/caster.h"
#include "visibility/local_pose.h"
#include "visibility/view.h"

namespace sonarsim {

/// What a reference looks at.
struct ReferenceView {
    const Caster& caster;
    const Scene& scene;
    const View& view;
    LocalPose pose;
    std::span<const SurfaceShare> shares;  ///< of surface_shares()
};

/// Where the rays of a cast go.
struct RayLayout {
    int per_beam;         ///< columns: of each beam of a fan, on either side, around a cone
    int count;            ///< rays of a column
    std::uint32_t start;  ///< 0: a lattice; above: each ray anywhere in its cell of that lattice
};

/// A point of the visible surface.
struct SurfacePoint {
    Eigen::Vector3f direction;  ///< to it, scene-local frame
    double range_m;
    double cosine;   ///< of the angle of incidence
    double area_m2;  ///< of the surface that it stands for
    int beam;
    Facet facet;
};

using PointSink = std::function<void(const SurfacePoint&)>;

/// Casts rays in two ways, about twice as many over the directions of the view as to points of the
/// surface, and weighs each ray by both. Rays over directions see what is wide, and see through
/// gaps; rays to points find a wire of any thinness, since every triangle has points. A piece of
/// surface of area A is met by d A rays of the two together, where d is the sum of
///
///     (v . n) / (r^2 dOmega)   of one ray for every dOmega, and
///     n / area                 of n points on the triangle's area;
///
/// so every ray stands for 1 / d of surface (the balance heuristic of Veach and Guibas, SIGGRAPH
/// 1995), and sums over the points are right on average however the shares are chosen. Returns how
/// many rays were cast; `found` is given those that met surface within 1 % of the greatest range.
std::uint64_t cast_over_surface(const ReferenceView& looking, const RayLayout& layout,
                                const PointSink& found);

}  // namespace sonarsim
