#include "simulate/visibility/clusters_in_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace sonarsim {

namespace {

/// The triangles of a mesh. One instance is that of all of them.
struct MeshView {
    std::span<const Eigen::Vector3f> vertices;
    std::span<const TriangleCorners> triangles;
    std::span<const std::uint32_t> materials, instances;
};

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

/// Indices of the triangles along the Morton curve; equal codes keep the mesh's order.
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

ClusterMesh make_clusters(const MeshView& from) {
    /// A vertex in the last cluster that has it. Clusters count from 1.
    struct Place {
        std::size_t cluster = 0;
        std::uint8_t index = 0;
    };
    std::vector<Place> places(from.vertices.size());
    std::vector<TriangleCorners> all;
    ClusterMesh mesh;
    Solids solids = find_solids(from.vertices, from.triangles);
    const std::vector<std::uint32_t> order = along_morton_curve(from);
    mesh.corners.reserve(order.size());
    mesh.facets.reserve(order.size());
    for (std::size_t first = 0; first < order.size(); first += ClusterMesh::max_triangles) {
        TriangleCluster cluster;
        cluster.first_vertex = static_cast<std::uint32_t>(mesh.vertices.size());
        cluster.first_triangle = static_cast<std::uint32_t>(first);
        cluster.triangles =
            std::min(ClusterMesh::max_triangles, static_cast<std::uint32_t>(order.size() - first));
        all.clear();
        for (const std::uint32_t triangle : std::span(order).subspan(first, cluster.triangles)) {
            const TriangleCorners& corners = all.emplace_back(from.triangles[triangle]);
            std::array<std::uint8_t, 3> local{};
            for (int k = 0; k < 3; ++k) {
                Place& place = places[corners[k]];
                if (place.cluster != mesh.clusters.size() + 1) {
                    place = {mesh.clusters.size() + 1,
                             static_cast<std::uint8_t>(cluster.vertices++)};
                    mesh.vertices.push_back(from.vertices[corners[k]]);
                }
                local[k] = place.index;
            }
            mesh.corners.push_back(local);
            const Eigen::Vector3d normal = cross_of(from.vertices, corners).normalized();
            const std::size_t owner = from.instances.size() == 1 ? 0 : triangle;
            mesh.facets.push_back({normal.cast<float>(), from.materials[triangle],
                                   from.instances[owner], triangle, solids.of_triangles[triangle]});
        }
        static_cast<Ball&>(cluster) = ball_around(from.vertices, all);
        mesh.clusters.push_back(cluster);
    }
    mesh.solids = std::move(solids.items);
    return mesh;
}

/// Appends ClustersInView::own_outward of a mesh. A sensor within the margin counts as inside.
void add_outward(const ClusterMesh& mesh, const Eigen::Vector3f& sensor, float margin_m,
                 std::vector<float>& out) {
    out.reserve(out.size() + mesh.solids.size());
    for (const Solid& solid : mesh.solids)
        out.push_back(solid.box.exteriorDistance(sensor) > margin_m ? solid.outward : 0.0F);
}

/// Places the clusters of a mesh that may lie in a view. Scene-local.
class ClusterPlacer {
  public:
    ClusterPlacer(const ViewVolume& volume, std::size_t first_number, float margin_m,
                  ClustersInView& out)
        : volume_(volume),
          position_(volume.position().cast<float>()),
          margin_m_(margin_m),
          out_(out.placed),
          outward_(out.placed_outward),
          next_number_(static_cast<std::uint32_t>(first_number)) {}

    /// `T_local_mesh` has a uniform scale. Triangles are numbered on by calls, as a Caster does.
    void place(const ClusterMesh& mesh, const Ball& whole, const Eigen::Affine3d& T_local_mesh,
               std::uint32_t instance) {
        first_number_ = next_number_;
        next_number_ += static_cast<std::uint32_t>(mesh.facets.size());
        R_ = T_local_mesh.linear().cast<float>();
        t_ = T_local_mesh.translation().cast<float>();
        scale_ = static_cast<float>(T_local_mesh.linear().col(0).norm());
        instance_ = instance;
        if (!may_be_visible(placed(whole))) return;
        first_solid_ = static_cast<std::uint32_t>(outward_.size());
        const Eigen::Vector3f sensor = R_.transpose() * (position_ - t_) / (scale_ * scale_);
        add_outward(mesh, sensor, margin_m_ / scale_, outward_);
        for (const TriangleCluster& cluster : mesh.clusters) {
            if (const Ball ball = placed(cluster); may_be_visible(ball)) add(mesh, cluster, ball);
        }
    }

    bool may_be_visible(const Ball& ball) const {
        return volume_.containment(ball.centre - position_, ball.radius_m + volume_.rounding_m()) !=
               Containment::outside;
    }

  private:
    Ball placed(const Ball& ball) const { return {R_ * ball.centre + t_, scale_ * ball.radius_m}; }

    void add(const ClusterMesh& mesh, const TriangleCluster& cluster, const Ball& ball) {
        TriangleCluster& copy = out_.clusters.emplace_back(cluster);
        static_cast<Ball&>(copy) = ball;
        copy.first_vertex = static_cast<std::uint32_t>(out_.vertices.size());
        copy.first_triangle = static_cast<std::uint32_t>(out_.corners.size());
        for (std::uint32_t k = 0; k < cluster.vertices; ++k)
            out_.vertices.push_back(R_ * mesh.vertices[cluster.first_vertex + k] + t_);
        for (std::uint32_t k = 0; k < cluster.triangles; ++k) {
            const std::uint32_t triangle = cluster.first_triangle + k;
            out_.corners.push_back(mesh.corners[triangle]);
            const ClusterFacet& facet = mesh.facets[triangle];
            out_.facets.push_back({R_ * facet.normal / scale_, facet.material, instance_,
                                   first_number_ + facet.number, first_solid_ + facet.solid});
        }
    }

    const ViewVolume& volume_;
    const Eigen::Vector3f position_;
    const float margin_m_;
    ClusterMesh& out_;
    std::vector<float>& outward_;
    std::uint32_t next_number_, first_number_ = 0;
    // The mesh:
    Eigen::Matrix3f R_;
    Eigen::Vector3f t_;
    float scale_ = 1.0F;
    std::uint32_t instance_ = 0, first_solid_ = 0;
};

}  // namespace

SceneClusters::SceneClusters(const Scene& scene)
    : scene_(scene),
      own_(make_clusters(
          {scene.vertices, scene.triangles, scene.triangle_material, scene.triangle_instance})) {
    const auto placed = [](const auto& mesh, std::uint32_t instance) -> PlacedMesh {
        return {
            make_clusters({mesh.vertices, mesh.triangles, mesh.triangle_material, {&instance, 1}}),
            ball_around(mesh.vertices, mesh.triangles)};
    };
    for (const Body& body : scene.bodies)
        bodies_.push_back(placed(body, body.instance));
    for (const SharedMesh& mesh : scene.shared_meshes)
        shared_.push_back(placed(mesh, 0));
}

ClustersInView SceneClusters::in_view(const View& view, Pose T_world_sensor,
                                      std::span<const Pose> T_world_body) const {
    ClustersInView out{local_pose(T_world_sensor, scene_.origin), own_, {}, {}, {}, {}};
    T_world_sensor.translation -= scene_.origin;
    const ViewVolume volume(view, T_world_sensor);
    constexpr float margin = 1e-4F;  // ten times what strips leave out before the sonar
    const float margin_m = margin * static_cast<float>(view.range_max_m);
    add_outward(own_, out.pose.position, margin_m, out.own_outward);
    ClusterPlacer placer(volume, own_.facets.size(), margin_m, out);
    for (std::uint32_t k = 0; k < own_.clusters.size(); ++k) {
        if (placer.may_be_visible(own_.clusters[k])) out.own_clusters.push_back(k);
    }
    const Eigen::Translation3d to_local(-scene_.origin);
    for (const MeshCopy& copy : scene_.copies) {
        placer.place(shared_[copy.mesh].clusters, shared_[copy.mesh].whole,
                     to_local * copy.T_world_mesh, copy.instance);
    }
    for (std::size_t k = 0; k < T_world_body.size(); ++k) {
        placer.place(bodies_[k].clusters, bodies_[k].whole, to_local * affine(T_world_body[k]),
                     scene_.bodies[k].instance);
    }
    return out;
}

}  // namespace sonarsim
