#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "scene/scene.h"

namespace sonarsim {

/// A flat face of the scene whose material reflects coherently: triangles of one instance and one
/// material that join in one plane. Beyond its border the surface ends or turns by 30 degrees or
/// more, so the facets of a curved surface are no plates.
struct ScenePlate {
    /// The border, m relative to Scene::origin; the triangles lie on one side of it.
    std::vector<std::array<Eigen::Vector3f, 2>> border;
    Eigen::Vector3f normal = Eigen::Vector3f::Zero();  ///< unit, world
    std::uint32_t material = 0;                        ///< index into Scene::materials
    std::uint32_t instance = 0;                        ///< index into Scene::instances
};

/// The surface of a scene that reflects coherently, at rest and of copies. Bodies that move have
/// none.
struct CoherentFaces {
    std::vector<ScenePlate> plates;  ///< instances ascend
};

/// Null if no material reflects coherently.
std::shared_ptr<const CoherentFaces> find_coherent_faces(const Scene& scene);

}  // namespace sonarsim
