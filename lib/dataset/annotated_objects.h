#pragma once

#include <cstddef>
#include <vector>

#include "assembly/assemble.h"
#include "labels/object_directions.h"

namespace sonarsim {

/// The box around the surface at rest of each object, world; empty for one that moves.
std::vector<Eigen::AlignedBox3d> still_boxes(const Assembly& assembly);

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
