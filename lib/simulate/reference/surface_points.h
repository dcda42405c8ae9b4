#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "input/scene/scene.h"
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

/// The corners of the triangle, scene-local.
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

}  // namespace sonarsim
