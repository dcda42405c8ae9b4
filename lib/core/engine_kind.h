#pragma once

namespace sonarsim {

/// The method that finds the visible surface; `automatic` chooses one.
enum class EngineKind { automatic, rays, octree, strips };

}  // namespace sonarsim
