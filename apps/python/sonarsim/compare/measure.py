"""All figures of the images of a recording (docs/compare.md)."""
import dataclasses

import numpy as np

from . import speckle
from .edges import edge_figures
from .figure import Figure
from .images import Grid, decibels
from .points import point_figures
from .shadows import shadow_figures

RANGE_BANDS, BEARING_BANDS = 12, 8
MOST_TREND = {"bottom": 0.5, "image": 0.5, "water": 0.35, "tail": 0.35}
MOST_CLIPPED = 0.03
LAGS = (1, 2, 4)
LOWEST_DB, BIN_DB, LEVEL_BINS = -160.0, 0.5, 340
PERCENTILES = (5, 25, 50, 75, 95, 99)
NEIGHBOURS = ((-1, -1), (-1, 0), (-1, 1), (0, 1), (1, 1), (1, 0), (1, -1), (0, -1))


@dataclasses.dataclass
class Bands:
    """Intervals that both recordings have."""

    ranges_m: tuple
    bearings_rad: tuple | None


@dataclasses.dataclass
class Histogram:
    """The counts of bins at each place, [place, bin], all pings together."""

    name: str
    bin_width: float
    unit: str
    counts: np.ndarray


def measure_images(images, size, zones, bands):
    """(figures, histograms) of images."""
    grid = Grid(images.shape, size)
    figures = []
    for name, zone in (("image" if zones.is_one else "bottom", zones.bottom), ("water", zones.water),
                       ("tail", zones.tail)):
        figures += zone_figures(images, grid, name, zone)
    figures += level_figures(images, grid, zones, bands)
    figures += share_figures(images, grid)
    histograms = [level_histogram(images, grid), texture_histogram(images, grid)]
    figures += percentile_figures(histograms[0])
    if not images.columns_are_pings:
        figures += point_figures(images, grid, zones) + edge_figures(images, grid, zones)
    if images.has_shadows:
        figures += shadow_figures(images, grid, zones)
    return [figure for figure in figures if figure.values.size], histograms


def zone_figures(images, grid, name, zone):
    """Figures of the speckle in the patches of a zone that count."""
    first = -(-zone[0] // grid.size[0]) * grid.columns
    places = np.arange(first, zone[1] // grid.size[0] * grid.columns)
    across = "pings" if images.columns_are_pings else "beams"
    rules = [("variation of amplitude", "tenth"), ("Weibull shape", "tenth"), ("inverse K shape", "correlation"),
             ("scintillation index", "tenth"), ("spread of levels, dB", "tenth"),
             *((f"correlation over {lag} {unit}", "correlation") for unit in ("ranges", across) for lag in LAGS),
             ("correlation to the next ping", "correlation")]
    if not places.size:
        return []
    basis = speckle.trend_basis(grid.size)
    table = np.full((len(images.powers), len(rules), len(places)), np.nan)
    before = None
    for own, image in zip(table, images.powers):
        power = grid.cut(image)[places]
        amplitude, trend, is_even = speckle.detrended(power, basis)
        clipped = ((power >= images.full_power) | (power <= images.least_power)).mean(axis=(1, 2))
        counts = is_even & (trend <= MOST_TREND[name]) & (clipped <= MOST_CLIPPED)
        if counts.any():
            own[:-1, counts] = patch_values(amplitude[counts])
        if before is not None and not images.columns_are_pings:
            both = counts & before[1]
            own[-1, both] = speckle.correlation_of(amplitude[both], before[0][both])
        before = amplitude, counts
    pings = np.arange(len(table))[:, None]
    return [Figure.of(f"{name}: {what}", "mean" if "correlation" in what else "quantile", tolerance, places, pings,
                      table[:, k]) for k, (what, tolerance) in enumerate(rules)]


def patch_values(amplitude):
    with np.errstate(invalid="ignore", divide="ignore"):
        return np.stack([speckle.variation(amplitude), speckle.weibull_shape(amplitude),
                         speckle.inverse_k_shape(amplitude), speckle.scintillation(amplitude),
                         speckle.spread_db(amplitude),
                         *(speckle.correlation(amplitude, lag, axis) for axis in (1, 2) for lag in LAGS)])


def level_figures(images, grid, zones, bands):
    """Levels of zones, of bands of range, and of bands of bearing in the bottom."""
    ranges = np.arange(images.shape[0])
    zone = np.full(len(ranges), -1)
    zone[ranges < zones.water[0]] = 3
    for number, (begin, end) in ((2, zones.tail), (1, zones.water), (0, zones.bottom)):
        zone[begin:end] = number
    names = ["image: level, dB" if zones.is_one else "bottom: level, dB", "water: level, dB", "tail: level, dB",
             "ring: level, dB"]
    everywhere = np.zeros(images.shape[1], int)
    figures = banded_levels(images, grid, names, zone, everywhere)
    names, edges = band_names("level at", bands.ranges_m, RANGE_BANDS, "m")
    band = band_of(images.first_range_m + images.range_step_m * ranges, edges)
    figures += banded_levels(images, grid, names, band, everywhere)
    if images.bearing_rad is not None and bands.bearings_rad:
        names, edges = band_names("bottom: level at", np.degrees(bands.bearings_rad), BEARING_BANDS, "degrees")
        column_band = band_of(np.degrees(images.bearing_rad), edges)
        figures += banded_levels(images, grid, names, np.where(zone == 0, 0, -1), column_band)
    return figures


def band_names(what, interval, count, unit):
    edges = np.linspace(*interval, count + 1)
    texts = [f"{round(edge, 2) + 0.0:g}" for edge in edges]
    return [f"{what} {a} to {b} {unit}, dB" for a, b in zip(texts, texts[1:])], edges


def band_of(values, edges):
    """The band of each value; -1 outside."""
    share = (values - edges[0]) / (edges[-1] - edges[0])
    return np.where((share >= 0.0) & (share < 1.0), (share * (len(edges) - 1)).astype(int), -1)


def banded_levels(images, grid, names, range_bands, column_bands):
    """The levels of bands: of ranges if all columns have the band 0, else of columns. A cell is the part of a patch in
    one band."""
    (height, width), rows, columns = grid.size, grid.rows, grid.columns
    range_bands = range_bands[:rows * height].reshape(rows, height)
    column_bands = column_bands[:columns * width].reshape(columns, width)
    down, right = (np.arange(1 + max(bands.max(), 0)) == bands[..., None] for bands in (range_bands, column_bands))
    counts = np.einsum("rha,cwb->rcab", down.astype(float), right.astype(float))
    sums = np.array([np.einsum("rchw,rha,cwb->rcab", grid.cut(image).reshape(rows, columns, height, width), down,
                               right, optimize=True) for image in images.powers.astype(np.float64)])
    bands = counts.shape[2] * counts.shape[3]
    counts = counts.reshape(grid.places, bands)
    sums = sums.reshape(-1, grid.places, bands)
    places, pings = np.arange(grid.places), np.arange(len(sums))[:, None]
    with np.errstate(invalid="ignore"):
        return [Figure.of(names[band], "level", "decibel", places, pings, sums[..., band] / counts[:, band],
                          counts[:, band]) for band in range(bands)]


def share_figures(images, grid):
    """The shares of values at either end of the scale."""
    places, pings = np.arange(grid.places), np.arange(len(images.powers))[:, None]
    def shares(is_counted):
        return [is_counted(grid.cut(image)).mean(axis=(1, 2)) for image in images.powers]
    figures = [Figure.of("share of zeros", "mean", "share", places, pings,
                         shares(lambda power: ~(power > images.least_power)))]
    if np.isfinite(images.full_power):
        figures.append(Figure.of("share of clipped values", "mean", "share", places, pings,
                                 shares(lambda power: power >= images.full_power)))
    return figures


def level_histogram(images, grid):
    counts = np.zeros((grid.places, LEVEL_BINS))
    for image in images.powers:
        bins = ((decibels(grid.cut(image)) - LOWEST_DB) / BIN_DB + 0.5).astype(int)
        add_counts(counts, np.clip(bins, 0, LEVEL_BINS - 1))
    return Histogram("levels", BIN_DB, "dB", counts)


def add_counts(counts, bins):
    """Adds the bins of each place, [place, ...]."""
    places, width = counts.shape
    numbers = np.arange(places)[:, None] * width + bins.reshape(places, -1)
    counts += np.bincount(numbers.ravel(), minlength=counts.size).reshape(counts.shape)


def texture_histogram(images, grid):
    """The uniform local binary patterns of eight neighbours (Ojala, Pietikainen and Maenpaa 2002) of the inner pixels of
    patches: a bit for each neighbour whose power is at least that of the pixel."""
    patterns = np.arange(256)
    turned = (patterns << 1 | patterns >> 7) & 255
    changes = np.unpackbits((patterns ^ turned).astype(np.uint8)[:, None], axis=1).sum(axis=1)
    numbers = np.where(changes <= 2, np.cumsum(changes <= 2) - 1, 58)
    counts = np.zeros((grid.places, 59))
    height, width = grid.size
    for image in images.powers:
        patches = grid.cut(image)
        pattern = np.zeros((grid.places, height - 2, width - 2), int) if min(height, width) > 2 else None
        if pattern is None:
            break
        for down, right in NEIGHBOURS:
            other = patches[:, 1 + down:height - 1 + down, 1 + right:width - 1 + right]
            pattern = pattern << 1 | (other >= patches[:, 1:-1, 1:-1])
        add_counts(counts, numbers[pattern])
    return Histogram("texture", 1.0, "patterns", counts)


def percentile_figures(levels):
    places, bins = np.nonzero(levels.counts)
    return [Figure.of(f"level of {percent} % of the image, dB", "quantile", "decibel", places, 0,
                      LOWEST_DB + BIN_DB * bins, levels.counts[places, bins], percent / 100.0)
            for percent in PERCENTILES]
