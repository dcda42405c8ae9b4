#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "support/lattices.h"
#include "trace/ping.h"
#include "validation/reference.h"
#include "visibility/engine.h"

namespace sonarsim::test {

/// One ping of a drawn scene at one error goal.
struct LatticeError {
    SonarKind kind;
    std::string shape;
    std::uint32_t number;
    double goal;
    double error;      ///< relative L1 of the noise-free image to the reference
    double reference;  ///< the reference's own error: how far its two independent halves are apart
};

/// The image as the program makes it, without noise and gain.
Ping render_lattice(const Lattice& lattice, const VisibilityEngine& engine, double goal);

/// The noise-free image of a drawn scene by at most `rays` view rays and rays to points of the
/// surface, in two independent halves.
Reference lattice_reference(const Lattice& lattice, std::uint64_t rays);

/// Renders scene `number` at each goal and compares it with its reference and the slivers that the
/// reference missed (support/slivers.h). Empty if the sonar sees too few bins to judge.
std::vector<LatticeError> lattice_errors(std::uint32_t number, const Lattice& lattice,
                                         const Reference& reference, EngineKind engine,
                                         const std::vector<double>& goals);

/// The shares of pings over their goal, by kind of sonar and goal; a Markdown table.
std::string lattice_table(const std::vector<LatticeError>& errors);

}  // namespace sonarsim::test
