#include "assembly/engine_at.h"

#include "assembly/poses.h"

namespace sonarsim {

std::shared_ptr<const VisibilityEngine> engine_at(const VisibilityEngine& engine,
                                                  std::span<const Trajectory> motions, double t_s) {
    // This pointer owns nothing.
    if (motions.empty()) return {std::shared_ptr<const VisibilityEngine>(), &engine};
    return engine.at(poses_at(motions, t_s));
}

}  // namespace sonarsim
