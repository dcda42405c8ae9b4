#pragma once

#include <atomic>
#include <cstddef>
#include <memory>

#include "input/scene/scene.h"
#include "simulate/visibility/caster.h"
#include "simulate/visibility/clusters_in_view.h"
#include "simulate/visibility/engine.h"
#include "simulate/visibility/strips/strip_rule.h"
#include "simulate/visibility/strips/strip_triangles.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// An engine that cuts the triangles in view into the columns of the view, a few for each beam, and
/// finds what nearer pieces of its column leave of each piece, on the line in the middle of it.
class StripsEngine final : public VisibilityEngine {
  public:
    /// `scene` must outlive it; it must have no profile of sound speed.
    StripsEngine(const Scene& scene, const Caster& caster);
    /// The same with Scene::bodies where `moved` has them.
    StripsEngine(const StripsEngine& at_rest, const Caster& moved);

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override;

  private:
    /// Shared by the engines of one scene.
    struct Shared {
        SceneClusters clusters;
        /// Samples of the last ping, for which room is reserved: over a million triangles
        /// growing costs half the time.
        std::atomic<std::size_t> last_samples{0};
    };

    static void scan(const ColumnFrame& frame, const ClustersInView& clusters,
                     const StripTriangles& triangles, const StripRule& rule, Samples& samples);

    std::shared_ptr<Shared> shared_;
};

}  // namespace sonarsim
