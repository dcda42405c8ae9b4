#pragma once

#include <array>
#include <functional>
#include <vector>

#include "recording/patch_grid.h"
#include "recording/recording.h"

namespace sonarsim {

/// The greatest lag of structure functions, in bins and beams.
inline constexpr int patch_lags = 8;

/// The moments of one patch of one ping. They come from differences of values of the patch, so the
/// mean of the patch need not be known, and correlated values do not make the variance too small.
struct PatchMoments {
    int ping = 0;
    int place = 0;            ///< patches of other pings at this place have the same number
    int row = 0;              ///< the first
    int beam = 0;             ///< the first
    double mean_value = 0.0;  ///< mean of the recorded values
    double zeros = 0.0;       ///< share of values that are 0
    double full = 0.0;        ///< share of values at the largest value
    double mean = 0.0;        ///< mean of the scaled values; the rest is of these, too
    double square = 0.0;      ///< mean of their squares
    double cube = 0.0;        ///< mean of their cubes
    double variance = 0.0;    ///< half the mean square difference of distant values
    double third = 0.0;       ///< third central moment, of three distant values in a line
    /// Half the mean square difference of values 1 to patch_lags apart; NaN where the patch is too
    /// small for it.
    std::array<double, patch_lags> along_range{}, along_beams{};
    double unevenness = 0.0;  ///< variance of the means of its quarters over `variance`
};

/// The patches of a ping. Distant values are half a patch apart along range and across the beams.
PatchGrid speckle_grid(const RecordedPing& ping);

/// The moments of all patches of some pings, of `scaled` values: a function of value and row.
std::vector<PatchMoments> patch_moments(const std::vector<RecordedPing>& pings, double full_value,
                                        const std::function<double(double, int)>& scaled);

/// The patches at these places; all of them if `places` is empty.
std::vector<PatchMoments> at_places(std::vector<PatchMoments> patches,
                                    const std::vector<bool>& places);

/// The numbers of the more even half of the patches without clipped and missing values. Patches
/// with a mean below `least_mean` are left out: their values are too coarse for the logarithm.
std::vector<std::size_t> speckle_patches(const std::vector<PatchMoments>& patches,
                                         double least_mean);

/// The chosen patches without those that are more than four times as uneven as the median. The
/// unevenness of a patch of one level is the variance of four means, a chi^2 of three degrees of
/// freedom: it exceeds four times its median in 2.4 % of the patches. A smaller factor would reject
/// more of these, and low variances with them.
std::vector<std::size_t> without_uneven(const std::vector<PatchMoments>& patches,
                                        const std::vector<std::size_t>& chosen);

}  // namespace sonarsim
