"""Figures of soundings, in bands of 10 degrees from the vertical."""
import dataclasses

import numpy as np

from .figure import Figure

BAND = np.pi / 18.0
GROUPS = "levels over the mean", "variation of power", "spread of ranges"
PINGS_IN_GROUP, FEWEST_IN_BAND = 8, 6


def common_angles(*recordings):
    """The angles between which 98 % of the soundings of either recording lie."""
    ends = []
    for recording in recordings:
        angles = np.sort(recording.soundings.angle_rad[np.isfinite(recording.soundings.angle_rad)])
        cut = angles.size // 100
        ends.append((angles[cut], angles[angles.size - 1 - cut]) if angles.size else (0.0, 0.0))
    return max(end[0] for end in ends), min(end[1] for end in ends)


def measure_soundings(recording, angles, is_relative):
    """The figures in the bands between two angles. Places are groups of eight pings."""
    own = recording.soundings
    power = recording.law.powers(own.intensity).astype(float)
    power = np.where(np.isfinite(own.range_m), power, np.nan)
    if is_relative and np.nansum(power) > 0.0:
        power /= np.nanmean(power)
    bands = range(int(np.ceil(angles[0] / BAND - 0.5)), int(np.floor(angles[1] / BAND + 0.5)))
    found = [figure for band in bands for figure in band_figures(own, power, band) if figure.values.size]
    levels = [one for one in found if one.reduce == "level"]
    if not levels:
        return found
    whole = Figure.of("level, dB", "level", "decibel", *(np.concatenate([getattr(one, name) for one in levels])
                                                         for name in ("places", "pings", "values", "weights")))
    whole.group = "gain"
    found = [one.over(whole) if one.reduce == "level" else one for one in found]
    return [whole] * (not is_relative) + sorted(found, key=lambda one: GROUPS.index(one.group))


def band_figures(soundings, power, band):
    offset, cells = soundings.angle_rad.astype(float) / BAND - band, []
    is_in = (offset >= 0.0) & (offset < 1.0) & np.isfinite(power)
    for ping in np.flatnonzero(is_in.sum(axis=1) >= FEWEST_IN_BAND):
        own = is_in[ping]
        mean = power[ping, own].mean()
        cells.append((ping // PINGS_IN_GROUP, mean, own.sum(), power[ping, own].std(ddof=1) / mean if mean > 0.0 else np.nan,
                      100.0 * spread_of(soundings.range_m[ping, own].astype(float), offset[ping, own] - 0.5)))
    groups, levels, counts, variations, spreads = np.array(cells).T if cells else np.zeros((5, 0))
    name = f"{10 * band} to {10 * (band + 1)} degrees"
    return [dataclasses.replace(figure, group=group) for group, figure in (
        (GROUPS[0], Figure.of(f"{name}: level over all, dB", "level", "decibel", groups, 0, levels, counts)),
        (GROUPS[1], Figure.of(f"{name}: variation of power", "mean", "tenth", groups, 0, variations)),
        (GROUPS[2], Figure.of(f"{name}: spread of ranges, %", "mean", "tenth", groups, 0, spreads)))]


def spread_of(ranges, offset):
    """The RMS distance of n ranges from their parabola over the angle, by n - 3 degrees of freedom, over the mean range."""
    basis, sizes, _ = np.linalg.svd(np.vander(offset, 3), full_matrices=False)
    off = ranges - basis @ (basis.T @ ranges)
    return np.sqrt(np.sum(off ** 2) / (len(ranges) - 3)) / ranges.mean() if sizes[2] > 1e-6 else np.nan
