#pragma once

#include <cstdint>
#include <vector>

#include "trace/multipath.h"
#include "trace/specular_path.h"

namespace sonarsim {

/// Surface that the sonar sees over reflectors, where sound also comes back the way that it
/// went. It lies where it appears, behind the first reflector: reflectors are flat, so that sound
/// goes straight in the world that is folded out, and spreads over its whole way there. The
/// strength of a sample has all reflections, out and back.
struct RetracedSurface {
    std::vector<Sample> samples;
    /// The sample of the first reflector of each: index into those of the ping.
    std::vector<std::uint32_t> sources;
    /// Surface that sound reaches over one way and comes back from over another.
    std::vector<SpecularPath> unequal;
};

/// Follows the sound from each sample on, from reflection to reflection. What it meets after one or
/// more, up to Multipath::retraced, is surface that scatters it back; the water's surface, of
/// which this is not known, only reflects it. Surface that is also seen over some of these
/// reflectors, or over none, is in `unequal`, unless find_bounces() has it.
RetracedSurface retraced_surface(const Multipath& multipath, const TraceContext& trace,
                                 const Samples& samples, MultipathCounts& counts);

}  // namespace sonarsim
