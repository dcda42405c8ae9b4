#include "input/scene/copies.h"

namespace sonarsim {

std::vector<Eigen::AlignedBox3d> boxes_of_copies(const Scene& scene) {
    std::vector<Eigen::AlignedBox3d> mesh_boxes;
    for (const SharedMesh& mesh : scene.shared_meshes)
        mesh_boxes.push_back(box_of(mesh.vertices));
    std::vector<Eigen::AlignedBox3d> boxes;
    boxes.reserve(scene.copies.size());
    for (const MeshCopy& copy : scene.copies) {
        const Eigen::AlignedBox3d& box = mesh_boxes[copy.mesh];
        boxes.push_back(box.isEmpty() ? box : box.transformed(copy.T_world_mesh));
    }
    return boxes;
}

std::vector<Eigen::AlignedBox3d> boxes_of_instances(const Scene& scene) {
    std::vector<Eigen::AlignedBox3d> boxes(scene.instances.size());
    for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
        for (const std::uint32_t corner : scene.triangles[t])
            boxes[scene.triangle_instance[t]].extend(scene.origin +
                                                     scene.vertices[corner].cast<double>());
    }
    const std::vector<Eigen::AlignedBox3d> copies = boxes_of_copies(scene);
    for (std::size_t k = 0; k < copies.size(); ++k)
        boxes[scene.copies[k].instance].extend(copies[k]);
    return boxes;
}

std::size_t all_triangles(const Scene& scene) {
    std::size_t count = scene.triangles.size();
    for (const MeshCopy& copy : scene.copies)
        count += scene.shared_meshes[copy.mesh].triangles.size();
    return count;
}

std::array<Eigen::Vector3f, 3> placed_corners(const Scene& scene, const MeshCopy& copy,
                                              std::size_t triangle) {
    const SharedMesh& mesh = scene.shared_meshes[copy.mesh];
    std::array<Eigen::Vector3f, 3> corners;
    for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d vertex = mesh.vertices[mesh.triangles[triangle][k]].cast<double>();
        corners[k] = (copy.T_world_mesh * vertex - scene.origin).cast<float>();
    }
    return corners;
}

}  // namespace sonarsim
