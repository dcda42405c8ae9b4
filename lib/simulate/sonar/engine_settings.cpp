#include "simulate/sonar/engine_settings.h"

namespace sonarsim {

EngineSettings engine_settings(EngineKind kind, const OctreeConfig& octree) {
    return {.type = kind, .octree = {.leaf_m = octree.leaf_m}};
}

EngineSettings engine_settings(const Mission& mission) {
    return engine_settings(mission.engine, mission.octree);
}

}  // namespace sonarsim
