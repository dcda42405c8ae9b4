#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/pose.h"
#include "scene/scene.h"
#include "visibility/caster.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The truth that all engines approximate: the area-weighted mean over the visible surface of
/// every bin, by brute force.
struct Reference {
    int range_bins = 0;
    int beams = 0;
    std::vector<float> intensity;  ///< [range_bins, beams], noise-free, before pixel noise
    /// Relative L1 by which it may still be off: the largest of `apart` and of what doubling the
    /// rays moved it by, along the columns and across them.
    double moved = 1.0;
    double apart = 1.0;         ///< relative L1 between it and the farther one of its two starts
    double rays_per_bin = 0.0;  ///< rays that echoed, per occupied bin
};

struct ReferenceGoal {
    double moved = 0.002;        ///< stop when Reference::moved is less
    double rays_per_bin = 64.0;  ///< and each occupied bin has had this many rays on average
    std::uint64_t rays_max = 400'000'000;  ///< give up here; `moved` then says how far it got
};

/// What a cast of so many rays, from either start and from both, shows: images [range_bins, beams].
struct Look {
    std::vector<float> lattice;
    std::vector<float> scattered;
    std::vector<float> both;
    std::uint64_t rays = 0;  ///< all that were cast
    std::uint64_t hits = 0;  ///< those that met surface
};

/// Looks again with twice the rays, along and across in turn, until the image of both starts has
/// settled: `per_beam` columns of `count` rays, as in RayLayout.
Reference settled(const View& view, const ReferenceGoal& goal,
                  const std::function<Look(int per_beam, int count)>& look);

/// Looks at the scene from two unlike starts, rays on a lattice and rays strewn at random, each
/// with points of the surface of its own, and doubles the rays until the goal is met. The
/// image is that of both together. A lattice alone settles on a wrong image where the scene repeats
/// at its step, and before it has met what is thinner than the step; it is the random start that
/// then disagrees, and the points of the surface that find what is thin
/// (validation/reference_cast.h). Every ray counts in the one bin where it ends.
Reference cast_reference(const Caster& caster, const Scene& scene, const View& view,
                         const Pose& T_world_sensor, const ReferenceGoal& goal);

}  // namespace sonarsim
