#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>

#include "simulate/visibility/embree.h"
#include "simulate/visibility/ray_spread.h"

namespace sonarsim {

/// A tree that rays are traced through. The facet numbers of its k-th instance or mesh start at
/// `first_facet[k]`.
struct TracedLayer {
    RTCScene tree = nullptr;
    std::span<const std::uint32_t> first_facet = {};
};

/// Origins of rays: one common point, or one for each ray.
struct RayOrigins {
    const Eigen::Vector3f* first = nullptr;
    std::size_t step = 0;  ///< 0: all rays share the first origin

    const Eigen::Vector3f& of(std::size_t ray) const { return first[step * ray]; }
};

/// Traces rays in packets to the nearest hit in any layer: `facets[i]` is the facet that ray i
/// meets within `reach_m`, or RTC_INVALID_GEOMETRY_ID.
void trace_packets(std::span<const TracedLayer> layers, const RayOrigins& origins,
                   std::span<const Eigen::Vector3f> directions, float reach_m, RaySpread spread,
                   std::span<std::uint32_t> facets);

}  // namespace sonarsim
