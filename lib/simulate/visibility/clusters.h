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

}  // namespace sonarsim
