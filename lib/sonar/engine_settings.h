#pragma once

#include "mission/mission.h"
#include "visibility/make_engine.h"

namespace sonarsim {

/// What a mission's `engine`, `octree` and `slices` keys stand for. For `auto` see also
/// assembly/engine_probes.h.
EngineSettings engine_settings(EngineKind kind, const OctreeConfig& octree = {},
                               const SlicesConfig& slices = {});
EngineSettings engine_settings(const Mission& mission);

}  // namespace sonarsim
