#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "simulate/visibility/embree.h"
#include "simulate/visibility/facet.h"

namespace sonarsim {

/// Throws std::bad_alloc, or std::runtime_error with the text `doing`, if Embree has failed since.
void check_embree(RTCDevice device, const char* doing);

/// The tree of a mesh, for trace_packets().
EmbreeTree make_tree(RTCDevice device, std::span<const Eigen::Vector3f> vertices,
                     std::span<const std::array<std::uint32_t, 3>> triangles);

/// Adds a mesh to a tree as its `index`-th. Not finished before commit().
void put_mesh(RTCDevice device, const EmbreeTree& into, unsigned int index,
              std::span<const Eigen::Vector3f> vertices,
              std::span<const std::array<std::uint32_t, 3>> triangles);

/// True if the first mesh of the tree, with as many triangles, has these. All vertices are used.
bool has_first_mesh(const EmbreeTree& tree, std::span<const Eigen::Vector3f> vertices,
                    std::span<const std::array<std::uint32_t, 3>> triangles);

/// Builds what has changed.
void commit(RTCDevice device, const EmbreeTree& tree);

/// Puts a tree into another, as its `index`-th instance.
void add_instance(RTCDevice device, const EmbreeTree& into, unsigned int index,
                  const EmbreeTree& tree, Eigen::Matrix<float, 3, 4> transform);

/// The triangles of an instance of a tree, or of one of a tree's own meshes.
struct TracedMesh {
    std::uint32_t first_facet = 0;  ///< the number of its first facet
    const Facet* facets = nullptr;  ///< in the mesh's frame
    bool placed = false;            ///< false: the mesh's frame is the scene-local one
    bool scaled = false;
    Eigen::Matrix<float, 3, 4> T_local_mesh = {};

    /// Facet `first_facet + triangle`, scene-local.
    Facet facet(std::uint32_t triangle) const {
        Facet out = facets[triangle];
        if (!placed) return out;
        out.vertex = T_local_mesh.leftCols<3>() * out.vertex + T_local_mesh.col(3);
        out.normal = T_local_mesh.leftCols<3>() * out.normal;
        if (scaled) out.normal.normalize();
        return out;
    }
};

/// A tree that rays are traced through, and its instances or meshes.
struct TracedLayer {
    RTCScene tree = nullptr;
    std::span<const TracedMesh> meshes = {};
};

/// One value for all rays, or one for each ray.
template <class T>
struct PerRay {
    const T* first = nullptr;
    std::size_t step = 0;  ///< 0: all rays share the first

    const T& of(std::size_t ray) const { return first[step * ray]; }
};

/// The rays of a query.
struct RayList {
    PerRay<Eigen::Vector3f> origins;
    std::span<const Eigen::Vector3f> directions;
    PerRay<float> reach_m;
    bool any_hit = false;                  ///< any facet within reach, not the nearest
    std::vector<MetFacet>* all = nullptr;  ///< takes all facets within reach, in no order
};

/// Traces rays in packets to the nearest hit in any layer: `facets[i]` is the facet that ray i
/// meets within its reach, or RTC_INVALID_GEOMETRY_ID; untouched if the list takes all.
/// Embree only proposes facets, since makers of processors differ in its estimates of reciprocals.
/// The distance of a facet's plane tells which is the nearest and whether it is in reach. If facets
/// coincide to within rounding, the one with the least number counts.
void trace_packets(std::span<const TracedLayer> layers, const RayList& list,
                   std::span<std::uint32_t> facets);

}  // namespace sonarsim
