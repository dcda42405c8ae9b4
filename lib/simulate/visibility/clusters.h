#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "input/scene/scene.h"

namespace sonarsim {

/// The data of a triangle.
struct ClusterFacet {
    Eigen::Vector3f normal;  ///< unit; zero for a triangle without area
    std::uint32_t material;
    std::uint32_t instance;
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

    std::vector<TriangleCluster> clusters;
    std::vector<Eigen::Vector3f> vertices;  ///< scene-local, m
    std::vector<std::array<std::uint8_t, 3>> corners;
    std::vector<ClusterFacet> facets;
};

ClusterMesh make_clusters(const Scene& scene);

}  // namespace sonarsim
