#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "simulate/trace/surface_echoes.h"
#include "simulate/trace/traced_ping.h"

namespace sonarsim {

/// A sight line behind the visible surface. It stands for a part of its sample's footprint, whose
/// half edges are these shares of the sample's.
struct SightLine {
    Eigen::Vector3f direction;
    float before_m;  ///< range of its sample
    float range_m;   ///< length so far
    float solid_angle;
    const Sample* sample;
    float share_u, share_v;
    std::uint32_t beam, last_beam;  ///< its part of the footprint covers them
    std::uint32_t last_node = 0;    ///< the last node of its way
};

/// Tells which sight lines are kept: most have nothing to find.
using KeepLine = std::function<bool(const SightLine&)>;

/// The sight lines of a ping, one to a sample.
std::vector<SightLine> sight_lines(const TracedPing& traced, const SurfaceEchoes& echoes, int beams,
                                   const KeepLine& keep);

/// The width of sight lines: of a line array, so many of its beams, which it does not resolve; else
/// that at which the surface that they meet is a few bins deep.
struct LineWidth {
    const ConeBeams& cones;
    int beams;
    const View& view;
};

/// The numbers of parts into which the edges of a line's sample are divided, as a sample may span
/// many beams and much of the elevation.
struct LineParts {
    int u = 1, v = 1;
};

/// The parts for a line that meets this surface, or none.
LineParts parts_of(const SightLine& line, const Intersection& met, const LineWidth& width);

/// Appends the parts of a line that has not left its sample.
void divide(const SightLine& line, const LineParts& parts, const LineWidth& width,
            const KeepLine& keep, std::vector<SightLine>& out);

/// Half the extent in range of the surface that a sight line meets, a piece of the plane with this
/// normal. At most four bins if the width divides lines by bins.
float half_extent(const SightLine& line, float range_m, const Eigen::Vector3f& normal,
                  const LineWidth& width);

}  // namespace sonarsim
