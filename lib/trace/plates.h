#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "core/pose.h"
#include "scene/scene.h"
#include "visibility/engine.h"
#include "visibility/view.h"

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

/// The plates of the scene's surface at rest and of its copies. Bodies that move have none.
std::vector<ScenePlate> find_plates(const Scene& scene);

/// A part of a plate's border in the sensor frame, m.
struct PlateEdge {
    Eigen::Vector3d from, to;
    bool seen = true;  ///< it is in view, and the plate beside its middle is not hidden
};

/// A plate in the sensor frame.
struct PlateOfPing {
    std::vector<PlateEdge> edges;
    Eigen::Vector3d normal;  ///< unit, away from the sonar
    double height_m = 0.0;   ///< the sonar's height above its plane
    bool foot_seen = true;   ///< so is the foot of the perpendicular, if it is on the plate
    std::uint32_t material = 0;
    std::uint32_t instance = 0;
};

/// The plates whose planes are within the range of a view, in the order of `plates`. Rays decide
/// what of them is hidden: one to the foot of the perpendicular, and eight to every edge.
std::vector<PlateOfPing> plates_of_ping(const std::vector<ScenePlate>& plates, const Scene& scene,
                                        const VisibilityEngine& engine, const Pose& T_world_sensor,
                                        const View& view);

}  // namespace sonarsim
