#include "simulate/visibility/triangle_runs.h"

#include <algorithm>

namespace sonarsim {

TriangleRuns::TriangleRuns(const Scene& scene) : origin_(scene.origin) {
    add_mesh(scene.vertices, scene.triangles);
    for (const Body& body : scene.bodies)
        add_mesh(body.vertices, body.triangles);
    for (const SharedMesh& mesh : scene.shared_meshes)
        add_mesh(mesh.vertices, mesh.triangles);
    for (const MeshCopy& copy : scene.copies)
        copies_.push_back({1 + scene.bodies.size() + copy.mesh, copy.T_world_mesh});
}

void TriangleRuns::add_mesh(std::span<const Eigen::Vector3f> vertices,
                            std::span<const std::array<std::uint32_t, 3>> triangles) {
    Mesh mesh{vertices, triangles, {}, {}};
    for (std::size_t first = 0; first < triangles.size(); first += run_triangles)
        mesh.runs.push_back(ball_around(
            vertices, triangles.subspan(first, std::min(run_triangles, triangles.size() - first))));
    mesh.whole = ball_around(vertices, triangles);
    meshes_.push_back(std::move(mesh));
}

}  // namespace sonarsim
