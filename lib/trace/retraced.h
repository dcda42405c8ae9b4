#pragma once

#include <cstdint>
#include <vector>

#include "trace/multipath.h"
#include "trace/specular_path.h"

namespace sonarsim {

/// Surface that the sonar sees over reflectors, on paths that sound takes out and back. The samples
/// lie at their images behind the first reflector: reflectors are flat, so the path to an image is
/// straight, and sound spreads over its whole length. The strength of a sample includes all
/// reflections, two-way.
struct RetracedSurface {
    std::vector<Sample> samples;
    /// The first reflector of each sample: an index into the samples of the ping.
    std::vector<std::uint32_t> sources;
    /// Surface that sound reaches over one way and leaves over another.
    std::vector<SpecularPath> unequal;
};

/// Follows the sound from each sample on, from reflection to reflection. Surface that it meets
/// after one reflection or more, up to Multipath::retraced, scatters it back. The water's surface,
/// whose scattering is not known here, only reflects it. Surface that is also seen over some of
/// these reflectors, or over none, is in `unequal`, unless find_bounces() has it.
RetracedSurface retraced_surface(const Multipath& multipath, const TraceContext& trace,
                                 const Samples& samples, MultipathCounts& counts);

}  // namespace sonarsim
