#pragma once

#include <atomic>
#include <cstddef>
#include <vector>

#include "input/scene/scene.h"
#include "simulate/visibility/caster.h"
#include "simulate/visibility/clusters.h"
#include "simulate/visibility/engine.h"
#include "simulate/visibility/strips/strip_rule.h"
#include "simulate/visibility/strips/strip_triangles.h"
#include "simulate/visibility/view.h"

namespace sonarsim {

/// An engine that cuts the triangles in view into the columns of the view, a few for each beam, and
/// finds what nearer pieces of its column leave of each piece, on the line in the middle of it.
class StripsEngine final : public VisibilityEngine {
  public:
    /// `scene` must outlive it; the scene must have no bodies, no copies and no profile of sound
    /// speed.
    StripsEngine(const Scene& scene, const Caster& caster);

    Samples visible_surface(const View& view, const Pose& T_world_sensor) const override;

  private:
    std::vector<std::uint32_t> clusters_in(const View& view, Pose T_local_sensor) const;
    void scan(const ColumnFrame& frame, const StripTriangles& triangles, const LocalPose& pose,
              const StripRule& rule, Samples& samples) const;

    ClusterMesh mesh_;
    /// Samples of the last ping, for which room is reserved: over a million triangles
    /// growing costs half the time.
    mutable std::atomic<std::size_t> last_samples_{0};
};

}  // namespace sonarsim
