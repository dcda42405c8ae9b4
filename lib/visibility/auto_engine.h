#pragma once

#include <memory>
#include <span>

#include "scene/scene.h"
#include "visibility/engine.h"
#include "visibility/probe.h"
#include "visibility/slices/slices_engine.h"

namespace sonarsim {

/// Result of a comparison of rays with slices on the probes of a view.
struct RaysTrial {
    double goal = 0.0;  ///< error goal of the rays; above the view's goal if that suffices
    /// Bound of the rays' relative L1: difference from the slices' images, plus their error.
    double error = 0.0;
    double samples_share = 0.0;  ///< number of samples of the rays / of the slices
};

/// Returns the most lenient goal at which the rays meet the view's goal, and the worst probe at
/// that goal. If they miss it even at the view's own goal, returns the first probe that misses it.
RaysTrial try_rays(const Scene& scene, const View& view, std::span<const Probe> probes,
                   const VisibilityEngine& rays, const VisibilityEngine& slices);

/// True if `auto` takes rays for a view: they meet its error goal with less than half of the
/// samples. This happens over smooth surface with triangles narrower than a beam, since slices need
/// time for every triangle in view.
bool rays_are_better(const RaysTrial& trial, const View& view);

/// Makes an engine of slices, or of rays for those views among the `probes` for which rays are
/// better or required. The choice uses no times: the same scene and probes give the same choice
/// everywhere. Scenes of few triangles get slices without a comparison; scenes with bodies or
/// copies get rays, the only engine that traces them, and scenes of many triangles get the rays of
/// dense_rays.h. The estimated error of a ping by rays is the bound found on the probes, or the
/// rays' own if they were required. `scene` must outlive the engine. Throws std::runtime_error when
/// Embree cannot build its tree.
std::unique_ptr<VisibilityEngine> make_auto_engine(const Scene& scene, const SlicesOptions& slices,
                                                   std::span<const Probe> probes);
/// The same with a caster over the scene, whose trees engines may share.
std::unique_ptr<VisibilityEngine> make_auto_engine(const Scene& scene, const Caster& caster,
                                                   const SlicesOptions& slices,
                                                   std::span<const Probe> probes);

}  // namespace sonarsim
