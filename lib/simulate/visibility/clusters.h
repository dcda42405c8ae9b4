#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/pose.h"
#include "input/scene/mesh_topology.h"
#include "input/scene/scene.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// The data of a triangle.
struct ClusterFacet {
    Eigen::Vector3f normal;  ///< unit; zero for a triangle without area
    std::uint32_t material;
    std::uint32_t instance;
    float area_m2;
    std::uint32_t number;  ///< the triangle in its mesh; a placed one in the whole scene
};

/// Up to 64 neighbouring triangles, with a ball around them.
struct TriangleCluster : Ball {
    std::uint32_t first_vertex = 0;
    std::uint32_t vertices = 0;
    std::uint32_t first_triangle = 0;
    std::uint32_t triangles = 0;
};

/// A mesh's triangles, sorted along a Morton curve through their centres
/// and divided into clusters. Corner indices count from the cluster's first vertex.
struct ClusterMesh {
    static constexpr std::uint32_t max_triangles = 64;

    std::vector<TriangleCluster> clusters;
    std::vector<Eigen::Vector3f> vertices;  ///< m
    std::vector<std::array<std::uint8_t, 3>> corners;
    std::vector<ClusterFacet> facets;
};

/// The triangles of a mesh. One instance is that of all of them.
struct MeshView {
    std::span<const Eigen::Vector3f> vertices;
    std::span<const TriangleCorners> triangles;
    std::span<const std::uint32_t> materials, instances;
};

ClusterMesh make_clusters(const MeshView& mesh);

/// Finds the triangles of a scene that may lie in a view. Neighbours in a mesh are mostly
/// neighbours in space, so each run of 32 triangles has a bounding ball.
class TriangleRuns {
  public:
    using Corners = std::array<Eigen::Vector3f, 3>;

    /// `scene` must outlive this object.
    explicit TriangleRuns(const Scene& scene);

    /// Calls visit(corners), in the frame of the sensor, for every triangle in a run that may reach
    /// into the view. `T_world_body` [bodies] are the poses of Scene::bodies; empty: bodies are
    /// left out.
    template <class Visit>
    void visit(const View& view, const Pose& T_world_sensor, std::span<const Pose> T_world_body,
               Visit visit) const {
        const ViewVolume volume(view, T_world_sensor);
        const Eigen::Affine3d T_sensor_world = affine(T_world_sensor).inverse(Eigen::Isometry);
        visit_mesh(meshes_[0], T_sensor_world * Eigen::Translation3d(origin_), volume, visit);
        for (std::size_t k = 0; k < T_world_body.size(); ++k)
            visit_mesh(meshes_[1 + k], T_sensor_world * affine(T_world_body[k]), volume, visit);
        for (const Copy& copy : copies_)
            visit_mesh(meshes_[copy.mesh], T_sensor_world * copy.T_world_mesh, volume, visit);
    }

  private:
    struct Mesh {
        std::span<const Eigen::Vector3f> vertices;
        std::span<const std::array<std::uint32_t, 3>> triangles;
        std::vector<Ball> runs;
        Ball whole;
    };

    struct Copy {
        std::size_t mesh;
        Eigen::Affine3d T_world_mesh;
    };

    static constexpr std::size_t run_triangles = 32;

    static Eigen::Affine3d affine(const Pose& pose) {
        return Eigen::Translation3d(pose.translation) * pose.rotation;
    }

    void add_mesh(std::span<const Eigen::Vector3f> vertices,
                  std::span<const std::array<std::uint32_t, 3>> triangles);

    template <class Visit>
    static void visit_mesh(const Mesh& mesh, const Eigen::Affine3d& T_sensor_mesh,
                           const ViewVolume& volume, Visit& visit) {
        const Eigen::Matrix3f R = T_sensor_mesh.linear().cast<float>();
        const Eigen::Vector3f t = T_sensor_mesh.translation().cast<float>();
        const float scale = R.col(0).norm();
        const auto outside = [&](const Ball& ball) {
            return volume.contains_in_sensor_frame(R * ball.centre + t,
                                                   scale * ball.radius_m + volume.rounding_m()) ==
                   Containment::outside;
        };
        if (mesh.triangles.empty() || outside(mesh.whole)) return;
        for (std::size_t run = 0; run < mesh.runs.size(); ++run) {
            if (outside(mesh.runs[run])) continue;
            const std::size_t first = run * run_triangles;
            const std::size_t count = std::min(run_triangles, mesh.triangles.size() - first);
            for (const auto& [a, b, c] : mesh.triangles.subspan(first, count)) {
                visit(Corners{R * mesh.vertices[a] + t, R * mesh.vertices[b] + t,
                              R * mesh.vertices[c] + t});
            }
        }
    }

    Eigen::Vector3d origin_;
    std::vector<Mesh> meshes_;  ///< the scene's own, its bodies, its shared meshes
    std::vector<Copy> copies_;
};

}  // namespace sonarsim
