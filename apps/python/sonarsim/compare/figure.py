"""A figure of a recording before its cells are joined, and the rules that join them."""
import dataclasses

import numpy as np
from scipy import sparse

LEAST_POWER = 1e-16         # -160 dB
MOST_WEIGHTS = 1 << 22      # held at a time


def decibels(powers):
    return 10.0 * np.log10(np.maximum(powers, LEAST_POWER))


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
    def of(cls, name, reduce, tolerance, places, pings, values, weights=1.0, share=0.5):
        """A figure of the cells with finite values and weight; arrays are broadcast to the shape of the values."""
        values = np.asarray(values, float)
        places, pings, weights = (np.broadcast_to(array, values.shape) for array in (places, pings, weights))
        kept = np.isfinite(values) & (weights > 0.0)
        return cls(name, reduce, tolerance, places[kept].astype(int), pings[kept].astype(int), values[kept],
                   weights[kept].astype(float), share)


def value_of(figure):
    """The value of a figure; NaN without cells."""
    return float(joined((figure, 0 * figure.places, np.ones((1, 1))))[0]) if figure.values.size else np.nan


def joined(*parts):
    """The values of the cells of all parts together in draws. A part is a figure, the units of its cells, and draws[d, u],
    which multiply the weights of the cells of unit u."""
    first, _, draws = parts[0]
    if first.reduce != "quantile":
        with np.errstate(invalid="ignore", divide="ignore"):
            mean = np.divide(*(sum(own @ np.bincount(units, figure.weights * factor(figure), own.shape[1])
                                   for figure, units, own in parts) for factor in (lambda f: f.values, lambda f: 1.0)))
        return decibels(mean) if first.reduce == "level" else mean
    values, at = np.unique(np.concatenate([figure.values for figure, *_ in parts]), return_inverse=True)
    ends = np.cumsum([figure.values.size for figure, *_ in parts])
    cells = [sparse.csr_matrix((figure.weights, (own, units)), (len(values), drawn.shape[1]))
             for (figure, units, drawn), own in zip(parts, np.split(at, ends))]
    step = max(1, MOST_WEIGHTS // len(values))
    return np.concatenate([
        quantile_of(values, sum(own @ drawn[k:k + step].T for own, (*_, drawn) in zip(cells, parts)), first.share)
        for k in range(0, len(draws), step)])


def quantile_of(values, weights, share):
    """The mid-distribution quantile (Parzen 2004) of sorted values for each column of weights, interpolated between
    values, so that it moves smoothly where a value occurs often."""
    ends = np.cumsum(weights, axis=0)
    middles, wanted, columns = ends - 0.5 * weights, share * ends[-1], np.arange(weights.shape[1])
    high = np.minimum((middles < wanted).sum(axis=0), len(values) - 1)
    low = np.maximum(high - 1, 0)
    step = middles[high, columns] - middles[low, columns]
    part = np.divide(wanted - middles[low, columns], step, out=np.ones_like(step), where=step > 0.0)
    out = values[low] + (values[high] - values[low]) * np.clip(part, 0.0, 1.0)
    return np.where(ends[-1] > 0.0, out, np.nan)
