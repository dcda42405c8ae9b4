#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>

#include "simulate/visibility/embree.h"

namespace sonarsim {

/// Throws std::bad_alloc, or std::runtime_error with the text `doing`, if Embree has failed since
/// the last call.
void check_embree(RTCDevice device, const char* doing);

/// The tree of a mesh, for trace_packets().
EmbreeTree make_tree(RTCDevice device, std::span<const Eigen::Vector3f> vertices,
                     std::span<const std::array<std::uint32_t, 3>> triangles);

/// Adds a mesh to a tree as its `index`-th. Not finished before commit().
void put_mesh(RTCDevice device, const EmbreeTree& into, unsigned int index,
              std::span<const Eigen::Vector3f> vertices,
              std::span<const std::array<std::uint32_t, 3>> triangles);

/// True if the first mesh of the tree, which has as many triangles, has these. All vertices belong
/// to triangles.
bool has_first_mesh(const EmbreeTree& tree, std::span<const Eigen::Vector3f> vertices,
                    std::span<const std::array<std::uint32_t, 3>> triangles);

/// Builds what has changed.
void commit(RTCDevice device, const EmbreeTree& tree);

/// Puts a tree into another, as its `index`-th instance.
void add_instance(RTCDevice device, const EmbreeTree& into, unsigned int index,
                  const EmbreeTree& tree, Eigen::Matrix<float, 3, 4> transform);

}  // namespace sonarsim
