"""Shadows of a side-scan: runs of ranges that are dark against the median of their range over the pings of an image."""
import numpy as np
from scipy import ndimage

from .figure import Figure
from .images import LEAST_POWER

WINDOW = 5
LEAST_LENGTH = 5
DARK = 0.25     # 6 dB below; speckle alone makes such a run in fewer than one of 10,000 bins


def shadow_figures(images, grid, zones):
    begin = zones.bottom[0]
    depths, edges, shares = [], [], []
    rows = np.arange(begin, zones.bottom[0] + (images.shape[0] - begin) // grid.size[0] * grid.size[0], grid.size[0])
    tested = np.unique(grid.place_of(rows[:, None], grid.size[1] * np.arange(max(1, grid.columns))))
    for ping, image in enumerate(images.powers):
        dark = np.zeros(grid.place_of(images.shape[0], images.shape[1]) + 1)
        for column, first, end, depth, edge in shadows_of(image.astype(float), begin):
            place = grid.place_of(first, column)
            depths.append((place, ping, depth))
            edges.append((place, ping, edge))
            np.add.at(dark, grid.place_of(np.arange(first, end), column), 1.0)
        shares += [(place, ping, dark[place] / (grid.size[0] * grid.size[1])) for place in tested]
    return [Figure.of(name, reduce, tolerance, *(np.array(cells).T if cells else np.zeros((3, 0))))
            for name, reduce, tolerance, cells in (
                ("shadows: share of the bottom", "mean", "share", shares),
                ("shadows: depth, dB", "quantile", "decibel", depths),
                ("shadows: far edge, ranges", "quantile", "tenth", edges))]


def window_mean(image, size):
    """The mean of a window that ends at the image's borders."""
    def sums(values):
        return ndimage.uniform_filter(values, size, mode="constant")
    return sums(image) / sums(np.ones_like(image))


def shadows_of(image, begin):
    """(column, first range, end, depth in dB, width of the far edge) of the shadows from range `begin` on."""
    smooth = window_mean(image, (WINDOW, WINDOW))[begin:]
    across = window_mean(image, (1, WINDOW))[begin:]
    middle = image.shape[1] // 2
    median = np.partition(smooth, middle, axis=1)[:, middle]
    is_dark = np.zeros((len(smooth) + 2, image.shape[1]), int)
    is_dark[1:-1] = smooth < DARK * median[:, None]
    found = []
    for column in range(image.shape[1]):
        steps = np.diff(is_dark[:, column])
        for first, end in zip(np.flatnonzero(steps == 1), np.flatnonzero(steps == -1)):
            if end - first >= LEAST_LENGTH:
                found.append((column, begin + first, begin + end,
                              *measured_shadow(across[:, column], median, first, end)))
    return found


def measured_shadow(line, median, first, end):
    """The level of a shadow's middle over the median, and the ranges from a quarter to three quarters of its far rise."""
    trim = min(WINDOW // 2, (end - first - 1) // 2)
    inside, around = (values[first + trim:end - trim].mean() for values in (line, median))
    depth = 10.0 * np.log10(max(inside, LEAST_POWER) / max(around, LEAST_POWER))
    beyond = line[(first + end) // 2:]
    quarter, most = (reached_at(beyond, inside + share * (around - inside)) for share in (0.25, 0.75))
    return depth, most - quarter


def reached_at(line, power):
    """The place, interpolated linearly, at which a line first reaches a power behind its first value; NaN if nowhere."""
    above = np.flatnonzero(line[1:] >= power)
    if not above.size:
        return np.nan
    k = above[0] + 1
    return k - (line[k] - power) / max(line[k] - line[k - 1], 1e-30)
