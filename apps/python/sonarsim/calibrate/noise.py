"""The level of the noise and its growth with range: the lowest law on which many blocks lie, as echoes only add."""
import dataclasses

import numpy as np

from .statistics import DB_OF_E, Bounded, bootstrap

ROWS, GROUPS = 8, 8         # bins of a block, groups of beams
NEAR_DB = 0.8               # a block is on the law if it is within this of it
MIN_BLOCKS, MIN_SHARE = 6, 0.12
MIN_LEVEL_DB, MIN_TVG = 0.1, 0.2    # errors that the trend within a block and the law leave


def noise_blocks(recording, law):
    """The level in dB re full scale of the part that changes from ping to ping, in blocks of 8 bins, without
    the middle quarter of the beams, if there are eight: noise that all elements share acts like a wave from there.
    Noise N is new in every ping, an echo of a scene at rest is constant: with M the mean of the powers A and B of a
    place in two pings, the mean of (A - B)^2 is 2 (2 M N - N^2), for one sample. `homogeneous`: beams and
    pings have one level, and no value is 0; `without_echo`: no part is constant."""
    pings, ranges, beams = recording.values.shape
    group, count = np.arange(beams) * GROUPS // beams, ranges // ROWS
    used = (beams < GROUPS) | (np.abs(group - 0.5 * (GROUPS - 1)) > 1.0)
    group = group[used]
    sums, groups, before = np.zeros((5, count)), np.zeros((count, GROUPS)), None

    def by_block(x):
        return x.reshape(count, -1).mean(axis=1)
    for values in recording.values:
        values = values[:count * ROWS, used]
        logs = law.log_power(values)
        sums[:2] += by_block(values <= 0.0), by_block(logs)
        groups += [np.bincount(group, row, GROUPS) for row in logs.reshape(count, ROWS, -1).mean(axis=1)]
        if before is not None:
            a, b = np.exp(before), np.exp(logs)
            sums[2:] += by_block((before - logs) ** 2), by_block(0.5 * (a + b)), by_block(0.5 * (a - b) ** 2)
        before = logs
    zeros, mean = sums[:2] / pings
    difference, power, half = sums[2:] / max(pings - 1, 1)
    expected = law.statistics.variance
    # The difference of independent log powers has twice their variance.
    echo = (difference < 1.5 * expected) & (half < 0.75 * power**2) & (pings > 1)
    with np.errstate(all="ignore"):
        fresh = np.log(power - np.sqrt(power**2 - half))
    level_db = DB_OF_E * np.where(echo, fresh, mean - law.statistics.mean)
    independent = max(pings * ROWS * beams / GROUPS / 6.0, 1.0)
    even = spread_of_groups(groups / pings, group) < 0.3 + 3.0 * np.sqrt(expected / independent)
    row = ROWS * np.arange(count)
    range_m = recording.first_range_m + (row + 0.5 * (ROWS - 1)) * recording.range_step_m
    homogeneous = (zeros < 0.003) & np.where(echo, law.statistics.is_single, even) & np.isfinite(level_db)
    columns = row, range_m, level_db, homogeneous, ~echo, ~law.cuts_off(np.exp(level_db / DB_OF_E))
    return np.rec.fromarrays(columns, names="row,range_m,level_db,homogeneous,without_echo,without_zeros")[range_m > 0.0]


def spread_of_groups(sums, group):
    """The robust spread of the mean log powers of groups of beams: 1.48 times the (upper) median distance from their median."""
    counts = np.bincount(group, minlength=GROUPS)
    outer = counts > 0
    if outer.sum() < 3:
        return np.zeros(len(sums))
    means, middle = sums[:, outer] / counts[outer], outer.sum() // 2
    sizes = np.abs(means - np.sort(means, axis=1)[:, middle:middle + 1])
    return 1.48 * np.sort(sizes, axis=1)[:, middle]


@dataclasses.dataclass
class Noise:
    """The noise after the gain, re full scale: level_db + tvg_log log10(r) + 2 absorption r, r at least from_m."""
    level_db: Bounded           # extrapolated to 1 m without absorption
    tvg_log: Bounded
    from_m: float
    absorption_db_per_m: float
    used: np.recarray | None = None     # the blocks that lie on it

    def at(self, range_m):
        r = np.maximum(range_m, self.from_m)
        return self.level_db.value + self.tvg_log.value * np.log10(r) + 2.0 * self.absorption_db_per_m * r


def fit_noise(blocks, absorption, from_m=0.0):
    """The lowest law on which many blocks lie; None if it holds fewer than 6 blocks or an eighth of all."""
    if not blocks.homogeneous.any():
        return None
    r = np.maximum(blocks.range_m, from_m)
    x, y = np.log10(r), blocks.level_db - 2.0 * absorption * r
    tried = []
    for factor in range(61):
        # The level with the most blocks near the law less the number of those below it.
        off = np.sort((y - factor * x)[blocks.homogeneous])
        end = np.searchsorted(off, off + 2.0 * NEAR_DB, "right")
        score = end - 2 * np.arange(len(off))
        at = int(np.argmax(score))
        tried.append((score[at], -factor, 0.5 * (off[at] + off[end[at] - 1])))
    line = max(tried)[:0:-1] * np.array([1.0, -1.0])
    used = blocks.homogeneous & (np.abs(y - line[0] - line[1] * x) <= NEAR_DB)
    if used.sum() < max(MIN_BLOCKS, MIN_SHARE * len(x)):
        return None
    for _ in range(5):
        line = best_line(x[used], y[used], np.ones((1, used.sum())))[0]
        used = blocks.homogeneous & (np.abs(y - line[0] - line[1] * x) <= 1.2 * NEAR_DB)
        if used.sum() < MIN_BLOCKS or not -3.0 <= line[1] <= 63.0:   # limits of the key, and 3
            return None
    found = bootstrap(used.sum(), lambda w: best_line(x[used], y[used], w), [MIN_LEVEL_DB, MIN_TVG])
    return Noise(*found, from_m, absorption, blocks[used])


def best_line(x, y, weights):
    """Least squares of (level, log factor) for weights [draw, block]."""
    w = weights.sum(axis=1)
    sx, sy, sxx, sxy = (weights @ np.stack([x, y, x * x, x * y], axis=1)).T
    factor = (sxy - sx * sy / w) / (sxx - sx * sx / w)
    return np.stack([(sy - factor * sx) / w, factor], axis=1)
