#pragma once

#include "input/mission/mission.h"
#include "simulate/visibility/make_engine.h"

namespace sonarsim {

/// The settings of a mission's `engine` and `octree` keys. For `auto` see also
/// simulate/assembly/engines.h.
EngineSettings engine_settings(EngineKind kind, const OctreeConfig& octree = {});
EngineSettings engine_settings(const Mission& mission);

}  // namespace sonarsim
