#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "input/scene/scene.h"

namespace sonarsim {

/// The data of a visible triangle.
struct SliceFacet {
    Eigen::Vector3f normal;  ///< unit; zero for a triangle without area
    std::uint32_t material;
    std::uint32_t instance;
    std::uint32_t component;  ///< connected component of the mesh, by shared corners
    float area_m2;
};

/// Up to 64 neighbouring triangles.
struct TriangleCluster {
    Eigen::Vector3f centre;  ///< centre of a bounding sphere, scene-local, m
    float radius_m;
    std::uint32_t first_vertex;
    std::uint32_t vertices;
    std::uint32_t first_triangle;
    std::uint32_t triangles;
};

/// A scene's triangles, sorted along a Morton curve through their centres
/// and divided into clusters. Corner indices count from the cluster's first vertex.
struct ClusterMesh {
    static constexpr std::uint32_t max_triangles = 64;
    static constexpr std::uint32_t nothing = 0xFFFFFFFFU;

    std::vector<TriangleCluster> clusters;
    std::vector<Eigen::Vector3f> vertices;  ///< scene-local, m
    std::vector<std::array<std::uint8_t, 3>> corners;
    std::vector<SliceFacet> facets;
    /// The neighbour over each edge, from corner k to the next: its vertex that is not on the edge,
    /// as an index into Scene::vertices, or `nothing`. A neighbour of another material or instance
    /// does not count.
    std::vector<std::array<std::uint32_t, 3>> beyond;
    std::uint32_t components = 0;
};

ClusterMesh make_clusters(const Scene& scene);

}  // namespace sonarsim
