#pragma once

#include <memory>
#include <span>

#include "core/pose.h"
#include "scene/scene.h"
#include "visibility/engine.h"
#include "visibility/slices/slices_engine.h"

namespace sonarsim {

/// A view, and a pose that the scene is seen from.
struct Probe {
    View view;
    Pose T_world_sensor;
    double rays_goal = 0.0;  ///< above 0: take rays, at this goal, whatever the error by slices
};

/// Rays for a view, as the probes of this view showed them beside slices.
struct RaysTrial {
    double goal = 0.0;  ///< error goal to sample for with rays; above the view's where that will do
    double error = 0.0;  ///< bound of the rays' relative L1: to the slices' images, plus their own
    double samples_share = 0.0;  ///< the rays' samples as a share of the slices'
};

/// The most lenient goal at which the rays meet the view's, and the worst of the probes at it.
/// Where they miss it even at their own, the first probe that shows so.
RaysTrial try_rays(const Scene& scene, const View& view, std::span<const Probe> probes,
                   const VisibilityEngine& rays, const VisibilityEngine& slices);

/// Whether `auto` takes rays for a view: they meet its error goal with less than half of the
/// samples. That is so over smooth surface that is cut more finely than a beam is wide, where every
/// triangle in view costs the slices something.
bool rays_are_better(const RaysTrial& trial, const View& view);

/// Slices, or rays for those views among the `probes` for which these are better or that need them.
/// Nothing is timed: the same scene and probes give the same choice everywhere.
/// Scenes of few triangles get slices without a look, those with bodies or copies rays, which alone
/// see them. The estimated error of a ping by rays is the bound found on the probes. `scene` must
/// outlive it. Throws std::runtime_error when Embree cannot build its tree.
std::unique_ptr<VisibilityEngine> make_auto_engine(const Scene& scene, const SlicesOptions& slices,
                                                   std::span<const Probe> probes);

}  // namespace sonarsim
