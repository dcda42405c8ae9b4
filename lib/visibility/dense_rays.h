#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "scene/scene.h"
#include "visibility/caster.h"
#include "visibility/engine.h"
#include "visibility/probe.h"

namespace sonarsim {

/// With more triangles than this `auto` takes rays for every view. A ping of the slices needs up to
/// 600 bytes for each triangle in view: measured over rough ground, 5 GB and 60 s for 8.4 million.
constexpr std::size_t many_triangles = std::size_t{1} << 21;

/// A density of rays (rays_engine.h) for a view.
struct RaysDensity {
    int density;
    /// Bound of the relative L1 of its images; NaN for the greatest density, whose images only have
    /// their own estimates.
    double error;
};

/// The least density whose images meet the goal of a view on its probes, or the greatest if none
/// does. The error of an image is bounded by its difference from the image of the greatest density,
/// plus the estimate of the latter. The estimate of sparse rays alone does not suffice: over rough
/// ground they miss dark, narrow surface at grazing incidence, so the images of both of their sets
/// are too bright and agree. Only parts of a fan are traced.
RaysDensity density_for(const Scene& scene, const Caster& caster, const View& view,
                        std::span<const Probe> probes);

/// Rays for every view, with the density of density_for(). A view without probes gets the greatest
/// density of the others.
std::unique_ptr<VisibilityEngine> make_dense_rays_engine(const Scene& scene, const Caster& caster,
                                                         std::span<const Probe> probes);

}  // namespace sonarsim
