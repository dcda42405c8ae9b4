#pragma once

namespace sonarsim {

/// The method that finds the visible surface; `automatic` chooses one.
enum class EngineKind { automatic, rays, octree, slices, strips };

}  // namespace sonarsim
