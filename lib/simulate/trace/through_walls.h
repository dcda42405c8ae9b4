#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "simulate/trace/multipath.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The surface that sound reaches through thin walls of `surfaces`, in no order. `transmissions`:
/// the share of the power that passes a wall out and back, by material; 0: none; empty: no material
/// is a wall. Sound goes straight on behind a wall, and the strength of a sample is what the walls
/// before it leave. Maps and motion are not applied.
std::vector<Sample> surface_behind_walls(std::span<const float> transmissions,
                                         const TraceContext& context,
                                         std::initializer_list<std::span<const Sample>> surfaces);

}  // namespace sonarsim
