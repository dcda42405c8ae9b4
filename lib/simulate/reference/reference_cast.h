#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "input/scene/maps/ground_maps.h"
#include "input/scene/scene.h"
#include "simulate/reference/surface_points.h"
#include "simulate/visibility/caster.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// The scene and the view of a reference.
struct ReferenceView {
    const Caster& caster;
    const Scene& scene;
    const View& view;
    LocalPose pose;
    std::span<const SurfaceShare> shares;  ///< from surface_shares()
};

/// The number and placement of a cast's rays.
struct RayLayout {
    int per_beam;         ///< columns per beam of a fan, per side, or around a cone
    int count;            ///< rays per column
    std::uint32_t start;  ///< casts with different starts are independent
};

/// A point of the visible surface.
struct SurfacePoint {
    Eigen::Vector3f direction;  ///< towards the point, scene-local frame
    double range_m;
    double cosine;   ///< cosine of the angle of incidence
    double area_m2;  ///< area of surface that it represents
    int beam;
    Facet facet;
};

/// The material of a point, from a map if one lies on it.
MappedPoint surface_at(const SurfacePoint& point, const Scene& scene, const LocalPose& pose);

using PointSink = std::function<void(const SurfacePoint&)>;

/// Casts rays in two ways, about twice as many over the directions of the view as to points of the
/// surface, and weights each ray by the density of both. Rays over directions find wide objects and
/// may miss thin ones; rays to points find a wire of any thinness, since every triangle has
/// points. The expected number of rays that meet a patch of area A is d A, where d is the sum of
///
///     (v . n) / (r^2 dOmega)   for one ray per dOmega, and
///     n / area                 for n points on the triangle's area;
///
/// so every ray represents an area of 1 / d (the balance heuristic of Veach and Guibas, SIGGRAPH
/// 1995), and sums over the points are unbiased whatever the shares. Returns the number of rays
/// cast. Calls `found` with the points within 1 % beyond the greatest range.
std::uint64_t cast_over_surface(const ReferenceView& looking, const RayLayout& layout,
                                const PointSink& found);

}  // namespace sonarsim
