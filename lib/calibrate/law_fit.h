#pragma once

#include <vector>

#include "calibrate/bootstrap.h"
#include "calibrate/patches.h"
#include "mission/instrument.h"
#include "recording/recording.h"

namespace sonarsim {

/// The companding law as the values of homogeneous speckle tell it. There the amplitude A has
/// Rayleigh's distribution at every level. With v = M A^g the logarithm of v has the same variance
/// at every level, (g / 2)^2 log_power_variance(looks), and v a standard deviation proportional to
/// its mean. With v = M (1 + 20 log10(A) / range) v itself has the same variance at every level.
struct LawFit {
    Companding companding = Companding::gamma;
    Measured gamma;             ///< of `gamma` and `linear`
    Measured dynamic_range_db;  ///< of `log`
    /// The slope of log standard deviation against log mean of v: 1 for a power, 0 for a logarithm.
    Measured slope;
    double spread_of_levels = 0.0;  ///< standard deviation of the log means of patches
    Measured skewness;              ///< of the logarithm of the power; -1.14 for one look
    int looks = 1;                  ///< the number that the law was fitted for
    int patches = 0;

    /// ln P, P the power by full scale, of a value. Values below half a step count as half a step.
    double log_power(double value, double full_value) const;
};

/// The largest value that pings can have: the recording's, else the largest one that they have.
double full_value_of(const Recording& recording);

/// The law of pings with so many `looks`, of the even half of all patches or of the even half of
/// those at these places in a patch grid. InputError, which says why, when their values are none of
/// speckle: a photograph, too few patches, values that stay alike over a whole patch.
LawFit fit_law(const std::vector<RecordedPing>& pings, double full_value, int looks,
               const std::vector<bool>& places = {});

}  // namespace sonarsim
