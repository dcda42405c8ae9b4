#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/pose.h"
#include "scene/scene.h"
#include "visibility/view.h"

namespace sonarsim::test {

// Bodies near a wall or under the water's surface, and their ghosts: the echoes over that second
// surface. Each facet of a body has its ghost in bins of its own.

struct Ghost {
    std::string shape;  ///< "ball", "box", "cylinder", "balls"
    Scene scene;        ///< with a wall behind the body, or a water surface above it
    Pose T_world_sensor;
};

/// Draws scene `number`: the body, its facets, place and pose, the second surface, and the sonar's
/// pose. The same number gives the same scene.
Ghost draw_ghost(std::uint32_t number);

/// The multipath image [range bins, beams] of paths from about `rays` random directions of the
/// view, each followed by itself: a brute-force reference.
std::vector<float> ghost_reference(const Ghost& ghost, const View& view, std::uint32_t rays);

/// The number of bins with an echo.
int occupied_bins(const std::vector<float>& image);

/// A ping's multipath against the reference.
struct GhostError {
    double missed = 0.0;       ///< share of the reference's bins that are empty in the ping
    double by_mistake = 0.0;   ///< share of the ping's bins that are empty in the reference
    double relative_l1 = 0.0;  ///< error of the multipath image
};

/// Traces the ghost by the exact method with rays at the view's goal.
GhostError ghost_error(const Ghost& ghost, const View& view, int columns_per_beam,
                       const std::vector<float>& reference);

}  // namespace sonarsim::test
