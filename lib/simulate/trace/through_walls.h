#pragma once

#include <span>

#include "simulate/trace/multipath.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// Adds the surface that sound reaches through thin walls of `samples`. `transmissions`:
/// the share of the power that passes a wall out and back, by material; 0: none; empty: no material
/// is a wall. Sound goes straight on behind a wall, and the strength of a sample is what the walls
/// before it leave. Maps and motion are not applied.
void add_behind_walls(std::span<const float> transmissions, const TraceContext& context,
                      Samples& samples);

}  // namespace sonarsim
