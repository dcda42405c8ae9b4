#pragma once

#include <array>
#include <string>

#include "mission/source_location.h"

namespace sonarsim {

enum class ParticleKind { points, fish, bubbles };
enum class ParticleRegion { box, ellipsoid };

/// Point targets in the water. Pairs are limits of uniform draws.
struct ParticlesConfig {
    std::string name;        ///< the targets are NAME_1, NAME_2, ...
    std::string class_name;  ///< "": the name
    ParticleKind kind = ParticleKind::points;
    std::array<double, 2> target_strength_db{};  ///< for points, dB re 1 m^2
    std::array<double, 2> length_m{};            ///< for fish; 0: not given
    std::array<double, 2> radius_m{};            ///< for bubbles; 0: not given
    std::array<double, 2> count{};
    ParticleRegion region = ParticleRegion::box;
    std::array<double, 3> position_m{};  ///< middle of the region, world
    std::array<double, 3> size_m{};      ///< from end to end along x, y and z
    std::array<double, 3> drift_m_s{};
    double rise_m_s = 0.0;  ///< for bubbles, which come back at the bottom of the region
    SourceLocation place;

    bool operator==(const ParticlesConfig&) const = default;
};

/// The most particles of a group.
inline constexpr double most_particles = 1e6;
/// Larger groups are one object of the labels each.
inline constexpr double most_single_particles = 100;

}  // namespace sonarsim
