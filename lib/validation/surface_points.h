#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "scene/scene.h"
#include "visibility/local_pose.h"
#include "visibility/view.h"

namespace sonarsim {

/// How many points of a triangle a reference looks at.
struct SurfaceShare {
    std::uint32_t triangle;
    float area_m2;
    float
        share;  ///< in proportion: about the number of bins that a thin thing of its length lights
};

/// Every triangle that may lie in view and in range. A thin thing crosses as many bins as it is
/// long, whatever its area: so shares go by length, and every triangle has one.
std::vector<SurfaceShare> surface_shares(const Scene& scene, const View& view,
                                         const LocalPose& pose);

/// Point i of those that fill a triangle evenly: two fractions of its edges from the first corner
/// that sum to at most 1. `start` shifts the sequence.
Eigen::Vector2d point_of_triangle(std::uint32_t triangle, std::uint32_t i, std::uint32_t start);

}  // namespace sonarsim
