"""What lies behind the first return of the bottom, or behind the strongest echo of a beam."""
import numpy as np
from scipy import ndimage

from .figure import MIN_POWER, Figure, decibels
from .images import RING_SHARE

# Metres behind the first return of a side-scan, over the level 4 to 8 m behind it; behind the peak of others, over it.
DISTANCES_M = {"sidescan": (0.1, 0.5, 1.0, 2.0, 4.0), "echosounder": (1.0, 2.0, 3.0, 5.0, 7.0, 10.0)}
OF_WALLS_M, REFERENCE_M = (0.1, 0.2, 0.5, 1.0, 2.0), (4.0, 8.0)
NEIGHBOURS, STANDS_OUT_DB, DEEPEST_DB, MAX_PLACES = 9, 15.0, 40.0, 64


def first_returns(images):
    """The range at which the bottom begins, [image, column]: where the level passes the middle of its lowest and usual."""
    first, found = images.shape[0] // RING_SHARE, []
    for image in images.powers:
        level = decibels(ndimage.uniform_filter(image.astype(float), (9, 5)))[first:]
        high = np.percentile(level, 60, axis=0)
        low = np.maximum(level.min(axis=0), high - DEEPEST_DB)
        at = first + np.argmax(level > 0.5 * (low + high), axis=0)
        found.append(ndimage.median_filter(at, NEIGHBOURS, mode="nearest"))
    return np.array(found)


def strongest_echoes(images):
    """The range of the strongest echo behind the ring of each column, -1 where none stands out, [image, column]."""
    first = images.shape[0] // RING_SHARE
    powers = images.powers[:, first:]
    stands_out = decibels(powers.max(axis=1)) > decibels(np.median(powers, axis=1)) + STANDS_OUT_DB
    return np.where(stands_out, first + powers.argmax(axis=1), -1)


def behind_figures(images):
    """The levels behind the edge of each column: of a median column, so that neither a point nor a shadow counts."""
    is_sidescan, step, count = images.kind == "sidescan", images.range_step_m, images.shape[0]
    edges = first_returns(images) if is_sidescan else strongest_echoes(images)
    number, column = np.nonzero(edges > 0)
    edge, powers = edges[number, column], images.powers[number, :, column].astype(float)
    sums = np.pad(np.cumsum(powers, axis=1), ((0, 0), (1, 0)))
    rows, width = np.arange(len(edge)), images.shape[1]
    # Neighbouring columns have a place in common; pings have one of their own.
    unit, count_of_units = (number * width + column, len(images.powers) * width) if images.columns_are_pings else (column, width)
    place, ping = unit * min(MAX_PLACES, count_of_units) // count_of_units, 0 if images.columns_are_pings else number

    def level(near_m, far_m):
        begin, end = (edge + np.round(metres / step).astype(int) for metres in (near_m, far_m))
        end, inside = np.maximum(end, begin + 1), end < count
        begin, end = np.minimum(begin, count - 1), np.minimum(end, count)
        mean = (sums[rows, end] - sums[rows, begin]) / (end - begin)
        return np.where(inside, decibels(np.maximum(mean, MIN_POWER)), np.nan)
    reference = level(*REFERENCE_M) if is_sidescan else decibels(powers[rows, edge])
    what = "the first return" if is_sidescan else "the peak" if images.kind == "echosounder" else "the strongest echo"
    return [Figure.of(f"{metres:g} m behind {what}, dB", "quantile", "decibel", place, ping,
                      level(metres - 1.5 * step, metres + 1.5 * step) - reference)
            for metres in DISTANCES_M.get(images.kind, OF_WALLS_M) if metres >= 3.0 * step]
