#include "simulate/assembly/engine_at.h"

#include "simulate/assembly/poses.h"

namespace sonarsim {

std::shared_ptr<const VisibilityEngine> engine_at(const VisibilityEngine& engine,
                                                  std::span<const Trajectory> motions, double t_s) {
    if (!motions.empty()) return engine.at(poses_at(motions, t_s));
    return {std::shared_ptr<const VisibilityEngine>(), &engine};  // owns nothing
}

}  // namespace sonarsim
