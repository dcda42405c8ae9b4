#pragma once

#include <string>

#include "mission/mission.h"

namespace sonarsim {

/// One engine with one resolution.
struct Setting {
    /// "rays", "slices", "octree", "literal" for the octree as in the paper, or "auto".
    std::string engine;
    std::string name;  ///< the mission's key and value, "relative_l1=0.03"
    EngineKind kind = EngineKind::rays;
    OctreeConfig octree;       ///< for the octree
    double relative_l1 = 0.0;  ///< error goal of rays, slices and auto
    bool current = false;      ///< the mission's own setting
    SlicesConfig slices = {};  ///< for the slices

    /// True if the engine promises an error of at most relative_l1 on every ping: rays, auto, and
    /// slices unless the mission sets their number.
    bool promises() const {
        return kind == EngineKind::rays || kind == EngineKind::automatic ||
               (kind == EngineKind::slices && slices.per_beam == 0);
    }
};

}  // namespace sonarsim
