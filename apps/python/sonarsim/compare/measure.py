"""All figures of the images of a recording (docs/calibrate.md)."""
import dataclasses
import functools

import numpy as np
from scipy import ndimage

from . import speckle
from .behind import behind_figures
from .figure import MIN_POWER, Figure, decibels
from .images import Grid
from .texture import block_figures, off_figures

RANGE_BANDS, BEARING_BANDS = 8, 4
MAX_TREND = {"bottom": 0.5, "image": 0.5, "water": 0.35, "tail": 0.35}
MAX_CLIPPED, LAGS = 0.03, (1, 2, 4)
LOWEST_DB, BIN_DB, LEVEL_BINS = -160.0, 0.5, 340
PERCENTILES = (5, 25, 75, 95, 99)
REACH = (9, 25)         # a point is the largest within 4 ranges and 12 beams
STANDS_OUT = 150.0      # 22 dB over the median of the 7 ranges about it
LOBES = np.array([-8, -7, -6, -5, 5, 6, 7, 8])
SHADOW_WINDOW, MIN_SHADOW = 5, 5
DARK = 0.25     # 6 dB below; speckle alone makes such a run in fewer than one of 10,000 bins


def measure_images(images, size, zones, bands, sizes_m):
    """The figures of images. `bands`: the intervals of range and of bearing (or None); `sizes_m`: those of blocks."""
    grid = Grid(images.shape, size)
    groups = {**level_figures(images, grid, zones, bands),
              "greys": share_figures(images, grid) + percentile_figures(images, grid)}
    for name, zone in (("image" if zones.is_one else "bottom", zones.bottom), ("water", zones.water), ("tail", zones.tail)):
        groups[f"speckle of the {name}"] = zone_figures(images, grid, name, zone)
    groups["patches of the bottom"] = block_figures(images, grid, zones.bottom, sizes_m)
    groups["behind strong echoes"] = behind_figures(images)
    groups["pings and beams that are off"] = off_figures(images)
    if not images.columns_are_pings:
        groups["points"] = point_figures(images, grid, zones)
    if images.kind == "sidescan":
        groups["shadows"] = shadow_figures(images, grid, zones)
    return [dataclasses.replace(figure, group=group) for group, figures in groups.items() for figure in figures
            if figure.values.size]


def zone_figures(images, grid, name, zone):
    """Figures of the speckle in the patches of a zone that count."""
    places = np.arange(-(-zone[0] // grid.size[0]) * grid.columns, zone[1] // grid.size[0] * grid.columns)
    across = "pings" if images.columns_are_pings else "beams"
    rules = [("variation of amplitude", "tenth", speckle.variation), ("Weibull shape", "tenth", speckle.weibull_shape),
             ("inverse K shape", "correlation", speckle.inverse_k_shape),
             ("skewness of logarithms", "skewness", speckle.skewness),
             *((f"correlation over {lag} {unit}", "correlation", functools.partial(speckle.correlation, lag=lag, axis=axis))
               for axis, unit in ((1, "ranges"), (2, across)) for lag in LAGS),
             ("correlation to the next ping", "correlation", None)]
    basis, before = speckle.trend_basis(grid.size), None
    table = np.full((len(images.powers), len(rules), len(places)), np.nan)
    for own, image in zip(table, images.powers if places.size else ()):
        power = grid.cut(image)[places]
        amplitude, trend, is_even = speckle.detrended(power, basis)
        clipped = ((power >= images.full_power) | (power <= images.min_power)).mean(axis=(1, 2))
        counts = is_even & (trend <= MAX_TREND[name]) & (clipped <= MAX_CLIPPED)
        if counts.any():
            with np.errstate(invalid="ignore", divide="ignore"):
                own[:-1, counts] = [measure(amplitude[counts]) for *_, measure in rules[:-1]]
        if before is not None and not images.columns_are_pings:
            both = counts & before[1]
            own[-1, both] = speckle.correlation_of(amplitude[both], before[0][both])
        before = amplitude, counts
    return [Figure.of(f"{name}: {what}", "mean" if "correlation" in what else "quantile", tolerance, places,
                      np.arange(len(table))[:, None], table[:, k]) for k, (what, tolerance, _) in enumerate(rules)]


def level_figures(images, grid, zones, bands):
    """Groups of levels: the bottom's, which the gain decides; over it zones, bands of range and of bearing; the ring's."""
    ranges, everywhere = np.arange(images.shape[0]), np.zeros(images.shape[1], int)
    zone = np.where(ranges < zones.water[0], 3, -1)
    for number, (begin, end) in ((2, zones.tail), (1, zones.water), (0, zones.bottom)):
        zone[begin:end] = number
    bottom = "image" if zones.is_one else "bottom"
    names = [f"{bottom}: level, dB", *(f"{name}: level over the {bottom}, dB" for name in ("water", "tail", "ring"))]
    whole, *others = banded_levels(images, grid, names, zone, everywhere)
    ring = others.pop() if len(others) == 3 else None
    names, band = bands_of("level at", images.ranges_m, bands[0], RANGE_BANDS, "m")
    others += banded_levels(images, grid, names, np.where(zone == 3, -1, band), everywhere)
    if images.bearing_rad is not None and bands[1]:
        names, band = bands_of("bottom: level at", np.degrees(images.bearing_rad), np.degrees(bands[1]),
                               BEARING_BANDS, "degrees")
        others += banded_levels(images, grid, names, np.where(zone == 0, 0, -1), band)
    levels = {"gain": [] if images.is_relative else [whole],
              "levels over the bottom": [one.over(whole) for one in others if one.values.size]}
    return {**levels, "ring": [ring.over(whole)]} if ring else levels


def bands_of(what, values, interval, count, unit):
    """The names of bands, and the band of each value, -1 outside."""
    edges = np.linspace(*interval, count + 1)
    texts = [f"{np.copysign(np.floor(100.0 * abs(edge) + 0.5) / 100.0, edge) + 0.0:g}" for edge in edges]
    share = (values - edges[0]) / (edges[-1] - edges[0])
    return ([f"{what} {a} to {b} {unit}, dB" for a, b in zip(texts, texts[1:])],
            np.where((share >= 0.0) & (share < 1.0), (share * count).astype(int), -1))


def banded_levels(images, grid, names, range_bands, column_bands):
    """The levels of bands: of ranges if all columns have the band 0, else of columns. A cell: a patch's part in a band."""
    (height, width), rows, columns = grid.size, grid.rows, grid.columns
    down, right = (np.arange(1 + max(bands.max(), 0)) == bands[:n * step].reshape(n, step)[..., None] for bands, n, step in (
        (range_bands, rows, height), (column_bands, columns, width)))
    counts = np.einsum("rha,cwb->rcab", down.astype(float), right.astype(float)).reshape(grid.places, -1)
    sums = np.array([np.einsum("rchw,rha,cwb->rcab", grid.cut(image).reshape(rows, columns, height, width), down, right,
                               optimize=True).reshape(counts.shape) for image in images.powers.astype(np.float64)])
    with np.errstate(invalid="ignore"):
        return [Figure.of(names[band], "level", "decibel", np.arange(grid.places), np.arange(len(sums))[:, None],
                          sums[..., band] / counts[:, band], counts[:, band]) for band in range(counts.shape[1])]


def share_figures(images, grid):
    """The shares of values at either end of the scale."""
    is_known = np.isfinite(images.full_power)
    return [Figure.of(name, "mean", "share", np.arange(grid.places), np.arange(len(images.powers))[:, None],
                      [is_at(grid.cut(image)).mean(axis=(1, 2)) for image in images.powers])
            for name, is_at in (("share of zeros", lambda power: ~(power > images.min_power)),
                                ("share of white", lambda power: power >= images.full_power))[:1 + is_known]]


def percentile_figures(images, grid):
    """Percentiles of the levels, by the counts of each level at each place in all pings."""
    counts = np.zeros(grid.places * LEVEL_BINS)
    for image in images.powers:
        bins = ((decibels(grid.cut(image)) - LOWEST_DB) / BIN_DB + 0.5).astype(int).reshape(grid.places, -1)
        numbers = np.arange(grid.places)[:, None] * LEVEL_BINS + np.clip(bins, 0, LEVEL_BINS - 1)
        counts += np.bincount(numbers.ravel(), minlength=counts.size)
    places, bins = np.divmod(np.flatnonzero(counts), LEVEL_BINS)
    return [Figure.of(f"{percent} % of the levels over their median, dB", "quantile", "decibel", places, 0,
                      LOWEST_DB + BIN_DB * bins, counts[counts > 0], percent / 100.0, 0.5) for percent in PERCENTILES]


def point_figures(images, grid, zones):
    """Widths and side lobes of the echoes of points that stand alone in the water."""
    cells = []
    for ping, image in enumerate(images.powers):
        for i, j in points_of(image, *zones.nearest):
            lobes = image[i, np.clip(j + LOBES, 0, image.shape[1] - 1)].mean() / image[i, j]
            cells.append((grid.place_of(i, j), ping, width_of(image[i], j), width_of(image[:, j], i),
                          max(-120.0, float(decibels(lobes)))))
    places, pings, beams, ranges, lobes = np.array(cells).T if cells else np.zeros((5, 0))
    return [Figure.of("points: width, beams", "quantile", "tenth", places, pings, beams),
            Figure.of("points: width, ranges", "quantile", "tenth", places, pings, ranges),
            Figure.of("points: side lobes, dB", "quantile", "decibel", places, pings, lobes)]


def points_of(image, begin, end):
    """The (range, beam) of points, at least 20 beams, or an eighth of the fan, away from its edges."""
    ranges, beams = image.shape
    margin = min(20, beams // 8)
    is_point = (image > 0.0) & (image >= ndimage.maximum_filter(image, REACH, mode="nearest"))
    is_point[:max(begin, 1)] = is_point[min(end, ranges - 1):] = False
    is_point[:, :margin] = is_point[:, beams - margin:] = False
    found = []
    for i in np.flatnonzero(is_point.any(axis=1)) if beams >= REACH[1] - 1 else ():
        rows = image[max(0, i - 3):i + 4].ravel()
        median = np.partition(rows, rows.size // 2)[rows.size // 2]
        found += [(i, j) for j in np.flatnonzero(is_point[i] & (image[i] >= STANDS_OUT * median))]
    return found


def width_of(line, peak):
    """The width at half of the power, between bins linearly."""
    half, width = 0.5 * line[peak], 0.0
    for side in (line[peak::-1].astype(float), line[peak:].astype(float)):
        k = int(np.argmax(side <= half)) or len(side)
        width += k - 1 + ((side[k - 1] - half) / (side[k - 1] - side[k]) if k < len(side) else 0.0)
    return width


def shadow_figures(images, grid, zones):
    """Shadows of a side-scan: runs of ranges that are dark against the median of their range over the pings of an image."""
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
    inside, ones = ([ndimage.uniform_filter(one, (rows, SHADOW_WINDOW), mode="constant")[begin:] for rows in (SHADOW_WINDOW, 1)]
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
                  if end - first >= MIN_SHADOW]
    return found


def measured_shadow(line, median, first, end):
    """The level of a shadow's middle over the median, and the ranges from a quarter to three quarters of its far rise."""
    trim = min(SHADOW_WINDOW // 2, (end - first - 1) // 2)
    inside, around = (values[first + trim:end - trim].mean() for values in (line, median))
    depth = 10.0 * np.log10(max(inside, MIN_POWER) / max(around, MIN_POWER))
    beyond = line[(first + end) // 2:]
    quarter, most = (reached_at(beyond, inside + share * (around - inside)) for share in (0.25, 0.75))
    return depth, most - quarter


def reached_at(line, power):
    """The place, interpolated linearly, at which a line first reaches a power behind its first value; NaN if nowhere."""
    k = int(np.argmax(np.append(False, line[1:] >= power)))
    return k - (line[k] - power) / max(line[k] - line[k - 1], 1e-30) if k else np.nan
