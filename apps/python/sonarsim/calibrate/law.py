"""The law of companding by the values of homogeneous speckle, whose amplitude A is Rayleigh distributed at every
level. With v = M A^g the logarithm of v has the variance (g / 2)^2 of ln P at every level, and v a standard deviation
proportional to its mean. With v = M (1 + 20 log10(A) / range) v itself has one variance at every level."""
import dataclasses

import numpy as np

from .patches import Patches
from .statistics import DB_OF_E, Bounded, CalibrationError, LogStatistics, bootstrap

MIN_PATCHES, MIN_SPREAD_OF_LEVELS = 8, 0.1  # patches of about one level do not determine the slope
MAX_ZEROS = 0.02                # share of values at a place that a logarithm may cut off; their variance is known
MIN_ERROR = 0.015               # that finite patches, their trend and the steps of the values leave; by 200 draws
# If a share p of the powers becomes 0, the variance of the logarithm lacks p (0.8 - 2 ln p): half a per cent here.
MAX_CUT_OFF = 5e-4
MAX_SKEWNESS, MIN_GAMMA = 0.1, 0.08  # speckle of a smaller gamma would not be seen: it is the noise of a camera


class FewPatches(CalibrationError):
    """Too few even patches to fit a law."""


@dataclasses.dataclass
class Law:
    full_value: float
    is_log: bool
    scale: Bounded                  # gamma, or the dynamic range in dB of a logarithm
    offset: float                   # added to the values, as a share of full_value
    statistics: LogStatistics

    def log_power(self, values):
        """ln P of values, P the power over full scale."""
        if self.is_log:
            return (np.asarray(values, float) / self.full_value + self.offset - 1.0) * self.scale.value / DB_OF_E
        return 2.0 / self.scale.value * np.log(floored(values, self.full_value, self.offset) / self.full_value)

    def cuts_off(self, mean_power):
        """True where values of this mean power become 0 so often that the variance of their logarithm suffers."""
        return np.exp(self.log_power(floored(0.0, self.full_value))) > MAX_CUT_OFF * mean_power


def floored(values, full_value, offset=0.0):
    """Values with the offset; those below half a step count as half a step."""
    return np.maximum(np.asarray(values, float) + offset * full_value, 0.5 if full_value > 15.0 else full_value / 131070.0)


def full_value_of(recording):
    """The largest value that pings can have: the recording's, else the largest one that they have."""
    return float(recording.law.full_value or recording.values.max())


def stated_law(receiver, full_value, statistics):
    """The law of an instrument's keys."""
    is_log = receiver["companding"] == "log"
    scale = receiver["dynamic_range_db"] if is_log else 1.0 if receiver["companding"] == "linear" else receiver["gamma"]
    return Law(full_value, is_log, Bounded(scale, scale, scale), receiver["offset"], statistics)


def fit_law(values, full_value, statistics, places=None, offset=0.0, is_log=None):
    """The law of pings whose speckle has these statistics, by the even half of the patches at some places.
    CalibrationError if the values are not speckle. A known kind of law is not fitted."""
    plain = Patches(values, full_value, lambda ping: ping)
    logs = Patches(values, full_value, lambda ping: np.log(floored(ping, full_value, offset)))
    # In logarithms no law makes strong patches uneven. Only a logarithm cuts off as much as `loose` allows.
    strict, loose = logs.even(places), logs.even(places, MAX_ZEROS)
    require_patches(even := loose if is_log or len(strict) < MIN_PATCHES else strict)
    if is_log is None:
        skewness = [moments_of(of, even)[1] for of in (logs, plain)]
        check_speckle(logs, even, skewness, statistics.skewness)
        # The slope of log standard deviation against log mean is 1 for a power, 0 for a logarithm.
        steep = even[plain.variance[even] > 0.0]
        level, deviation = np.log(plain.mean_value[steep]), 0.5 * np.log(plain.variance[steep])
        slope = np.polyfit(level, deviation, 1)[0] if level.std() > MIN_SPREAD_OF_LEVELS else None
        off = [abs(s.value - statistics.skewness) for s in skewness]
        is_log = bool(off[1] <= off[0] if slope is None else slope <= 0.5)
    require_patches(loose if is_log else strict)
    # Echoes have a texture, too, which adds more to the variance than even patches lack.
    sigma, noise_part = np.sqrt(statistics.variance), None if places is None else statistics
    scale = moments_of(logs, even, noise_part)[0].scaled(2.0 / sigma)
    if is_log:
        deviation = moments_of(plain, loose, noise_part, statistics.cut_variance(plain.zeros))[0]
        scale = Bounded(*(full_value * DB_OF_E * sigma / x for x in (deviation.value, deviation.high, deviation.low)))
    return Law(full_value, is_log, scale.widened(MIN_ERROR * scale.value), offset, statistics)


def require_patches(chosen):
    if len(chosen) < MIN_PATCHES:
        raise FewPatches("fewer than 8 even patches of speckle, of 24 bins and 24 beams (96 bins of a sonar with "
                               "few beams), between the ends of the scale: record longer pings, or with another gain")


def moments_of(patches, chosen, statistics=None, left=1.0):
    """The standard deviation and the skewness of patches. `left`: shares of their variances; `statistics`: of noise."""
    ones = np.ones(len(patches.place))
    variance = patches.whole_variance(chosen, statistics) if statistics else patches.variance
    sums = patches.sums(chosen, ones, left * ones, variance, patches.third)

    def moments(weights):
        count, left, variance, third = (weights @ sums).T
        return np.stack([np.sqrt(variance / left), third / count / (variance / count) ** 1.5], axis=1)
    return bootstrap(patches.places, moments)


def check_speckle(logs, even, skewness, at_start):
    """CalibrationError if values a third of a patch apart are correlated, or if neither skewness can, within its
    errors, lie between -2 and 0.1: one sample has -1.14, the mean of eight about -0.4, the largest of many 0."""
    lasting = logs.correlations(even)(np.ones((1, logs.places)))[0, 0, -1]
    if lasting > 0.6:
        raise CalibrationError(f"values 8 bins apart have the correlation {lasting:.2f}, speckle of a sonar much less: "
                               "is this a photograph, a picture that was smoothed, or a pulse of many bins?")
    if not any(s.high > -2.0 and s.low < max(MAX_SKEWNESS, at_start + 0.3) for s in skewness):
        raise CalibrationError(f"the logarithms of values have a skewness of {skewness[0].value:.2f}, that of speckle "
                               "is -1.14: is this a photograph, or were the values changed after the sonar?")
    gamma = 2.0 * np.sqrt(logs.variance[even].mean() / LogStatistics().variance)
    if gamma < MIN_GAMMA:
        raise CalibrationError(f"the values of even patches vary by {50.0 * gamma:.1g} %, those of speckle by half of their "
                               "mean: is this a photograph?")
