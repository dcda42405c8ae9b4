#include "sonar/engine_settings.h"

namespace sonarsim {

EngineSettings engine_settings(EngineKind kind, const OctreeConfig& octree) {
    return {.type = kind == EngineKind::octree ? EngineType::octree : EngineType::rays,
            .octree = {.leaf_m = octree.leaf_m,
                       .memory_mb = static_cast<std::size_t>(octree.memory_mb),
                       .literal = octree.literal}};
}

}  // namespace sonarsim
