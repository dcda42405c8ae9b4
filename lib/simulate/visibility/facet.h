#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace sonarsim {

/// The data of a triangle that a ray has met; 32 bytes, half a cache line.
struct Facet {
    Eigen::Vector3f vertex;  ///< one of its corners, scene-local, m
    std::uint32_t material;
    Eigen::Vector3f normal;  ///< unit
    std::uint32_t instance;
};

/// The distance between neighbours in a list of rays. It affects only the time.
enum class RaySpread {
    close,  ///< neighbours take similar paths through the scene
    wide    ///< neighbours soon diverge
};

}  // namespace sonarsim
