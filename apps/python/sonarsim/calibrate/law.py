"""The law of companding by the values of homogeneous speckle, whose amplitude A is Rayleigh distributed at every
level. With v = M A^g the logarithm of v has the variance (g / 2)^2 of ln P at every level, and v a standard deviation
proportional to its mean. With v = M (1 + 20 log10(A) / range) v itself has one variance at every level."""
import dataclasses

import numpy as np

from .patches import Patches
from .statistics import DB_OF_E, Bounded, CalibrationError, LogStatistics, bootstrap

LEAST_PATCHES = 8
LEAST_PATCHES_OF_OFFSET = 24
MOST_OFFSET = 0.3
LEAST_SPREAD_OF_LEVELS = 0.1    # patches of about one level do not determine the slope
LEAST_ERROR = 0.01              # that finite patches, their trend and the steps of the values leave
# If a share p of the powers becomes 0, the variance of the logarithm lacks p (0.8 - 2 ln p): half a per cent here.
MOST_CUT_OFF = 5e-4


@dataclasses.dataclass
class Law:
    """`scale` is gamma of a power law, the dynamic range in dB of a logarithm."""

    full_value: float
    is_log: bool
    scale: Bounded
    offset: float = 0.0             # added to the values, as a share of full_value
    statistics: LogStatistics = dataclasses.field(default_factory=LogStatistics)
    mean_share: float = 1.0         # harmonic mean of the patches' means with the offset

    def log_power(self, values):
        """ln P of values, P the power over full scale. Values below half a step count as half a step."""
        values = np.asarray(values, float)
        if self.is_log:
            return (values / self.full_value + self.offset - 1.0) * self.scale.value / DB_OF_E
        return 2.0 / self.scale.value * np.log(floored(values, self.full_value, self.offset) / self.full_value)

    def cuts_off(self, mean_power):
        """True where values of this mean power become 0 so often that the variance of their logarithm suffers."""
        return np.exp(self.log_power(0.5 * step_of(self.full_value))) > MOST_CUT_OFF * mean_power


def step_of(full_value):
    return 1.0 if full_value > 15.0 else full_value / 65535.0


def floored(values, full_value, offset):
    return np.maximum(values + offset * full_value, 0.5 * step_of(full_value))


def full_value_of(recording):
    """The largest value that pings can have: the recording's, else the largest one that they have."""
    return float(recording.law.full_value or recording.values.max())


def stated_law(receiver, full_value, statistics):
    """The law of an instrument's keys."""
    is_log = receiver["companding"] == "log"
    gamma = 1.0 if receiver["companding"] == "linear" else receiver["gamma"]
    scale = Bounded.exactly(receiver["dynamic_range_db"] if is_log else gamma)
    return Law(full_value, is_log, scale, receiver["offset"], statistics)


def fit_law(values, full_value, statistics, places=None, offset=0.0, is_log=None):
    """Fits the law of pings whose speckle has these statistics, after `offset` was added to all values, in the even
    half of the patches. CalibrationError if the values are not speckle. A known kind of law is not fitted."""
    plain = Patches(values, full_value, lambda ping: np.asarray(ping, float))
    logs = Patches(values, full_value, lambda ping: np.log(floored(ping, full_value, offset)))
    # In logarithms no law makes strong patches uneven.
    even = logs.even(6.0 if full_value > 15.0 else 0.0, places)
    if len(even) < LEAST_PATCHES:
        raise CalibrationError("fewer than 8 even patches of speckle, of 24 bins and 24 beams (96 bins of a sonar with "
                               "few beams), between the ends of the scale: record longer pings, or with another gain")
    skew = [bootstrap(of.places, skewness_of(of, even))[0] for of in (logs, plain)]
    check_speckle(logs, even, skew, statistics.skewness)
    if is_log is None:
        level = np.log(plain.mean_value[even])
        if level.std() > LEAST_SPREAD_OF_LEVELS:
            is_log = slope_of(level, 0.5 * np.log(plain.variance[even])) <= 0.5
        else:
            off = [abs(s.value - statistics.skewness) for s in skew]
            is_log = off[1] <= off[0]
    used = plain if is_log else logs
    sums = used.sums(even, np.ones(len(used.place)), used.variance)

    def scale(weights):
        weighted = weights @ sums
        ratio = np.sqrt(weighted[:, 1] / weighted[:, 0] / statistics.variance)
        return full_value * DB_OF_E / ratio if is_log else 2.0 * ratio
    found = bootstrap(used.places, scale)[0]
    share = 1.0 / np.mean(1.0 / (plain.mean_value[even] / full_value + offset))
    return Law(full_value, bool(is_log), found.widened(LEAST_ERROR * found.value), offset, statistics, share)


def slope_of(x, y):
    return np.cov(x, y)[0, 1] / np.var(x, ddof=1)


def skewness_of(patches, even):
    sums = patches.sums(even, np.ones(len(patches.place)), patches.variance, patches.third)

    def estimate(weights):
        count, variance, third = (weights @ sums).T
        return third / count / (variance / count) ** 1.5
    return estimate


def check_speckle(logs, even, skew, of_start):
    """CalibrationError if values a third of a patch apart are correlated, or if neither skewness can, within its
    errors, lie between -2 and -0.3: one look has -1.14, eight looks have about -0.4."""
    lasting = logs.correlations(even)(np.ones((1, logs.places)))[0, 0, -1]
    if lasting > 0.6:
        raise CalibrationError(f"values 8 bins apart have the correlation {lasting:.2f}, speckle of a sonar much less: "
                               "is this a photograph, a picture that was smoothed, or a pulse of many bins?")
    most = max(-0.3, of_start + 0.3)
    if not any(s.high > -2.0 and s.low < most for s in skew):
        raise CalibrationError(f"the logarithms of neighbouring values have a skewness of {skew[0].value:.2f}, speckle "
                               "of a sonar has -1.14: is this a photograph, or were the values changed after the sonar?")


def fit_offset(values, full_value, places=None, by_range=True):
    """The offset that a receiver with a power law subtracts, as a share of full_value: v = M A^g - o. The deviation
    of A^g is proportional to its mean, so a line of the patches' deviations against their means reaches 0 at -o.
    Patches of one range share its trend, so ranges are the units. None for too few patches, or for one level."""
    patches = Patches(values, full_value, lambda ping: np.asarray(ping, float))
    has_steps = full_value > 15.0
    even = patches.even(6.0 if has_steps else 0.0, places)
    if len(even) < LEAST_PATCHES_OF_OFFSET:
        return None
    mean = patches.mean_value[even]
    if mean.std() < LEAST_SPREAD_OF_LEVELS * mean.mean():
        return None
    # Within one range, a gain by range adds nothing; rounding adds 1/12.
    along = patches.along_beams[even, -1]
    variance = np.where(np.isfinite(along), along, patches.variance[even]) - (1.0 / 12.0 if has_steps else 0.0)
    deviation = np.sqrt(np.maximum(variance, 0.0))
    unit = patches.row[even] // patches.shape[0] if by_range else patches.place[even]
    count = patches.grid[0] if by_range else patches.places
    terms = np.stack([1.0 / mean**2, 1.0 / mean, deviation / mean**2, np.ones_like(mean), deviation / mean])
    sums = np.stack([np.bincount(unit, term, count) for term in terms], axis=1)

    def offset(weights):
        w, x, y, xx, xy = (weights @ sums).T
        slope = (w * xy - x * y) / (w * xx - x * x)
        return (y - slope * x) / w / slope / full_value
    return bootstrap(count, offset)[0]


def chosen_offset(values, full_value, of_start, places=None):
    """The offset of the start, unless the pings show one that differs by 3.3 standard errors, places as units."""
    seen = fit_offset(values, full_value, places)
    if seen is None:
        return None
    error = fit_offset(values, full_value, places, by_range=False).half_width / 1.96
    is_one = 0.0 < seen.value < MOST_OFFSET and abs(seen.value - of_start) > 3.3 * error
    value = seen.value if is_one else of_start
    return Bounded(value, min(max(seen.low, 0.0), value), max(seen.high, value))


def bits_of(values, full_value):
    """The number of bits, log2(full_value / step + 1) with the greatest common divisor of all values as the step.
    None if a value or the number is not whole."""
    if not np.all((values >= 0.0) & (values < 1e9) & (values == np.floor(values))):
        return None
    step = int(np.gcd.reduce(np.unique(values).astype(np.int64)))
    bits = np.log2(full_value / step + 1.0) if step else 0.0
    return round(bits) if bits >= 1.0 and abs(bits - round(bits)) < 1e-6 else None
