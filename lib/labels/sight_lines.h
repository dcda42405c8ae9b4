#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "trace/cone_beams.h"
#include "trace/traced_ping.h"

namespace sonarsim {

/// A sight line behind the visible surface.
struct SightLine {
    Eigen::Vector3f direction;
    float before_m;  ///< range of its sample
    float range_m;   ///< length so far
    float solid_angle;
    const Sample* sample;
    std::uint32_t beam;
    std::uint32_t first;   ///< the first node of its way
    std::uint32_t passed;  ///< the last one
};

/// The sight lines of a ping, one to a sample. `cones` exist for a line array.
std::vector<SightLine> sight_lines(const TracedPing& traced, const ConeBeams& cones, int beams);

/// Half the extent in range of the surface that a sight line meets, a piece of the plane with this
/// normal.
float half_extent(const SightLine& line, float range_m, const Eigen::Vector3f& normal);

/// The number of beams, at least 1, that a half edge of a line's sample spans.
int beams_along(const Eigen::Vector3f& half_edge, const SightLine& line, const ConeBeams& cones);

}  // namespace sonarsim
