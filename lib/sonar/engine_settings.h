#pragma once

#include "mission/mission.h"
#include "visibility/make_engine.h"

namespace sonarsim {

/// What a mission's `engine`, `octree` and `slices` keys stand for. `auto` is rays: in the
/// speed-against-error report they reach every error goal in less time than the octree, on every
/// scene.
EngineSettings engine_settings(EngineKind kind, const OctreeConfig& octree = {},
                               const SlicesConfig& slices = {});
EngineSettings engine_settings(const Mission& mission);

}  // namespace sonarsim
