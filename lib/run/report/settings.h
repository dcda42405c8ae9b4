#pragma once

#include <string>
#include <vector>

#include "input/mission/mission.h"
#include "simulate/assembly/assemble.h"
#include "simulate/visibility/make_engine.h"

namespace sonarsim {

/// One engine with one resolution.
struct Setting {
    std::string engine;  ///< "rays", "strips", "octree" or "auto"
    std::string name;    ///< the mission's key and value, "relative_l1=0.03"
    EngineKind kind = EngineKind::rays;
    OctreeConfig octree;       ///< for the octree
    double relative_l1 = 0.0;  ///< error goal of all but the octree
    bool current = false;      ///< the mission's own setting

    /// True if relative_l1 sets the sampling.
    bool has_goal() const { return kind != EngineKind::octree; }
};

/// The settings of a report: rays and strips by error goal and the octree by leaf size, each from
/// coarse to fine, and `auto` at the mission's goal. Leaves finer than a quarter of the finest
/// range bin are omitted: they cost much and improve nothing. The mission's own setting is included
/// and marked.
std::vector<Setting> make_settings(const Mission& mission, bool quick);

/// The error message of a mission with this setting, if the engine does not support the scene or a
/// view of its sonars; empty otherwise.
std::string unsupported(const Setting& setting, const Assembly& assembly);

}  // namespace sonarsim
