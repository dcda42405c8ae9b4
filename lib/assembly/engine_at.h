#pragma once

#include <memory>
#include <span>

#include "trajectory/trajectory.h"
#include "visibility/engine.h"

namespace sonarsim {

/// What an engine sees at a time of the trajectory: the engine itself where nothing moves, else one
/// with the bodies of the scene where `motions` take them. It must not outlive `engine`.
std::shared_ptr<const VisibilityEngine> engine_at(const VisibilityEngine& engine,
                                                  std::span<const Trajectory> motions, double t_s);

}  // namespace sonarsim
