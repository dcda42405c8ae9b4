#pragma once

#include <span>

#include "trace/bounce_path.h"
#include "visibility/engine.h"
#include "visibility/view.h"

namespace sonarsim {

/// Estimates the share of the bins with multipath that `bounces` do not reach, plus twice its
/// standard error, by capture and recapture. The samples of even and of odd columns each form an
/// image, with footprints twice as wide, which cover the columns in between. The share of the
/// other's bins that one image finds is the share that it finds of all bins. An image of all
/// columns has half of their spacing and misses about half as much, or less. Bins that are occupied
/// by mistake, beyond the edge of a facet, are not found again and raise the estimate. Among fewer
/// than 20 bins, one that only one image finds raises it above 5 %. A beam has `columns_per_beam`
/// columns. NaN without a bin, and for views other than fans of two columns or more.
double missed_multipath(const View& view, int columns_per_beam, const Samples& samples,
                        std::span<const BouncePath> bounces);

}  // namespace sonarsim
