#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "visibility/caster.h"
#include "visibility/engine.h"
#include "visibility/local_pose.h"
#include "visibility/slices/sampled_image.h"

namespace sonarsim {

/// The result of rays for a bin at the end of surface.
enum class EdgeBin : std::uint8_t { not_tested, filled, dark };

/// Casts rays to the samples that only just fill or only just miss a bin, and moves the ends of
/// these samples: the bin is filled if one of its rays ends in it, and dark otherwise. A sliver of
/// surface makes a bin as bright as a wall does, and slices do not reveal the error, since all of
/// them round the end of the surface alike. `image` is that of the samples. Returns the results of
/// the bins, [beams, range_bins].
std::vector<EdgeBin> settle_edge_bins(const Caster& caster, const View& view, const LocalPose& pose,
                                      const SampledImage& image, Samples& samples);

/// The share of an image's signal in bins that rays found dark: the ends of samples there could not
/// be moved.
double share_in_dark_bins(const SampledImage& image, std::span<const EdgeBin> edges);

}  // namespace sonarsim
