#pragma once

#include <optional>
#include <vector>

#include "calibrate/bootstrap.h"
#include "calibrate/log_statistics.h"
#include "calibrate/patches.h"
#include "mission/instrument.h"
#include "recording/recording.h"

namespace sonarsim {

/// The companding law by the values of homogeneous speckle, whose amplitude A is Rayleigh
/// distributed at every level. With v = M A^g the logarithm of v has the same variance at every
/// level, (g / 2)^2 times that of ln P, and v a standard deviation proportional to its mean. With v
/// = M (1 + 20 log10(A) / range) v itself has the same variance at every level.
struct LawFit {
    Companding companding = Companding::gamma;
    Bounded gamma;             ///< for `gamma` and `linear`
    Bounded dynamic_range_db;  ///< for `log`
    /// The slope of log standard deviation against log mean of v: 1 for a power, 0 for a logarithm.
    Bounded slope;
    double spread_of_levels = 0.0;  ///< standard deviation of the log means of patches
    Bounded skewness;               ///< logarithm of the power; -1.14 for one look
    LogStatistics statistics;       ///< the law was fitted for them
    int patches = 0;
    double offset = 0.0;      ///< added to the values, as a share of full_value
    double mean_share = 0.0;  ///< harmonic mean of the patches' means with `offset`, as a share

    /// ln P of a value, with P the power over full scale. Values below half a step count as half a
    /// step.
    double log_power(double value, double full_value) const;

    /// True where the values of noise or speckle of a mean power become 0 so often that the
    /// variance of their logarithm is half a per cent too small.
    bool cuts_off(double mean_power, double full_value) const;
};

/// The law in an instrument's configuration.
LawFit stated_law(const ReceiverConfig& receiver, const LogStatistics& statistics);

/// The largest value that pings can have: the recording's, else the largest one that they have.
double full_value_of(const Recording& recording);

/// Fits the law of pings whose speckle has these `statistics`, after `offset` was added to all
/// values. The fit uses the even half of the patches at these places of the patch grid, or of all
/// patches. InputError with the reason if the values are not speckle: a photograph, too few
/// patches, or values that are alike over a whole patch. If the kind of law is `known`, it is not
/// fitted.
LawFit fit_law(const std::vector<RecordedPing>& pings, double full_value,
               const LogStatistics& statistics, const std::vector<bool>& places = {},
               double offset = 0.0, std::optional<Companding> known = {});

}  // namespace sonarsim
