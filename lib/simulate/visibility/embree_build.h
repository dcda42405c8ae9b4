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

/// The tree of a mesh.
EmbreeTree make_tree(RTCDevice device, std::span<const Eigen::Vector3f> vertices,
                     std::span<const std::array<std::uint32_t, 3>> triangles);

/// Puts a tree into another, as its `index`-th instance.
void add_instance(RTCDevice device, const EmbreeTree& into, unsigned int index,
                  const EmbreeTree& tree, Eigen::Matrix<float, 3, 4> transform);

}  // namespace sonarsim
