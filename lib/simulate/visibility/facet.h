#pragma once

#include <Eigen/Core>
#include <compare>
#include <cstdint>

namespace sonarsim {

/// The data of a triangle that a ray has met; 32 bytes, half a cache line.
struct Facet {
    Eigen::Vector3f vertex;  ///< one of its corners, scene-local, m
    std::uint32_t material;
    Eigen::Vector3f normal;  ///< unit
    std::uint32_t instance;
};

/// A facet that a ray of a list meets.
struct MetFacet {
    std::uint32_t ray;
    float distance_m;
    std::uint32_t facet;

    auto operator<=>(const MetFacet&) const = default;  // NOLINT(modernize-use-nullptr): no pointer
};

}  // namespace sonarsim
