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
enum class EdgeBin : std::uint8_t { not_asked, filled, dark };

/// Casts rays to the samples at the ends of bins that they only just fill or only just miss, and
/// moves the ends of these samples: a bin stays filled if one of its rays ends in it, and gets dark
/// otherwise. A sliver of surface makes a bin as bright as a wall does, and all slices agree on an
/// end that they all round alike. `image` is that of the samples. Returns the results of the bins,
/// [beams, range_bins].
std::vector<EdgeBin> settle_edge_bins(const Caster& caster, const View& view, const LocalPose& pose,
                                      const SampledImage& image, Samples& samples);

/// The share of an image's signal in bins that rays found dark: ends that could not be moved.
double share_in_dark_bins(const SampledImage& image, std::span<const EdgeBin> edges);

}  // namespace sonarsim
