#include "simulate/visibility/clusters.h"

#include <utility>

namespace sonarsim {

namespace {

/// The 21 low bits of x with two zeros after each bit.
std::uint64_t spread_bits(std::uint64_t x) {
    x &= 0x1fffff;
    x = (x | x << 32U) & 0x1f00000000ffff;
    x = (x | x << 16U) & 0x1f0000ff0000ff;
    x = (x | x << 8U) & 0x100f00f00f00f00f;
    x = (x | x << 4U) & 0x10c30c30c30c30c3;
    x = (x | x << 2U) & 0x1249249249249249;
    return x;
}

Eigen::Vector3f centre_of(const MeshView& mesh, const TriangleCorners& triangle) {
    return (mesh.vertices[triangle[0]] + mesh.vertices[triangle[1]] + mesh.vertices[triangle[2]]) /
           3.0F;
}

/// Indices of the triangles along the Morton curve; triangles with equal codes keep the mesh's
/// order.
std::vector<std::uint32_t> along_morton_curve(const MeshView& mesh) {
    Eigen::AlignedBox3f box;
    for (const auto& triangle : mesh.triangles)
        box.extend(centre_of(mesh, triangle));
    const float length = mesh.triangles.empty() ? 0.0F : box.sizes().maxCoeff();
    const float cells = length > 0.0F ? static_cast<float>(0x1fffff) / length : 0.0F;
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(mesh.triangles.size());
    for (std::uint32_t i = 0; i < keys.size(); ++i) {
        const Eigen::Vector3f at = (centre_of(mesh, mesh.triangles[i]) - box.min()) * cells;
        keys[i] = {spread_bits(static_cast<std::uint64_t>(at.x())) |
                       spread_bits(static_cast<std::uint64_t>(at.y())) << 1U |
                       spread_bits(static_cast<std::uint64_t>(at.z())) << 2U,
                   i};
    }
    std::ranges::sort(keys);
    std::vector<std::uint32_t> order(keys.size());
    std::ranges::transform(keys, order.begin(), [](const auto& key) { return key.second; });
    return order;
}

/// Appends a cluster of the given triangles.
void add_cluster(const MeshView& from, std::span<const std::uint32_t> triangles,
                 ClusterMesh& mesh) {
    std::vector<TriangleCorners> all;
    std::vector<std::uint32_t> used;
    for (const std::uint32_t triangle : triangles) {
        const TriangleCorners& corners = all.emplace_back(from.triangles[triangle]);
        used.insert(used.end(), corners.begin(), corners.end());
    }
    std::ranges::sort(used);
    used.erase(std::unique(used.begin(), used.end()), used.end());

    TriangleCluster cluster{ball_around(from.vertices, all)};
    cluster.first_vertex = static_cast<std::uint32_t>(mesh.vertices.size());
    cluster.vertices = static_cast<std::uint32_t>(used.size());
    cluster.first_triangle = static_cast<std::uint32_t>(mesh.corners.size());
    cluster.triangles = static_cast<std::uint32_t>(triangles.size());
    for (const std::uint32_t vertex : used)
        mesh.vertices.push_back(from.vertices[vertex]);
    for (const std::uint32_t triangle : triangles) {
        const TriangleCorners& corners = from.triangles[triangle];
        std::array<std::uint8_t, 3> local{};
        for (int k = 0; k < 3; ++k) {
            const auto at = std::ranges::lower_bound(used, corners[k]);
            local[k] = static_cast<std::uint8_t>(at - used.begin());
        }
        mesh.corners.push_back(local);
        const Eigen::Vector3d twice = cross_of(from.vertices, corners);
        const std::size_t owner = from.instances.size() == 1 ? 0 : triangle;
        mesh.facets.push_back({twice.normalized().cast<float>(), from.materials[triangle],
                               from.instances[owner], static_cast<float>(0.5 * twice.norm()),
                               triangle});
    }
    mesh.clusters.push_back(cluster);
}

}  // namespace

ClusterMesh make_clusters(const MeshView& from) {
    ClusterMesh mesh;
    const std::vector<std::uint32_t> order = along_morton_curve(from);
    mesh.corners.reserve(order.size());
    mesh.facets.reserve(order.size());
    for (std::size_t first = 0; first < order.size(); first += ClusterMesh::max_triangles) {
        const std::size_t count =
            std::min<std::size_t>(ClusterMesh::max_triangles, order.size() - first);
        add_cluster(from, std::span(order).subspan(first, count), mesh);
    }
    return mesh;
}

}  // namespace sonarsim
