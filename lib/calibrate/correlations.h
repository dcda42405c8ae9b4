#pragma once

#include <array>
#include <vector>

#include "calibrate/bootstrap.h"
#include "calibrate/patches.h"

namespace sonarsim {

/// The correlations of log powers 1 to patch_lags bins and beams apart.
struct Correlations {
    std::array<double, patch_lags> along_range{}, along_beams{};
    int patches = 0;
};

/// Those of some patches, weighted by place: one less structure function by variance. The variance
/// is that of values half a patch apart, so a correlation that lasts longer is not seen.
Correlations correlations_of(const std::vector<PatchMoments>& patches,
                             const std::vector<std::size_t>& chosen,
                             const std::vector<double>& weights);

}  // namespace sonarsim
