#pragma once

#include <Eigen/Core>
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

/// The correlations of some patches, weighted by place: 1 - structure function / variance. The
/// variance is that of values half a patch apart, so longer correlations do not show.
Correlations correlations_of(const std::vector<PatchMoments>& patches,
                             const std::vector<std::size_t>& chosen,
                             const std::vector<double>& weights);

/// The correlations across the beams with their covariance.
struct BeamCorrelations {
    Eigen::Matrix<double, patch_lags, 1> mean;
    Eigen::Matrix<double, patch_lags, patch_lags> covariance;
    int units = 0;  ///< number of independent units
};

/// The covariance is that of a ratio of sums over independent units: a unit with the structure S
/// and the variance V changes r = 1 - sum S / sum V by ((1 - r) V - S) / sum V. Noise is new in
/// every ping, so each patch is a unit. Echoes may be constant, so for them each place is a unit.
BeamCorrelations beam_correlations(const std::vector<PatchMoments>& patches,
                                   const std::vector<std::size_t>& chosen, bool new_in_each_ping);

}  // namespace sonarsim
