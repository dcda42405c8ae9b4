#include "simulate/visibility/clusters_in_view.h"

#include <Eigen/Geometry>

namespace sonarsim {

namespace {

/// Places the clusters of a mesh that may lie in a view. Scene-local.
class ClusterPlacer {
  public:
    ClusterPlacer(const ViewVolume& volume, std::size_t first_number, ClusterMesh& out)
        : volume_(volume),
          position_(volume.position().cast<float>()),
          out_(out),
          next_number_(static_cast<std::uint32_t>(first_number)) {}

    /// `T_local_mesh`: a rotation, a translation and a uniform scale. Triangles are numbered on in
    /// the order of the calls, as a Caster does.
    void place(const ClusterMesh& mesh, const Ball& whole, const Eigen::Affine3d& T_local_mesh,
               std::uint32_t instance) {
        first_number_ = next_number_;
        next_number_ += static_cast<std::uint32_t>(mesh.facets.size());
        R_ = T_local_mesh.linear().cast<float>();
        t_ = T_local_mesh.translation().cast<float>();
        scale_ = static_cast<float>(T_local_mesh.linear().col(0).norm());
        instance_ = instance;
        if (!may_be_visible(placed(whole))) return;
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
                                   scale_ * scale_ * facet.area_m2, first_number_ + facet.number});
        }
    }

    const ViewVolume& volume_;
    const Eigen::Vector3f position_;
    ClusterMesh& out_;
    std::uint32_t next_number_, first_number_ = 0;
    // The mesh:
    Eigen::Matrix3f R_;
    Eigen::Vector3f t_;
    float scale_ = 1.0F;
    std::uint32_t instance_ = 0;
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
    ClustersInView out{local_pose(T_world_sensor, scene_.origin), own_, {}, {}};
    T_world_sensor.translation -= scene_.origin;
    const ViewVolume volume(view, T_world_sensor);
    ClusterPlacer placer(volume, own_.facets.size(), out.placed);
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
