"""A figure of a recording before its cells are joined, and the rules that join them."""
import dataclasses

import numpy as np
from scipy import sparse

LEAST_POWER = 1e-16
MOST_WEIGHTS = 1 << 22      # held at a time


@dataclasses.dataclass
class Figure:
    """Cells: the values of a figure at a place of the image in a ping. Cells of one place share its number."""

    name: str
    reduce: str             # mean, level (10 log10 of the mean) or quantile
    tolerance: str          # tenth, decibel, correlation or share
    places: np.ndarray
    pings: np.ndarray
    values: np.ndarray
    weights: np.ndarray
    share: float = 0.5      # of quantile

    @classmethod
    def of(cls, name, reduce, tolerance, places, pings, values, weights=None, share=0.5):
        """A figure of the cells whose values are finite; all arguments of one shape, or broadcast to it."""
        values = np.asarray(values, float)
        places, pings, weights = (np.broadcast_to(array, values.shape)[np.isfinite(values)] for array in (
            places, pings, 1.0 if weights is None else weights))
        kept = weights > 0.0
        return cls(name, reduce, tolerance, places[kept].astype(int), pings[kept].astype(int),
                   values[np.isfinite(values)][kept], weights[kept].astype(float), share)

    def value(self):
        """The value of the figure; NaN without cells."""
        if not self.values.size:
            return np.nan
        return float(self.drawn(np.zeros(self.values.size, int), np.ones((1, 1)))[0])

    def drawn(self, units, draws):
        """The values in draws: draws[d, u] multiplies the weights of the cells of unit u."""
        return joined([(self, units, draws)])


def joined(parts):
    """The values of the cells of all parts together in draws; each part is (figure, units of its cells, draws)."""
    first = parts[0][0]
    if first.reduce != "quantile":
        sums = weights = 0.0
        for figure, units, draws in parts:
            count = draws.shape[1]
            sums = sums + draws @ np.bincount(units, figure.weights * figure.values, count)
            weights = weights + draws @ np.bincount(units, figure.weights, count)
        with np.errstate(invalid="ignore", divide="ignore"):
            mean = sums / weights
        return 10.0 * np.log10(np.maximum(mean, LEAST_POWER)) if first.reduce == "level" else mean
    values, at = np.unique(np.concatenate([figure.values for figure, *_ in parts]), return_inverse=True)
    cells, done = [], 0
    for figure, units, draws in parts:
        own = at[done:done + figure.values.size]
        done += figure.values.size
        cells.append(sparse.csr_matrix((figure.weights, (own, units)), (len(values), draws.shape[1])))
    count = len(parts[0][2])
    step = max(1, MOST_WEIGHTS // len(values))
    return np.concatenate([
        quantile_of(values, sum(own @ draws[k:k + step].T for own, (*_, draws) in zip(cells, parts)), first.share)
        for k in range(0, count, step)])


def quantile_of(values, weights, share):
    """The mid-distribution quantile (Parzen 2004) of sorted values for each column of weights, interpolated between
    values, so that it moves smoothly where a value occurs often."""
    ends = np.cumsum(weights, axis=0)
    middles = ends - 0.5 * weights
    wanted = share * ends[-1]
    above = (middles < wanted).sum(axis=0)
    high = np.minimum(above, len(values) - 1)
    low = np.maximum(high - 1, 0)
    columns = np.arange(weights.shape[1])
    step = middles[high, columns] - middles[low, columns]
    part = np.divide(wanted - middles[low, columns], step, out=np.ones_like(step), where=step > 0.0)
    out = values[low] + (values[high] - values[low]) * np.clip(part, 0.0, 1.0)
    return np.where(ends[-1] > 0.0, out, np.nan)
