#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "simulate/calibrated/sonar_equation.h"
#include "simulate/calibrated/specular_path.h"

namespace sonarsim {

/// A block of echoes that return from another place than they were sent to, with powers and range
/// bins as in PointEchoes.
struct SpecularBlock {
    PathEndpoint out;    ///< the ranges of its echoes are those of the places
    PatchBlock& places;  ///< the echoes come back from these
    PointEchoes& echoes;
    std::span<const std::uint32_t> path;  ///< index into the paths
};

/// Finds the echoes of specular paths, and calls `use` for blocks of them. With the piece at the
/// range r and its image at the range s,
///
///     EL = SL + S + 10 log R + 10 log A + D - 20 log r - 20 log s - alpha (r + s)    dB,
///
/// in the range bin of (r + s) / 2: the reflector is assumed to be flat, so sound spreads as if it
/// came from the image. S is bistatic, for the two directions (Backscatter::between). Sound takes
/// the path in both senses with the same power: out to the image and back from the piece, and the
/// reverse. D is the transmitting pattern towards the one end times the receiving pattern towards
/// the other.
///
/// Returns the number of these echoes outside the range.
std::uint64_t find_specular_echoes(std::span<const SpecularPath> paths,
                                   std::span<const Backscatter> materials,
                                   const SonarEquation& equation, const PointLimits& limits,
                                   const std::function<void(const SpecularBlock&)>& use);

}  // namespace sonarsim
