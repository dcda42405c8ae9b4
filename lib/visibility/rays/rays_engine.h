#pragma once

#include <memory>

#include "scene/scene.h"
#include "visibility/caster.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The ray tracing engine, based on Embree. `scene` must outlive it. Throws
/// std::runtime_error when Embree cannot build its tree (out of memory).
std::unique_ptr<VisibilityEngine> make_rays_engine(const Scene& scene);
/// Factors on the number of rays of a goal.
struct RaysExcess {
    /// n: a goal that is n times as fine, and n times as many columns. The rays of a goal sample
    /// lines within a beam. Over ground that is rough within the width of a beam, the lines do not
    /// represent the beam.
    int density = 1;
    /// n > 1: n times as many columns with as many rays each, rounded up to an odd number of
    /// columns. A beam narrower than the view receives most from the middle, so a column must lie
    /// there.
    int columns = 1;
};

/// The same with a caster over the scene, whose trees engines may share.
std::unique_ptr<VisibilityEngine> make_rays_engine(const Scene& scene, const Caster& caster,
                                                   const RaysExcess& excess = {});

}  // namespace sonarsim
