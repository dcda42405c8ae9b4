"""A figure of a recording before its cells are joined, and the rules that join them."""
import dataclasses

import numpy as np
from scipy import sparse

MIN_POWER = 1e-16          # -160 dB
MAX_WEIGHTS = 1 << 22      # held at a time


def decibels(powers):
    return 10.0 * np.log10(np.maximum(powers, MIN_POWER))


@dataclasses.dataclass
class Figure:
    """Cells: the values of a figure at a place of the image in a ping. Cells of one place share its number."""
    name: str
    reduce: str             # mean, level (10 log10 of the mean), quantile or spread (half of what 68 % of the cells lie in)
    tolerance: str          # tenth, decibel, texture, correlation, skewness, share or hundredth
    places: np.ndarray
    pings: np.ndarray
    values: np.ndarray
    weights: np.ndarray
    share: float = 0.5      # of quantile
    less: float | None = None               # the quantile of this share is subtracted
    is_reference: np.ndarray | None = None  # cells of level whose level is subtracted
    group: str = ""         # in the table

    @classmethod
    def of(cls, name, reduce, tolerance, places, pings, values, weights=1.0, share=0.5, less=None):
        """A figure of the cells with finite values and weight; arrays are broadcast to the shape of the values."""
        values = np.asarray(values, float)
        places, pings, weights = (np.broadcast_to(array, values.shape) for array in (places, pings, weights))
        kept = np.isfinite(values) & (weights > 0.0)
        return cls(name, reduce, tolerance, places[kept].astype(int), pings[kept].astype(int), values[kept],
                   weights[kept].astype(float), share, less)

    def over(self, other):
        """This level over another one: no gain changes it."""
        both = (np.concatenate([getattr(one, name) for one in (self, other)])
                for name in ("places", "pings", "values", "weights"))
        places, pings, values, weights = both
        return dataclasses.replace(self, places=places, pings=pings, values=values, weights=weights, is_reference=np.repeat(
            [False, True], [self.values.size, other.values.size]))


def without_gain(figure):
    """A figure less the gain of its own reference, so that cells of two recordings can be exchanged."""
    if figure.is_reference is not None:
        level = value_of(dataclasses.replace(figure, is_reference=None, weights=figure.weights * figure.is_reference))
        return dataclasses.replace(figure, values=figure.values / 10.0 ** (0.1 * level))
    if figure.less is not None:
        return dataclasses.replace(figure, values=figure.values - value_of(
            dataclasses.replace(figure, share=figure.less, less=None)))
    return figure


def value_of(figure):
    """The value of a figure; NaN without cells."""
    return float(joined((figure, 0 * figure.places, np.ones((1, 1))))[0]) if figure.values.size else np.nan


def joined(*parts):
    """The values of all parts together in draws. A part: a figure, its cells' units, and weights draws[d, u] of unit u."""
    first, _, draws = parts[0]
    if first.reduce in ("mean", "level"):
        def mean_of(kept):
            sums = (sum(own @ np.bincount(units, kept(figure) * figure.weights * factor(figure), own.shape[1])
                        for figure, units, own in parts) for factor in (lambda f: f.values, lambda f: 1.0))
            with np.errstate(invalid="ignore", divide="ignore"):
                return np.divide(*sums)
        if first.reduce == "mean":
            return mean_of(lambda f: 1.0)
        if first.is_reference is None:
            return decibels(mean_of(lambda f: 1.0))
        return decibels(mean_of(lambda f: ~f.is_reference)) - decibels(mean_of(lambda f: f.is_reference))
    values, at = np.unique(np.concatenate([figure.values for figure, *_ in parts]), return_inverse=True)
    ends = np.cumsum([figure.values.size for figure, *_ in parts])
    cells = [sparse.csr_matrix((figure.weights, (own, units)), (len(values), drawn.shape[1]))
             for (figure, units, drawn), own in zip(parts, np.split(at, ends))]
    step = max(1, MAX_WEIGHTS // len(values))
    high, low = (0.84, 0.16) if first.reduce == "spread" else (first.share, first.less)

    def reduced(weights):
        found = quantile_of(values, weights, high)
        found = found if low is None else found - quantile_of(values, weights, low)
        return 0.5 * found if first.reduce == "spread" else found
    return np.concatenate([reduced(sum(own @ drawn[k:k + step].T for own, (*_, drawn) in zip(cells, parts)))
                           for k in range(0, len(draws), step)])


def quantile_of(values, weights, share):
    """The mid-distribution quantile (Parzen 2004) of sorted values for each column of weights, smooth where values repeat."""
    ends = np.cumsum(weights, axis=0)
    middles, wanted, columns = ends - 0.5 * weights, share * ends[-1], np.arange(weights.shape[1])
    high = np.minimum((middles < wanted).sum(axis=0), len(values) - 1)
    low = np.maximum(high - 1, 0)
    step = middles[high, columns] - middles[low, columns]
    part = np.divide(wanted - middles[low, columns], step, out=np.ones_like(step), where=step > 0.0)
    out = values[low] + (values[high] - values[low]) * np.clip(part, 0.0, 1.0)
    return np.where(ends[-1] > 0.0, out, np.nan)
