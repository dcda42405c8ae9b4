#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "scene/scene.h"
#include "trace/target_mesh.h"

namespace sonarsim {

/// An object of the scene that pings may sample triangle by triangle: an instance.
struct PlacedTarget {
    std::uint32_t shape;     ///< index into TargetShapes::shapes
    std::uint32_t instance;  ///< index into Scene::instances
    /// Index into Scene::bodies, if it moves: its shape is in the body's frame.
    std::optional<std::uint32_t> body;
    /// Rotation, uniform scale and translation, scene-local, if it is at rest.
    Eigen::Affine3f T_local_shape;
    /// The least RMS slope of its materials, and of the texels on it, that have facets.
    float min_slope = 1.0F;
};

struct TargetShapes {
    std::vector<TargetShape> shapes;
    std::vector<PlacedTarget> placed;
};

/// Finds the instances of at most 20,000 triangles within a ball of at most 5 m radius. Null if
/// there are none.
std::shared_ptr<const TargetShapes> find_target_shapes(const Scene& scene);

}  // namespace sonarsim
