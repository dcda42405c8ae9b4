#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "core/pose.h"
#include "input/scene/scene.h"
#include "simulate/ping/sonar.h"
#include "simulate/reference/reference_cast.h"
#include "simulate/visibility/caster.h"
#include "simulate/visibility/engine.h"

namespace sonarsim {

/// Sums over the visible surface in every bin, [range_bins, beams], by one of several independent
/// casts. A bin's value is echo / weight. The paper's model: `weight` is an area. The calibrated
/// model, where energies add: the same in all bins.
struct CastSums {
    std::vector<float> echo;
    std::vector<float> weight;
};

/// The ground truth by brute force: the mean over the visible surface in a bin, or its energies.
struct Reference {
    int range_bins = 0;
    int beams = 0;
    std::vector<float> intensity;      ///< [range_bins, beams], noise-free, before pixel noise
    std::vector<std::uint8_t> scored;  ///< 1: at least one scatterer cell of visible surface
    std::vector<CastSums> casts;       ///< independent of each other; `intensity` is of them all
    /// Expected relative L1 of `intensity` over the scored bins, from the differences of the casts.
    double noise = 1.0;
    double rays_per_bin = 0.0;  ///< rays that echoed, per occupied bin
};

struct ReferenceGoal {
    double noise = 0.002;        ///< stop when Reference::noise is below this
    double rays_per_bin = 64.0;  ///< minimum mean number of rays per occupied bin
    /// Stop before this number in any case.
    std::uint64_t rays_max = 400'000'000;
    double cell_m2 = 1e-4;    ///< scatterer cell: least visible surface of a bin that is scored
    std::uint32_t start = 0;  ///< RayLayout::start of the first cast
    /// Stop as soon as `rays_max` will not suffice for `noise`.
    bool gives_up = false;
};

struct CastResult {
    std::vector<double> echo;     ///< see CastSums
    std::vector<double> weight;   ///< see CastSums
    std::vector<double> area_m2;  ///< visible surface in each bin
    std::uint64_t rays = 0;       ///< all rays cast
    std::uint64_t hits = 0;       ///< rays that met surface
};

/// Adds rounds of independent casts, each with twice the rays of the last one, along the columns
/// and across them in turn, until the goal is met or the rays are used up.
Reference settled(const View& view, const ReferenceGoal& goal,
                  const std::function<CastResult(const RayLayout&)>& cast);

/// Casts rays over the directions of the view, and to points of the surface
/// (simulate/reference/reference_cast.h): points find objects that are thinner than the step of the
/// rays. Every ray counts only in the bin where it ends.
Reference cast_reference(const Caster& caster, const Scene& scene, const View& view,
                         const Pose& T_world_sensor, const ReferenceGoal& goal);

/// The relative L1 of an image A over the scored bins, by an estimate that the noise of the
/// reference does not enter: in (A - B1) sign(A - B2) with independent B1 and B2 it has no part on
/// average. Where B2 is noisier than the image is off, some signs are wrong and the estimate is too
/// low, by about the square of the noise. So B2 is once one cast, and once all but that of B1, and
/// the line through both estimates gives that without noise. An error of twice Reference::noise is
/// found to within about a tenth, a smaller one is too low; 0 at least.
double error_without_noise(std::span<const float> image, const Reference& truth);

/// Error of an image A against the truth B; both noise-free and before pixel noise.
struct ImageError {
    double relative_l1 = 0.0;  ///< sum |A - B| / sum B
    double miss_rate = 0.0;    ///< bins occupied only in B, per bin occupied in B
};

/// The error over the bins that `scored` marks with 1; empty: over all. Two dark images have no
/// error; against a dark truth any echo is an error of 1.
ImageError image_error(std::span<const float> image, std::span<const float> truth,
                       std::span<const std::uint8_t> scored = {});

/// The ground truth of the calibrated model, where energies add: its expected image, without
/// speckle and noise, from single points of the surface, each with the area that it represents. The
/// number of points grows until the image has settled. Casts rays as cast_reference() does.
/// `settings` must be of a calibrated sonar. Its targets are sampled as in a ping, since points of
/// their flat triangles would be another surface; so errors of targets do not show. Sound through
/// thin walls continues from the points as it does from samples.
Reference cast_energy_reference(const Caster& caster, const Scene& scene,
                                const PingSettings& settings, const Pose& T_world_sensor,
                                const ReferenceGoal& goal);

}  // namespace sonarsim
