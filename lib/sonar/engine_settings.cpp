#include "sonar/engine_settings.h"

#include <algorithm>

namespace sonarsim {

EngineSettings engine_settings(EngineKind kind, const OctreeConfig& octree,
                               const SlicesConfig& slices) {
    return {.type = kind,
            .octree = {.leaf_m = octree.leaf_m},
            .slices = {.per_beam = slices.per_beam}};
}

EngineSettings engine_settings(const Mission& mission) {
    EngineSettings settings = engine_settings(mission.engine, mission.octree, mission.slices);
    settings.coverage = std::ranges::count(mission.output.labels, Label::shadow) > 0;
    return settings;
}

}  // namespace sonarsim
