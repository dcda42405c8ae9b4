#pragma once

#include <memory>
#include <span>

#include "input/trajectory/trajectory.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The engine for a ping at a time of the trajectory, with the scene's bodies at their poses then.
/// It must not outlive `engine`.
std::shared_ptr<const VisibilityEngine> engine_at(const VisibilityEngine& engine,
                                                  std::span<const Trajectory> motions, double t_s);

}  // namespace sonarsim
