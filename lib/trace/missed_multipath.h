#pragma once

#include <span>

#include "trace/bounce_path.h"
#include "visibility/engine.h"
#include "visibility/view.h"

namespace sonarsim {

/// Estimates the share of the bins with multipath that `bounces` do not reach, plus twice its
/// standard error, by capture and recapture. The samples of even and of odd columns form one image
/// each. Their footprints are twice as wide, to cover the columns in between. The share of one
/// image's bins that the other image finds estimates the share of all bins that an image finds. The
/// image of all columns has half the spacing and misses at most about half as much. Bins that are
/// occupied by mistake, beyond the edge of a facet, are found by one image only and raise the
/// estimate. With fewer than 20 bins, a single bin that only one image finds raises the estimate
/// above 5 %. A beam has `columns_per_beam` columns. NaN without a bin, and for views other than
/// fans of two columns or more.
double missed_multipath(const View& view, int columns_per_beam, const Samples& samples,
                        std::span<const BouncePath> bounces);

}  // namespace sonarsim
