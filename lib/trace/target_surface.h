#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/pose.h"
#include "scene/scene.h"
#include "trace/target_facet.h"
#include "trace/target_shapes.h"
#include "trace/visible_surface.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The objects of a ping that are sampled triangle by triangle. An image leaves out the engine's
/// samples of them.
struct TargetSurface {
    std::vector<std::uint32_t> instances;  ///< ascending
    std::vector<TargetFacet> facets;       ///< instance after instance, region after region

    bool has(std::uint32_t instance) const {
        return std::ranges::binary_search(instances, instance);
    }
};

/// Samples those objects that the samples of an engine cannot represent in this view, because they
/// or their highlights are few resolution cells across. A part of a triangle is seen if a ray from
/// the sonar reaches it. The result does not depend on the engine.
TargetSurface target_surface(const TargetShapes& shapes, const View& view,
                             const GuardBeams& guard_beams, const Scene& scene,
                             const VisibilityEngine& engine, const Pose& T_world_sensor);

}  // namespace sonarsim
