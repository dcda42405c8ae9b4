#include "sonar/engine_settings.h"

namespace sonarsim {

EngineSettings engine_settings(EngineKind kind, const OctreeConfig& octree,
                               const SlicesConfig& slices) {
    return {.type = kind,
            .octree = {.leaf_m = octree.leaf_m},
            .slices = {.per_beam = slices.per_beam}};
}

EngineSettings engine_settings(const Mission& mission) {
    return engine_settings(mission.engine, mission.octree, mission.slices);
}

}  // namespace sonarsim
