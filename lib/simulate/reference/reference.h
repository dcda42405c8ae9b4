#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/pose.h"
#include "input/scene/scene.h"
#include "simulate/visibility/caster.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// The ground truth that all engines approximate: the area-weighted mean over the visible surface
/// in every bin, by brute force.
struct Reference {
    int range_bins = 0;
    int beams = 0;
    std::vector<float> intensity;  ///< [range_bins, beams], noise-free, before pixel noise
    std::vector<std::uint8_t> scored;  ///< 1: at least one scatterer cell of visible surface
    /// Bound of its own relative L1: the largest of `apart` and of the changes by the last doubling
    /// of rays along the columns and across them.
    double moved = 1.0;
    /// Relative L1 of the image of the farther of its two starts: its own noise, since the mean of
    /// two independent images is as far from the truth as from each of them.
    double apart = 1.0;
    double rays_per_bin = 0.0;  ///< rays that echoed, per occupied bin
};

struct ReferenceGoal {
    double moved = 0.002;        ///< stop when Reference::moved is below this
    double rays_per_bin = 64.0;  ///< minimum mean number of rays per occupied bin
    /// Stop at this number in any case; `moved` then is the change that was reached.
    std::uint64_t rays_max = 400'000'000;
    double cell_m2 = 1e-4;  ///< scatterer cell: least visible surface of a bin that is scored
};

/// Result of a cast with a given number of rays: images [range_bins, beams] of each start and of
/// both.
struct CastResult {
    std::vector<float> lattice;
    std::vector<float> scattered;
    std::vector<float> both;
    std::vector<double> area_m2;  ///< visible surface in each bin
    std::uint64_t rays = 0;  ///< all rays cast
    std::uint64_t hits = 0;  ///< rays that met surface
};

/// Casts again with twice the rays, along and across in turn, until the image of both starts has
/// settled: `per_beam` columns of `count` rays, as in RayLayout. Errors are over the scored bins.
Reference settled(const View& view, const ReferenceGoal& goal,
                  const std::function<CastResult(int per_beam, int count)>& cast);

/// Casts rays from two different starts, on a lattice and at random, each with its own points of
/// the surface, and doubles the rays until the goal is met. The image is that of both together. A
/// lattice alone may settle on a wrong image if the scene repeats at the step of the lattice, or if
/// objects are thinner than the step. The random start disagrees in the first case, and points of
/// the surface find thin objects (simulate/reference/reference_cast.h). Every ray counts only in
/// the bin where it ends.
Reference cast_reference(const Caster& caster, const Scene& scene, const View& view,
                         const Pose& T_world_sensor, const ReferenceGoal& goal);

}  // namespace sonarsim
