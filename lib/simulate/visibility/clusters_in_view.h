#pragma once

#include <Eigen/Core>
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
    std::uint32_t number;  ///< the triangle in its mesh; a placed one in the whole scene
    std::uint32_t solid;   ///< index into ClusterMesh::solids
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
    std::vector<Solid> solids;
};

/// The clusters that may lie in a view, scene-local.
struct ClustersInView {
    LocalPose pose;                           ///< the sensor
    const ClusterMesh& own;                   ///< the scene's own surface,
    std::vector<std::uint32_t> own_clusters;  ///< and which of its clusters
    ClusterMesh placed;                       ///< bodies and copies
    /// Solid::outward of the solids of `own` and `placed`; 0 where the sensor is in the box.
    std::vector<float> own_outward, placed_outward;

    /// Facets of `placed` follow the own ones.
    const ClusterFacet& facet(std::uint32_t index) const {
        return index < own.facets.size() ? own.facets[index]
                                         : placed.facets[index - own.facets.size()];
    }

    /// 1 or -1: visible only if the facet's normal, or its opposite, faces the sensor; 0: always.
    float outward(std::uint32_t index) const {
        return index < own.facets.size() ? own_outward[own.facets[index].solid]
                                         : placed_outward[facet(index).solid];
    }

    /// Calls visit(corners), in the frame of the sensor, for every triangle.
    template <class Visit>
    void visit_triangles(Visit visit) const {
        const Eigen::Matrix3f R = pose.rotation.transpose();
        const auto visit_cluster = [&](const ClusterMesh& mesh, const TriangleCluster& cluster) {
            for (std::uint32_t k = 0; k < cluster.triangles; ++k) {
                const auto& local = mesh.corners[cluster.first_triangle + k];
                std::array<Eigen::Vector3f, 3> corners;
                for (std::size_t i = 0; i < 3; ++i)
                    corners[i] =
                        R * (mesh.vertices[cluster.first_vertex + local[i]] - pose.position);
                visit(corners);
            }
        };
        for (const std::uint32_t k : own_clusters)
            visit_cluster(own, own.clusters[k]);
        for (const TriangleCluster& cluster : placed.clusters)
            visit_cluster(placed, cluster);
    }
};

/// The triangles of a scene in clusters: its own, and those of bodies and shared meshes.
class SceneClusters {
  public:
    /// `scene` must outlive it.
    explicit SceneClusters(const Scene& scene);

    /// Without their poses bodies are left out. The clusters must outlive the result.
    ClustersInView in_view(const View& view, Pose T_world_sensor,
                           std::span<const Pose> T_world_body) const;

  private:
    struct PlacedMesh {
        ClusterMesh clusters;
        Ball whole;
    };

    const Scene& scene_;
    ClusterMesh own_;
    std::vector<PlacedMesh> bodies_, shared_;
};

}  // namespace sonarsim
