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
    double estimate;   ///< the engine's own; NaN: none

    /// The error is above the goal by more than the error of the reference; the estimate is not.
    bool missed_in_silence() const { return error - reference > goal && !(estimate > goal); }
    bool warned_in_vain() const { return error <= goal && estimate > goal; }
};

/// The image as the program makes it, without noise and gain, and the engine's estimate.
Ping render_lattice(const Lattice& lattice, const VisibilityEngine& engine, double goal);

/// The noise-free image of a drawn scene by at most `rays` view rays and rays to points of the
/// surface, in two independent halves.
Reference lattice_reference(const Lattice& lattice, std::uint64_t rays);

/// Renders scene `number` at each goal and compares it with its reference and the slivers that the
/// reference missed (support/slivers.h), or that rays to the image's samples meet. Empty if the
/// sonar sees too few bins to judge.
std::vector<LatticeError> lattice_errors(std::uint32_t number, const Lattice& lattice,
                                         const Reference& reference, EngineKind engine,
                                         const std::vector<double>& goals);

/// The shares of pings that missed their goal in silence and that were warned of in vain, by kind
/// of sonar and goal; a Markdown table.
std::string lattice_table(const std::vector<LatticeError>& errors);

}  // namespace sonarsim::test
