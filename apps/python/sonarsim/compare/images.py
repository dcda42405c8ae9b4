"""The powers of a recording as images, their zones by range, and the patches that they are cut into."""
import dataclasses

import numpy as np

from ..recording.recording import MAX_POWER
from .figure import decibels

MAX_STRIP_PINGS = 64
CLIPPED_SHARE = 0.995       # values above this share of the largest count as clipped
# Zones; on three pings of a real sonar over a rough bottom these shares find the ranges that a person had marked.
BOTTOM_DB, STANDS_OUT_DB = 10.0, 15.0
RING_SHARE, SMOOTHED_SHARE, RANGES_OF_LEVEL = 28, 44, 8


@dataclasses.dataclass
class Images:
    """Images of powers [image, range, column], one for each ping; with one or two beams the columns are up to 64 pings."""

    powers: np.ndarray
    first_range_m: float
    range_step_m: float
    bearing_rad: np.ndarray | None  # of the columns; None where they are pings
    kind: str                       # of the recording
    is_relative: bool               # levels of the recording have no common scale with those of the other
    full_power: float               # powers from here on are clipped; inf: none are
    min_power: float              # powers up to here are at the lower end of the scale
    ping_levels_db: np.ndarray      # [side, ping], one side for all kinds but a side-scan; also of pings in no image
    beam_levels_db: np.ndarray      # [ping, beam]

    @property
    def columns_are_pings(self):
        return self.bearing_rad is None

    @property
    def shape(self):
        return self.powers.shape[1:]

    @property
    def ranges_m(self):
        return self.first_range_m + self.range_step_m * np.arange(self.shape[0])

    def mean_powers(self):
        return self.powers.mean(axis=(0, 2), dtype=np.float64)


def images_of(recording, is_relative):
    """The Images of a recording; their powers are divided by their mean if levels are relative."""
    law, powers = recording.law, recording.powers()
    is_imaging, blocks = recording.kind == "imaging", block_levels_db(powers)
    levels = blocks.mean(axis=1)
    if not is_imaging:
        pings, ranges, beams = powers.shape
        width = min(MAX_STRIP_PINGS, pings)
        strips = powers[:pings // width * width].reshape(-1, width, ranges, beams)
        powers = strips.transpose(3, 0, 2, 1).reshape(-1, ranges, width)
    mean = powers.mean(dtype=np.float64) if is_relative else 1.0
    factor = np.float32(1.0 / mean if mean > 0.0 else 1.0)
    full = float(factor * law.powers(CLIPPED_SHARE * law.largest_value)) if law.full_value else np.inf
    return Images(factor * powers, recording.first_range_m, recording.range_step_m,
                  recording.bearing_rad if is_imaging else None, recording.kind, is_relative, full,
                  float(factor * law.powers(0.0)), levels.mean(axis=1)[None] if is_imaging else levels.T, levels)


def block_levels_db(powers):
    """The levels of blocks of 8 ranges behind the ring, [ping, block, beam]: zeros count as the least power above 0."""
    powers = powers[:, len(powers[0]) // RING_SHARE:]
    count = max(powers.shape[1] // RANGES_OF_LEVEL, 1)
    means = powers[:, :count * RANGES_OF_LEVEL].reshape(len(powers), count, -1, powers.shape[2]).mean(axis=2, dtype=float)
    return decibels(np.maximum(means, powers.min(where=powers > 0.0, initial=MAX_POWER)))


def have_one_grid(a, b):
    """True if a place in one is a place in the other."""
    # Ranges that differ by less than half a sample at the far end are the same.
    off = abs(a.first_range_m - b.first_range_m) + a.shape[0] * abs(a.range_step_m - b.range_step_m)
    return a.shape == b.shape and a.columns_are_pings == b.columns_are_pings and off < 0.5 * a.range_step_m


def patch_size_of(a, b):
    """The (ranges, columns) of patches that fit both."""
    ranges, columns = np.minimum(a.shape, b.shape)
    # The trend takes six degrees of freedom; eight bins to a side are the fewest.
    return min(ranges, int(np.clip(ranges // 8, 8, 32))), min(columns, int(np.clip(columns // 4, 8, 16)))


class Grid:
    """Patches of an image, numbered a row after the other, which do not overlap. The rest of the image is left out."""

    def __init__(self, shape, size):
        self.size = size
        self.rows, self.columns = shape[0] // size[0], shape[1] // size[1]
        self.places = self.rows * self.columns

    def cut(self, image):
        """The patches of an image, [place, range, column]."""
        (height, width), rows, columns = self.size, self.rows, self.columns
        whole = image[:rows * height, :columns * width].reshape(rows, height, columns, width)
        return whole.swapaxes(1, 2).reshape(self.places, height, width)

    def place_of(self, ranges, columns):
        """The number of the patch that holds a bin, or that is the nearest across."""
        across = max(self.columns, 1)
        return ranges // self.size[0] * across + np.minimum(across - 1, columns // self.size[1])


@dataclasses.dataclass
class Zones:
    """Ranges (from, to) by their level. Without a bottom that stands out, `bottom` is the whole image."""

    water: tuple = (0, 0)
    bottom: tuple = (0, 0)
    tail: tuple = (0, 0)

    @property
    def is_one(self):
        return self.water[0] == self.water[1] and self.tail[0] == self.tail[1]

    @property
    def nearest(self):
        return self.water if self.water[1] > self.water[0] else self.bottom


def zones_of(mean_powers):
    """The zones of the mean powers of ranges (docs/calibrate.md)."""
    count, at = len(mean_powers), np.arange(len(mean_powers))
    half = count // SMOOTHED_SHARE // 2
    low, high = np.maximum(at - half, 0), np.minimum(at + half + 1, count)
    sums = np.concatenate([[0.0], np.cumsum(mean_powers)])
    level = decibels((sums[high] - sums[low]) / (high - low))
    first = count // RING_SHARE
    peak = first + int(np.argmax(level[first:]))
    edge = level[peak] - BOTTOM_DB
    if not level[first:].min() < level[peak] - STANDS_OUT_DB:
        return Zones(bottom=(0, count))
    weak = np.concatenate([[first - 1], np.flatnonzero((level < edge) & (at >= first)), [count]])
    begin, end = int(weak[weak < peak].max()) + 1, int(weak[weak > peak].min())
    zones = Zones(bottom=(begin, end))
    if begin > first:
        lowest = level[first:begin].min()
        is_strong = np.append(level[first:begin] > lowest + (edge - lowest) / 3.0, True)
        zones.water = (first, first + int(np.argmax(is_strong)))
    if end < count:
        lowest = level[end:].min()
        zones.tail = (end + int(np.argmax(level[end:] <= lowest + (edge - lowest) / 2.0)), count)
    return zones
