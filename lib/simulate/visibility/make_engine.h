#pragma once

#include <cstddef>
#include <memory>
#include <string>

#include "core/engine_kind.h"
#include "input/scene/scene.h"
#include "simulate/visibility/caster.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// With more triangles than this rays are dense where a bin holds a mean.
constexpr std::size_t many_triangles = std::size_t{1} << 21;

struct EngineSettings {
    EngineKind type = EngineKind::rays;
    double octree_leaf_m = 0.02;  ///< edge of the octree's leaves
    /// A caster over the scene, whose trees the rays and the strips then use; null: they make one.
    std::shared_ptr<const Caster> caster = {};
};

/// Makes the engine over a scene, which must outlive it. Throws InputError when octree_leaf_m is
/// too small for the scene, and std::runtime_error when memory does not suffice.
std::unique_ptr<VisibilityEngine> make_engine(const Scene& scene, const EngineSettings& settings);

/// Error message, beginning with the mission's key, if it cannot take this scene; else empty.
std::string unsupported(const EngineSettings& settings, const Scene& scene);

/// Error message with the mission's keys if the engine does not support this view; empty otherwise.
std::string unsupported(const EngineSettings& settings, const View& view);

}  // namespace sonarsim
