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

/// The width of sight lines of a line array.
struct LineWidth {
    const ConeBeams& cones;
    int beams;  ///< so many beams, which the array does not resolve
};

/// True if the footprint of a line's sample is no wider.
bool is_narrow(const SightLine& line, const LineWidth& width);

/// Parts of the sight lines of a line array, since a sample may span many beams and much of the
/// elevation.
std::vector<SightLine> divided(std::span<const SightLine> lines, const LineWidth& width,
                               const KeepLine& keep);

/// Half the extent in range of the surface that a sight line meets, a piece of the plane with this
/// normal.
float half_extent(const SightLine& line, float range_m, const Eigen::Vector3f& normal);

}  // namespace sonarsim
