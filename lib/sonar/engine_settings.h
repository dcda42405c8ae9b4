#pragma once

#include "mission/mission.h"
#include "visibility/make_engine.h"

namespace sonarsim {

/// The settings of a mission's `engine`, `octree` and `slices` keys. For `auto` see also
/// assembly/engine_probes.h.
EngineSettings engine_settings(EngineKind kind, const OctreeConfig& octree = {},
                               const SlicesConfig& slices = {});
EngineSettings engine_settings(const Mission& mission);

}  // namespace sonarsim
