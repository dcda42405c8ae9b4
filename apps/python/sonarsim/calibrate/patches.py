"""The moments of patches of pings, from differences of their values."""
import numpy as np

from .statistics import LAGS, sums_by

# The share of a patch's values that may lie at each end of the scale. Such values bias the moments.
MOST_AT_AN_END = 0.003


def patch_shape(ranges, beams):
    """Bins and beams of a patch; a sonar with few beams has longer ones."""
    return min(96 if beams < 8 else 24, ranges), min(24, beams)


class Patches:
    """The moments of all patches of some pings, one array of each, in the order of pings and places.

    `values`: [ping, range, beam]; `scaled` takes the values of a ping and gives those whose moments are wanted.
    Moments of differences need no mean of the patch, and correlated values do not make the variance too small."""

    def __init__(self, values, full_value, scaled):
        pings, ranges, beams = values.shape
        self.shape = rows, columns = patch_shape(ranges, beams)
        self.grid = ranges // rows, beams // columns
        self.places = self.grid[0] * self.grid[1]
        self.place = np.tile(np.arange(self.places), pings)
        self.row = self.place // max(self.grid[1], 1) * rows
        self.beam = self.place % max(self.grid[1], 1) * columns
        parts = [self.moments(ping, scaled(ping), full_value) for ping in values]
        for name in parts[0]:
            setattr(self, name, np.concatenate([part[name] for part in parts]))

    def cut(self, image):
        """The patches [place, row, beam] of an image."""
        (down, across), (rows, columns) = self.grid, self.shape
        whole = image[:down * rows, :across * columns].reshape(down, rows, across, columns)
        return whole.transpose(0, 2, 1, 3).reshape(-1, rows, columns)

    def moments(self, ping, scaled, full_value):
        rows, columns = self.shape
        values, x = self.cut(np.asarray(ping, float)), self.cut(scaled)
        middle, half = (rows + 1) // 2, max(columns // 2, 1)
        quarters = [x[:, a, b].mean(axis=(1, 2)) for a in (slice(middle), slice(middle, None))
                    for b in (slice(half), slice(half, None)) if x[:, a, b].size]
        variance = structure(x, rows // 2, columns // 2)
        return {
            "mean_value": values.mean(axis=(1, 2)), "zeros": (values <= 0.0).mean(axis=(1, 2)),
            "full": (values >= full_value).mean(axis=(1, 2)), "mean": x.mean(axis=(1, 2)),
            "variance": variance, "third": third_moment(x),
            "along_range": np.stack([structure(x, lag, 0) for lag in range(1, LAGS + 1)], axis=1),
            "along_beams": np.stack([structure(x, 0, lag) for lag in range(1, LAGS + 1)], axis=1),
            "unevenness": np.var(quarters, axis=0) / np.maximum(variance, 1e-30),
        }

    def even(self, least_mean=0.0, places=None):
        """The numbers of the more even half of the patches without clipped and missing values, at some places.
        Patches with a smaller mean value are left out: their values are too coarse for the logarithm."""
        good = (self.zeros <= MOST_AT_AN_END) & (self.full <= MOST_AT_AN_END) & (self.variance > 0.0)
        good &= self.mean_value >= least_mean
        if places is not None:
            good &= places[self.place]
        chosen = np.flatnonzero(good)
        order = np.argsort(self.unevenness[chosen], kind="stable")
        return np.sort(chosen[order[:(len(chosen) + 1) // 2]])

    def without_uneven(self, chosen):
        """Those of the chosen patches that are at most four times as uneven as the median. The variance of four
        means of one level exceeds four times its median in 2.4 % of the patches."""
        return chosen[self.unevenness[chosen] <= 4.0 * np.median(self.unevenness[chosen])] if len(chosen) else chosen

    def sums(self, chosen, *columns):
        """The sums of columns over the chosen patches of each place."""
        return sums_by(self.place[chosen], self.places, *(column[chosen] for column in columns))

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
        if new_in_each_ping:
            sums = np.column_stack([self.variance[chosen], self.along_beams[chosen]])
        else:
            sums = self.sums(chosen, self.variance, *self.along_beams.T)[np.unique(self.place[chosen])]
        variance, structures = sums[:, 0], sums[:, 1:]
        left = structures.sum(axis=0) / variance.sum()
        moved = (left * variance[:, None] - structures) / variance.sum()
        return 1.0 - left, moved.T @ moved, len(sums)


def structure(x, rows, columns):
    """Half the mean square difference of values that lie `rows` and `columns` apart, in both diagonals; NaN where
    the patches are too small."""
    down, across = x.shape[1] - rows, x.shape[2] - columns
    if down <= 0 or across <= 0:
        return np.full(len(x), np.nan)
    off = x[:, rows:, columns:] - x[:, :down, :across]
    other = x[:, rows:, :across] - x[:, :down, columns:]
    return 0.25 * ((off**2).mean(axis=(1, 2)) + (other**2).mean(axis=(1, 2)))


def third_moment(x):
    """The third central moment k of independent values: (a + c - 2 b)^3 has the mean -6 k, whatever their mean and
    its slope."""
    rows = min(8, (x.shape[1] - 1) // 2)
    columns = x.shape[2] // 3
    down, across = x.shape[1] - 2 * rows, x.shape[2] - 2 * columns
    y = x[:, :down, :across] + x[:, 2 * rows:, 2 * columns:] - 2.0 * x[:, rows:rows + down, columns:columns + across]
    return -(y**3).mean(axis=(1, 2)) / 6.0
