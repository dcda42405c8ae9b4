#pragma once

#include <memory>

#include "scene/scene.h"
#include "visibility/caster.h"
#include "visibility/engine.h"

namespace sonarsim {

struct SlicesOptions {
    int per_beam = 0;  ///< slices per beam; 0: the view's error goal determines them
};

/// The slices engine: half-planes through the sensor, exact along each. `scene` must outlive it.
/// Throws std::runtime_error when Embree, which traces the secondary rays, cannot build its tree.
std::unique_ptr<VisibilityEngine> make_slices_engine(const Scene& scene,
                                                     const SlicesOptions& options);
/// The same with a caster over the scene, whose trees engines may share.
std::unique_ptr<VisibilityEngine> make_slices_engine(const Scene& scene, const Caster& caster,
                                                     const SlicesOptions& options);

}  // namespace sonarsim
