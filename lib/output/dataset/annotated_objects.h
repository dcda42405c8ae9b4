#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "simulate/assembly/assemble.h"
#include "simulate/labels/object_directions.h"

namespace sonarsim {

/// World boxes around the objects; empty for an object without triangles, and if a part of it
/// moves.
std::vector<Eigen::AlignedBox3d> object_boxes(const Assembly& assembly);

/// An object that moves as a whole.
struct MovingObject {
    std::size_t body = 0;     ///< index into Scene::bodies
    Eigen::AlignedBox3d box;  ///< box around it in its own frame
};
/// One for each object; nothing for an object that stands still or consists of several parts.
std::vector<std::optional<MovingObject>> moving_objects(const Assembly& assembly);

/// Spheres around the objects of a scene whose class is not background.
struct AnnotatedObjects {
    struct Moving {
        std::size_t body;     ///< index into Scene::bodies
        ObjectSphere sphere;  ///< in the frame of the body
    };
    std::vector<ObjectSphere> still;  ///< world
    std::vector<Moving> moving;
    Eigen::AlignedBox3d surface;  ///< around all surface, world; empty if some of it moves
};
AnnotatedObjects annotated_objects(const Assembly& assembly);

/// The spheres of all annotated objects in the world at the time `t_s` of the trajectory.
std::vector<ObjectSphere> spheres_at(const AnnotatedObjects& objects, const Assembly& assembly,
                                     double t_s);

}  // namespace sonarsim
