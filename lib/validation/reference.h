#pragma once

#include <cstdint>
#include <vector>

#include "core/pose.h"
#include "scene/scene.h"
#include "visibility/caster.h"
#include "visibility/engine.h"

namespace sonarsim {

/// The truth that both engines approximate: the area-weighted mean over the visible surface of
/// every bin, by brute force.
struct Reference {
    int range_bins = 0;
    int beams = 0;
    std::vector<float> intensity;  ///< [range_bins, beams], noise-free, before pixel noise
    double moved = 1.0;            ///< relative L1 by which doubling the rays last moved the image
    double rays_per_bin = 0.0;     ///< rays that echoed, per occupied bin
};

struct ReferenceGoal {
    double moved = 0.002;        ///< stop when a doubling moves the image by less
    double rays_per_bin = 64.0;  ///< and each occupied bin has had this many rays on average
    std::uint64_t rays_max = 400'000'000;  ///< give up here; `moved` then says how far it got
};

/// Casts rays on a lattice over the view, doubling their number until the goal is met. Every ray
/// stands for r^2 dOmega / (v . n) of surface and counts in the one bin where it ends.
Reference cast_reference(const Caster& caster, const Scene& scene, const View& view,
                         const Pose& T_world_sensor, const ReferenceGoal& goal);

}  // namespace sonarsim
