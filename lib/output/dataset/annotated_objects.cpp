#include "output/dataset/annotated_objects.h"

#include "input/scene/copies.h"

namespace sonarsim {

namespace {

ObjectSphere sphere_around(const Eigen::AlignedBox3d& box) {
    return {box.center(), 0.5 * box.diagonal().norm()};
}

/// The box around the surface at rest of each object, world.
std::vector<Eigen::AlignedBox3d> still_boxes(const Assembly& assembly) {
    const Scene& scene = assembly.scene;
    const SceneObjects& objects = assembly.objects;
    std::vector<Eigen::AlignedBox3d> boxes(objects.objects.size());
    for (std::size_t k = 0; k < scene.triangles.size(); ++k) {
        Eigen::AlignedBox3d& box = boxes[objects.object_of(scene.triangle_instance[k])];
        for (const std::uint32_t vertex : scene.triangles[k])
            box.extend(scene.origin + scene.vertices[vertex].cast<double>());
    }
    for (const MeshCopy& copy : scene.copies) {
        Eigen::AlignedBox3d& box = boxes[objects.object_of(copy.instance)];
        for (const Eigen::Vector3f& vertex : scene.shared_meshes[copy.mesh].vertices)
            box.extend(copy.T_world_mesh * vertex.cast<double>());
    }
    return boxes;
}

}  // namespace

std::vector<Eigen::AlignedBox3d> object_boxes(const Assembly& assembly) {
    std::vector<Eigen::AlignedBox3d> boxes = still_boxes(assembly);
    for (const Body& body : assembly.scene.bodies)
        boxes[assembly.objects.object_of(body.instance)].setEmpty();
    return boxes;
}

std::vector<std::optional<MovingObject>> moving_objects(const Assembly& assembly) {
    const Scene& scene = assembly.scene;
    const SceneObjects& objects = assembly.objects;
    std::vector<int> parts(objects.objects.size(), 0);
    for (const std::uint32_t object : objects.object_of_instance)
        ++parts[object];
    std::vector<std::optional<MovingObject>> moving(parts.size());
    for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
        const std::uint32_t object = objects.object_of(scene.bodies[k].instance);
        if (parts[object] > 1) continue;
        moving[object] = {k, box_of(scene.bodies[k].vertices)};
    }
    return moving;
}

AnnotatedObjects annotated_objects(const Assembly& assembly) {
    const Scene& scene = assembly.scene;
    const SceneObjects& objects = assembly.objects;
    const std::vector<Eigen::AlignedBox3d> boxes = still_boxes(assembly);
    AnnotatedObjects annotated;
    for (const Eigen::AlignedBox3d& box : boxes)
        annotated.surface.extend(box);
    if (!scene.bodies.empty()) annotated.surface.setEmpty();
    for (std::uint32_t k = 0; k < boxes.size(); ++k) {
        if (!objects.is_background(k) && !boxes[k].isEmpty())
            annotated.still.push_back(sphere_around(boxes[k]));
    }
    for (std::size_t k = 0; k < scene.bodies.size(); ++k) {
        if (objects.is_background(objects.object_of(scene.bodies[k].instance))) continue;
        annotated.moving.push_back({k, sphere_around(box_of(scene.bodies[k].vertices))});
    }
    return annotated;
}

std::vector<ObjectSphere> spheres_at(const AnnotatedObjects& objects, const Assembly& assembly,
                                     double t_s) {
    std::vector<ObjectSphere> spheres = objects.still;
    if (objects.moving.empty()) return spheres;
    const std::vector<Pose> T_world_body = body_poses(assembly, t_s);
    for (const AnnotatedObjects::Moving& one : objects.moving) {
        const Pose& T = T_world_body[one.body];
        spheres.push_back({T.rotation * one.sphere.centre + T.translation, one.sphere.radius_m});
    }
    return spheres;
}

}  // namespace sonarsim
