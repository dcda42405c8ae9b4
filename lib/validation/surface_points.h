#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "scene/scene.h"
#include "visibility/local_pose.h"
#include "visibility/view.h"

namespace sonarsim {

/// How many points of a triangle a reference looks at.
struct SurfaceShare {
    static constexpr std::uint32_t no_copy = 0xFFFFFFFFU;

    std::uint32_t facet;     ///< as Caster numbers it: the scene's own triangles, then each copy's
    std::uint32_t triangle;  ///< index into Scene::triangles, or into those of the copy's mesh
    std::uint32_t copy;      ///< index into Scene::copies, or `no_copy`
    float area_m2;
    float
        share;  ///< in proportion: about the number of bins that a thin thing of its length lights
};

/// The corners of the triangle, scene-local.
std::array<Eigen::Vector3f, 3> corners_of(const Scene& scene, const SurfaceShare& share);

/// Every triangle that may lie in view and in range, by ascending facet. A thin thing crosses as
/// many bins as it is long, whatever its area: so shares go by length, and every triangle has one.
/// Where copies have millions of triangles in view, every n-th of theirs has; rays over directions
/// meet the others.
std::vector<SurfaceShare> surface_shares(const Scene& scene, const View& view,
                                         const LocalPose& pose);

/// Point i of those that fill a triangle evenly: two fractions of its edges from the first corner
/// that sum to at most 1. `start` shifts the sequence.
Eigen::Vector2d point_of_triangle(std::uint32_t facet, std::uint32_t i, std::uint32_t start);

}  // namespace sonarsim
