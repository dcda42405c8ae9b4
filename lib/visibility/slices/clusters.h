#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "scene/scene.h"

namespace sonarsim {

/// What is needed of a triangle once it is seen.
struct SliceFacet {
    Eigen::Vector3f normal;  ///< unit; zero for a triangle without area
    std::uint32_t material;
    std::uint32_t instance;
    std::uint32_t piece;  ///< triangles that hang together by their corners have the same
};

/// Up to 64 triangles that lie close together.
struct Cluster {
    Eigen::Vector3f centre;  ///< of a sphere around it, scene-local, m
    float radius_m;
    std::uint32_t first_vertex;
    std::uint32_t vertices;
    std::uint32_t first_triangle;
    std::uint32_t triangles;
};

/// A scene's triangles, flat faces in as few as they need, sorted along a Morton curve through
/// their centres and cut into clusters. Corners count from the cluster's first vertex.
struct ClusterMesh {
    static constexpr std::uint32_t most_triangles = 64;
    static constexpr std::uint32_t nothing = 0xFFFFFFFFU;

    std::vector<Cluster> clusters;
    std::vector<Eigen::Vector3f> vertices;  ///< scene-local, m
    std::vector<std::array<std::uint8_t, 3>> corners;
    std::vector<SliceFacet> facets;
    /// Of the triangle on the other side of each edge, from corner k to the next, the vertex that
    /// is not on it: an index into Scene::vertices, or `nothing`.
    std::vector<std::array<std::uint32_t, 3>> beyond;
    std::uint32_t pieces = 0;
};

ClusterMesh make_clusters(const Scene& scene);

}  // namespace sonarsim
