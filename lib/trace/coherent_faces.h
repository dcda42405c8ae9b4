#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

// The surface of a scene whose materials reflect coherently. Positions are m relative to
// Scene::origin.

namespace sonarsim {

/// A flat face: triangles of one instance and one material that join in one plane. The surface ends
/// or has a crease at its border, so the facets of a curved surface are no plates.
struct ScenePlate {
    std::vector<std::array<Eigen::Vector3f, 3>> triangles;
    std::vector<std::array<Eigen::Vector3f, 2>> border;  ///< the triangles lie on one side of it
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();    ///< unit, world
    std::uint32_t material = 0;                          ///< index into Scene::materials
    std::uint32_t instance = 0;                          ///< index into Scene::instances
    bool mapped = false;  ///< maps lie on it: its material is that of a texel
};

/// The faces of the scene at rest and of copies. Moving bodies have none.
struct CoherentFaces {
    std::vector<ScenePlate> plates;
};

}  // namespace sonarsim
