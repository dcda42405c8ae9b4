"""What an eye sees besides speckle: patches of the bottom, and pings and beams that are off."""
import numpy as np
from scipy import ndimage

from .behind import MAX_PLACES, first_returns
from .figure import Figure, decibels
from .images import RING_SHARE

MIN_BLOCK, OCTAVES, MIN_BLOCKS = 8, 5, 12
FROM_BOTTOM = 1.5       # blocks of a side-scan begin at this many altitudes
NEIGHBOURS, OVER_DB, UNDER_DB = 9, 6.0, 3.0


def block_sizes(a, b):
    """Octaves of metres, from 8 samples of the coarser images on."""
    return MIN_BLOCK * max(a.range_step_m, b.range_step_m) * 2.0 ** np.arange(OCTAVES)


def block_figures(images, grid, zone, sizes_m):
    """The spread of mean levels of square blocks of the bottom less their trend over range; in samples of a side-scan."""
    if images.kind not in ("imaging", "sidescan"):
        return []
    powers, count = images.powers.astype(float), images.shape[0]
    begin = np.broadcast_to(zone[0], powers[:, 0].shape)
    if images.kind == "sidescan":
        begin = np.maximum(first_returns(images) * FROM_BOTTOM, count // RING_SHARE)
    used = (np.arange(count)[:, None] >= begin[:, None]) & (np.arange(count)[:, None] < zone[1])
    # Port and starboard have trends of their own.
    sides = np.array_split(np.arange(len(powers)), 2 if images.kind == "sidescan" else 1)
    for side in sides:
        powers[side] /= trend_of(powers[side], used[side], images.ranges_m)[:, None]
    out, middle_m = [], images.ranges_m[(zone[0] + zone[1]) // 2 if zone[1] < count else count // 2]
    if not images.columns_are_pings:
        column_rad = np.ptp(images.bearing_rad[[0, -1]]) / max(len(images.bearing_rad) - 1, 1) or 1.0
    for metres in sizes_m:
        height = max(1, round(metres / images.range_step_m))
        width = height if images.columns_are_pings else max(1, round(metres / (middle_m * column_rad)))
        rows, columns = count // height, images.shape[1] // width
        if not rows * columns:
            continue
        cut, whole = (x[:, :rows * height, :columns * width].reshape(len(x), rows, height, columns, width)
                      for x in (powers, used))
        level = np.where(whole.all(axis=(2, 4)), decibels(cut.mean(axis=(2, 4))), np.nan)
        if np.isfinite(level).sum() >= MIN_BLOCKS:
            row, column = np.arange(rows)[:, None] * height, np.arange(columns) * width
            out.append(Figure.of(f"means over {metres:.2g} m: spread, dB", "spread", "texture", grid.place_of(row, column),
                                 np.arange(len(level))[:, None, None], level))
    return out


def trend_of(powers, used, ranges_m):
    """A parabola of the level over the logarithm of range, as power, at each range."""
    count = used.sum(axis=(0, 2))
    known = (count > 0) & (ranges_m > 0.0)
    mean = (powers * used).sum(axis=(0, 2))[known] / count[known]
    known[known], mean = mean > 0.0, mean[mean > 0.0]
    if known.sum() < MIN_BLOCK:
        return np.ones(len(ranges_m))
    x = np.log(ranges_m[known])
    middle, size = x.mean(), x.std()
    line = np.polyfit((x - middle) / size, np.log(mean), 2)
    at = np.clip((np.log(np.maximum(ranges_m, ranges_m[known][0])) - middle) / size, -3.0, 3.0)
    return np.exp(np.polyval(line, at))


def off_figures(images):
    """The shares of pings that are stronger or weaker than their neighbours, and the spread of all; the spread of beams."""
    out = []
    if not images.columns_are_pings:
        off = off_by(images.beam_levels_db)
        out = [Figure.of("beams: deviation from their neighbours, dB", "spread", "texture", np.arange(off.shape[1]),
                         np.arange(len(off))[:, None], off)]
    off = off_by(images.ping_levels_db)
    if off.shape[1] < NEIGHBOURS:
        return out
    places = np.arange(off.shape[1]) * min(off.shape[1], MAX_PLACES) // off.shape[1]
    return [Figure.of(f"pings {OVER_DB:g} dB over their neighbours", "mean", "hundredth", places, 0, off > OVER_DB),
            Figure.of(f"pings {UNDER_DB:g} dB under their neighbours", "mean", "hundredth", places, 0, off < -UNDER_DB),
            Figure.of("pings: deviation from their neighbours, dB", "spread", "texture", places, 0, off)] + out


def off_by(levels_db):
    return levels_db - ndimage.median_filter(levels_db, (1, NEIGHBOURS), mode="nearest")
