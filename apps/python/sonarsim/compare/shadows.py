"""Shadows of a side-scan: runs of ranges that are dark against the median of their range over the pings of an image."""
import numpy as np
from scipy import ndimage

from .figure import MIN_POWER, Figure

WINDOW = 5
MIN_LENGTH = 5
DARK = 0.25     # 6 dB below; speckle alone makes such a run in fewer than one of 10,000 bins


def shadow_figures(images, grid, zones):
    begin, (height, width) = zones.bottom[0], grid.size
    rows = np.arange(begin, images.shape[0] - height + 1, height)
    tested = np.unique(grid.place_of(rows[:, None], width * np.arange(max(1, grid.columns))))
    shadows, shares = [], []
    for ping, image in enumerate(images.powers):
        dark = np.zeros(grid.place_of(*images.shape) + 1)
        for column, first, end, depth, edge in shadows_of(image.astype(float), begin):
            shadows.append((grid.place_of(first, column), ping, depth, edge))
            np.add.at(dark, grid.place_of(np.arange(first, end), column), 1.0 / (height * width))
        shares += [(place, ping, dark[place]) for place in tested]
    places, pings, depths, edges = np.array(shadows).T if shadows else np.zeros((4, 0))
    return [Figure.of("shadows: share of the bottom", "mean", "share", *np.array(shares).reshape(-1, 3).T),
            Figure.of("shadows: depth, dB", "quantile", "decibel", places, pings, depths),
            Figure.of("shadows: far edge, ranges", "quantile", "tenth", places, pings, edges)]


def shadows_of(image, begin):
    """(column, first range, end, depth in dB, width of the far edge) of the shadows from range `begin` on."""
    # Windows end at the image's borders.
    inside, ones = ([ndimage.uniform_filter(one, size, mode="constant")[begin:] for size in ((WINDOW, WINDOW), (1, WINDOW))]
                    for one in (image, np.ones_like(image)))
    smooth, across = inside[0] / ones[0], inside[1] / ones[1]
    middle = image.shape[1] // 2
    median = np.partition(smooth, middle, axis=1)[:, middle]
    is_dark = np.zeros((len(smooth) + 2, image.shape[1]), int)
    is_dark[1:-1] = smooth < DARK * median[:, None]
    found = []
    for column, steps in enumerate(np.diff(is_dark, axis=0).T):
        found += [(column, begin + first, begin + end, *measured_shadow(across[:, column], median, first, end))
                  for first, end in zip(np.flatnonzero(steps == 1), np.flatnonzero(steps == -1))
                  if end - first >= MIN_LENGTH]
    return found


def measured_shadow(line, median, first, end):
    """The level of a shadow's middle over the median, and the ranges from a quarter to three quarters of its far rise."""
    trim = min(WINDOW // 2, (end - first - 1) // 2)
    inside, around = (values[first + trim:end - trim].mean() for values in (line, median))
    depth = 10.0 * np.log10(max(inside, MIN_POWER) / max(around, MIN_POWER))
    beyond = line[(first + end) // 2:]
    quarter, most = (reached_at(beyond, inside + share * (around - inside)) for share in (0.25, 0.75))
    return depth, most - quarter


def reached_at(line, power):
    """The place, interpolated linearly, at which a line first reaches a power behind its first value; NaN if nowhere."""
    k = int(np.argmax(np.append(False, line[1:] >= power)))
    return k - (line[k] - power) / max(line[k] - line[k - 1], 1e-30) if k else np.nan
