"""The moments of patches of pings, from differences of their values."""
import numpy as np

from ..compare.images import Grid
from .statistics import LAGS

MAX_AT_AN_END = 0.003       # share of a patch's values at an end of the scale, which bias its moments
MIN_MEAN_VALUE = 6.0        # smaller values are too coarse for the logarithm


class Patches:
    """The moments of all patches of pings [ping, range, beam], of values that `scaled` makes of a ping. They come from
    differences, so the mean of a patch need not be known, and correlated values do not make the variance too small."""

    def __init__(self, values, full_value, scaled):
        pings, ranges, beams = values.shape
        self.full_value = full_value
        self.shape = rows, columns = min(96 if beams < 8 else 24, ranges), min(24, beams)
        self.grid = Grid((ranges, beams), self.shape)
        self.places = self.grid.places
        self.place = np.tile(np.arange(self.places), pings)
        self.row, self.beam = self.place // self.grid.columns * rows, self.place % self.grid.columns * columns
        parts = [self.moments(ping, scaled(ping)) for ping in values]
        for name in parts[0]:
            setattr(self, name, np.concatenate([part[name] for part in parts]))
        # A gain that grows with range changes the values half a patch apart: the same in all patches of these ranges.
        slope = np.bincount(self.row, self.slope) / np.maximum(np.bincount(self.row), 1)
        self.variance = np.maximum(self.variance - 0.5 * slope[self.row] ** 2, 0.0)
        self.between -= slope[self.row] ** 2 / (3.0 if columns > 1 else 2.0)
        # Of all pings at a place: a patch chosen by its own zeros would lack low values, by its own variance have more.
        self.zeros, usual = (np.bincount(self.place, x)[self.place] / pings for x in (self.at_zero, self.variance))
        self.unevenness = self.between / np.maximum(usual, 1e-30)

    def moments(self, ping, scaled):
        (rows, columns), (values, x) = self.shape, (self.grid.cut(np.asarray(one, float)) for one in (ping, scaled))
        middle, half = (rows + 1) // 2, max(columns // 2, 1)
        quarters = [x[:, a, b].mean(axis=(1, 2)) for a in (slice(middle), slice(middle, None))
                    for b in (slice(half), slice(half, None)) if x[:, a, b].size]
        return {"mean_value": values.mean(axis=(1, 2)), "mean": x.mean(axis=(1, 2)),
                "at_zero": (values <= 0.0).mean(axis=(1, 2)), "at_full": (values >= self.full_value).mean(axis=(1, 2)),
                "variance": structure(x, rows // 2, columns // 2), "third": third_moment(x),
                "slope": (x[:, rows // 2:] - x[:, :rows - rows // 2]).mean(axis=(1, 2)),
                "along_range": np.stack([structure(x, lag, 0) for lag in range(1, LAGS + 1)], axis=1),
                "along_beams": np.stack([structure(x, 0, lag) for lag in range(1, LAGS + 1)], axis=1),
                "between": np.var(quarters, axis=0) * len(quarters) / max(len(quarters) - 1, 1)}

    def even(self, places=None, max_zeros=MAX_AT_AN_END):
        """The numbers of the more even half of the patches without clipped and missing values, at some places."""
        good = (self.zeros <= max_zeros) & (self.at_full <= MAX_AT_AN_END) & (self.variance > 0.0)
        if self.full_value > 15.0:
            good &= self.mean_value >= MIN_MEAN_VALUE
        if places is not None:
            good &= places[self.place]
        chosen = np.flatnonzero(good)
        order = np.argsort(self.unevenness[chosen], kind="stable")
        return np.sort(chosen[order[:(len(chosen) + 1) // 2]])

    def whole_variance(self, chosen, statistics):
        """The variances with the part between the quarters' means that speckle of these LogStatistics has: the quarters of
        even patches are more alike. A mean has the mean correlation of its values as its share of their variance."""
        lags, known = np.arange(LAGS + 1), np.linspace(0.0, 1.0, 401)
        halves = np.maximum(np.array(self.shape)[:, None] // 2, 1)
        along_ranges, along_beams = np.where(lags, 2.0, 1.0) * np.maximum(1.0 - lags / halves, 0.0) / halves
        found = np.nan_to_num(self.correlations(chosen)(np.ones((1, self.places)))[0])
        within, whole = (self.variance - self.between)[chosen].sum() / self.variance[chosen].sum(), 1.0
        for _ in range(4):      # correlations are 1 - structure / whole variance
            in_logs = 1.0 - np.pad(1.0 - found, [(0, 0), (1, 0)]) / whole
            range_values, beam_values = np.interp(in_logs, statistics.correlation(known), known)
            share = along_ranges @ statistics.correlation(np.outer(range_values, beam_values)) @ along_beams
            whole = within / (1.0 - min(share, 0.5))
        return whole * self.variance

    def sums(self, chosen, *columns):
        """The sums of columns over the chosen patches of each place, [place, column]."""
        return np.stack([np.bincount(self.place[chosen], column[chosen], self.places) for column in columns], axis=1)

    def correlations(self, chosen):
        """A function of weights [draw, place] that gives correlations [draw, 2, lag] along range and beams:
        1 - structure function / variance. The variance is that of values half a patch apart."""
        sums = self.sums(chosen, self.variance, *self.along_range.T, *self.along_beams.T)

        def estimate(weights):
            weighted = weights @ sums
            return (1.0 - weighted[:, 1:] / weighted[:, :1]).reshape(len(weights), 2, LAGS)
        return estimate

    def beam_covariance(self, chosen, new_in_each_ping):
        """The correlations along the beams, their covariance and the number of independent units. A unit with the
        structure S and the variance V changes r = 1 - sum S / sum V by ((1 - r) V - S) / sum V. Noise is new in
        every ping, so each patch is a unit; echoes may be constant, so each place is."""
        sums = np.column_stack([self.variance, self.along_beams])[chosen] if new_in_each_ping else \
            self.sums(chosen, self.variance, *self.along_beams.T)[np.unique(self.place[chosen])]
        variance, structures = sums[:, 0], sums[:, 1:]
        left = structures.sum(axis=0) / variance.sum()
        moved = (left * variance[:, None] - structures) / variance.sum()
        return 1.0 - left, moved.T @ moved, len(sums)


def structure(x, rows, columns):
    """Half the mean square difference of values `rows` and `columns` apart; NaN where patches are too small."""
    down, across = x.shape[1] - rows, x.shape[2] - columns
    if down <= 0 or across <= 0:
        return np.full(len(x), np.nan)
    off = x[:, rows:, columns:] - x[:, :down, :across]
    other = x[:, rows:, :across] - x[:, :down, columns:]
    return 0.25 * ((off**2).mean(axis=(1, 2)) + (other**2).mean(axis=(1, 2)))


def third_moment(x):
    """The third central moment k of independent values: that of a + c - 2 b is -6 k, whatever their mean and its slope."""
    rows, columns = min(8, (x.shape[1] - 1) // 2), x.shape[2] // 3
    down, across = x.shape[1] - 2 * rows, x.shape[2] - 2 * columns
    y = x[:, :down, :across] + x[:, 2 * rows:, 2 * columns:] - 2.0 * x[:, rows:rows + down, columns:columns + across]
    return -((y - y.mean(axis=(1, 2), keepdims=True)) ** 3).mean(axis=(1, 2)) / 6.0
