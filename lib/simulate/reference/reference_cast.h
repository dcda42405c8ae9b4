#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "input/scene/maps/ground_maps.h"
#include "input/scene/scene.h"
#include "simulate/visibility/caster.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// The share of a reference's points that a triangle gets.
struct SurfaceShare {
    static constexpr std::uint32_t no_copy = 0xFFFFFFFFU;

    std::uint32_t facet;  ///< number in Caster: the scene's own triangles, then each copy's
    /// Index into Scene::triangles, or into the triangles of the copy's mesh.
    std::uint32_t triangle;
    std::uint32_t copy;  ///< index into Scene::copies, or `no_copy`
    float area_m2;
    float share;  ///< in proportion to the number of bins that a thin object of its length occupies
};

std::array<Eigen::Vector3f, 3> corners_of(const Scene& scene, const SurfaceShare& share);

/// The shares of every triangle that may be in view and in range, by ascending facet. A thin object
/// crosses bins in proportion to its length, not its area, so shares follow length, and every
/// triangle has one. If copies have millions of triangles in view, only every n-th of these has a
/// share; rays over directions meet the others.
std::vector<SurfaceShare> surface_shares(const Scene& scene, const View& view,
                                         const LocalPose& pose);

/// Point i of a sequence that fills a triangle evenly: two fractions of its edges from the first
/// corner that sum to at most 1. `start` shifts the sequence.
Eigen::Vector2d point_of_triangle(std::uint32_t facet, std::uint32_t i, std::uint32_t start);

struct ReferenceView {
    const Caster& caster;
    const Scene& scene;
    const View& view;
    const Pose& T_world_sensor;
    LocalPose pose = local_pose(T_world_sensor, scene.origin);
    std::vector<SurfaceShare> shares = surface_shares(scene, view, pose);
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
