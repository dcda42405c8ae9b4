"""The level of the noise and its growth with range: the lowest law of range on which many blocks of bins lie, since
echoes only add to noise."""
import dataclasses

import numpy as np

from .statistics import DB_OF_E, Bounded, bootstrap

ROWS = 8                # of a block
GROUPS = 8              # of beams
NEAR_DB = 0.8           # a block is on the law if it is within this of it
LEAST_BLOCKS = 6
LEAST_SHARE = 0.12      # of all blocks
LEAST_LEVEL_DB = 0.1    # the trend within a block and the law's error leave
START_STEP = 0.02       # between tried starts of the gain, as a share of the farthest range
# Beams stand out by this many times the spread of the others, and by at least 0.4 dB.
DEVIATIONS_AHEAD, LEAST_OVER_DB, MOST_GAP = 4.0, 0.4, 8


@dataclasses.dataclass
class Blocks:
    """The level of the noise in blocks of 8 bins, all beams and pings together."""

    row: np.ndarray
    range_m: np.ndarray
    level_db: np.ndarray        # re full scale
    homogeneous: np.ndarray     # beams and pings have one level, and no value is 0
    without_echo: np.ndarray    # no part is constant from ping to ping
    without_zeros: np.ndarray   # hardly a value is 0

    def part(self, chosen):
        return Blocks(*(getattr(self, field.name)[chosen] for field in dataclasses.fields(self)))


def noise_blocks(recording, law, without_beams=None):
    """The level of the part that changes from ping to ping, by range. Noise N is new in every ping, an echo of a
    scene at rest is constant: with M the mean of the powers A and B of a place in two pings, the mean of (A - B)^2
    is 2 (2 M N - N^2), for one look at one sample."""
    pings, ranges, beams = recording.values.shape
    used = np.ones(beams, bool) if without_beams is None else ~without_beams
    group = np.arange(beams)[used] * GROUPS // beams
    count = ranges // ROWS
    sums, groups, before = np.zeros((6, count)), np.zeros((count, GROUPS)), None

    def by_block(x):
        return x.reshape(count, -1).sum(axis=1)
    for values in recording.values:
        values = values[:count * ROWS, used]
        logs = law.log_power(values)
        sums[:3] += by_block(values <= 0.0), by_block(logs), by_block(logs**2)
        groups += np.stack([np.bincount(group, row, GROUPS) for row in logs.reshape(count, ROWS, -1).sum(axis=1)])
        if before is not None:
            a, b = np.exp(before), np.exp(logs)
            sums[3:] += by_block((before - logs) ** 2), by_block(0.5 * (a + b)), by_block((a - b) ** 2)
        before = logs
    number = pings * ROWS * used.sum()
    zeros, mean = sums[0] / number, sums[1] / number
    difference, power, half = sums[3:] / max((pings - 1) * ROWS * used.sum(), 1) * [[1.0], [1.0], [0.5]]
    expected = law.statistics.variance
    # The difference of independent log powers has twice their variance.
    echo = (1.0 - 0.5 * difference / expected > 0.25) & (half < 0.75 * power**2) & (pings > 1)
    with np.errstate(all="ignore"):
        fresh = np.log(power - np.sqrt(np.maximum(power**2 - half, 0.0)))
    level_db = DB_OF_E * np.where(echo, fresh, mean - law.statistics.mean)
    independent = max(number / GROUPS / 6.0, 1.0)
    even = spread_of_groups(groups / (pings * ROWS), group) < 0.3 + 3.0 * np.sqrt(expected / independent)
    single = law.statistics.looks == 1 and not law.statistics.excess.any()
    row = ROWS * np.arange(count)
    range_m = recording.first_range_m + (row + 0.5 * (ROWS - 1)) * recording.range_step_m
    blocks = Blocks(row, range_m, level_db, (zeros < 0.003) & np.where(echo, single, even) & np.isfinite(level_db),
                    ~echo, ~law.cuts_off(np.exp(level_db / DB_OF_E)))
    return blocks.part(range_m > 0.0)


def spread_of_groups(sums, group):
    """The spread of the mean log powers of groups of beams: 1.48 times the median distance from their median, so
    that a bright point does not count. Without the two middle groups, which hold noise that all elements share."""
    counts = np.bincount(group, minlength=GROUPS)
    outer = (counts > 0) & ~np.isin(np.arange(GROUPS), (GROUPS // 2, GROUPS // 2 - 1))
    if outer.sum() < 3:
        return np.zeros(len(sums))
    means = sums[:, outer] / counts[outer]
    middle = outer.sum() // 2
    sizes = np.abs(means - np.sort(means, axis=1)[:, middle:middle + 1])
    return 1.48 * np.sort(sizes, axis=1)[:, middle]


@dataclasses.dataclass
class Noise:
    """The noise after the gain, re full scale: level_db + tvg_log log10(r) + 2 absorption r, r at least tvg_from_m."""

    level_db: Bounded           # extrapolated to 1 m without absorption
    tvg_log: Bounded
    tvg_from_m: Bounded         # 0 if the pings show no start of the gain
    absorption_db_per_m: float
    used: Blocks | None = None  # the blocks that lie on it
    ahead: np.ndarray | None = None     # the beams that hold noise which all elements share

    def at(self, range_m):
        return self.level_db.value + gain_db(range_m, self.tvg_log.value, self.tvg_from_m.value,
                                             self.absorption_db_per_m)


def gain_db(range_m, log_factor, from_m, absorption_db_per_m):
    r = np.maximum(range_m, from_m)
    return log_factor * np.log10(r) + 2.0 * absorption_db_per_m * r


def fit_noise(blocks, absorption):
    """The lowest law on which many blocks lie; None if it holds fewer than 6 blocks or an eighth of all."""
    if not blocks.homogeneous.any():
        return None
    shape = lowest_law(blocks, absorption)
    used = near(blocks, absorption, shape, NEAR_DB)
    if used.sum() < max(LEAST_BLOCKS, LEAST_SHARE * len(blocks.row)):
        return None
    # A finer grid about the tried start of the gain, whose steps would bend the law by up to a decibel.
    farthest = blocks.range_m[-1]
    starts = shape[2] + START_STEP * farthest * np.linspace(-1.0, 1.0, 21) if shape[2] > 0.0 else np.zeros(1)
    starts = np.maximum(starts, 0.0)
    for _ in range(5):
        shape = best_line(blocks.part(used), absorption, starts, np.ones((1, used.sum())))[0]
        used = near(blocks, absorption, shape, 1.2 * NEAR_DB)
        if used.sum() < LEAST_BLOCKS:
            return None
    chosen = blocks.part(used)
    least = [LEAST_LEVEL_DB, 0.2, START_STEP * chosen.range_m[-1] if shape[2] > 0.0 else 0.0]
    found = bootstrap(len(chosen.row), lambda w: best_line(chosen, absorption, starts, w), least)
    return Noise(*found, absorption, chosen)


def lowest_law(blocks, absorption):
    """(level, log factor, start) with the most blocks near the law less the number of those below it."""
    range_m, level = blocks.range_m[blocks.homogeneous], blocks.level_db[blocks.homogeneous]
    step = START_STEP * blocks.range_m[-1]
    best, most = None, -np.inf
    for from_m in [0.0, *np.arange(1.4 * blocks.range_m[0], 20.0 * step, step)]:
        for factor in range(61):
            off = np.sort(level - gain_db(range_m, factor, from_m, absorption))
            end = np.searchsorted(off, off + 2.0 * NEAR_DB, "right")
            score = end - 2 * np.arange(len(off))
            at = int(np.argmax(score))
            # A start above 0 must gain at least three blocks.
            if score[at] - 3.0 * (from_m > 0.0) > most:
                most = score[at] - 3.0 * (from_m > 0.0)
                best = 0.5 * (off[at] + off[end[at] - 1]), float(factor), from_m
    return best


def near(blocks, absorption, shape, within_db):
    level, factor, from_m = shape
    off = blocks.level_db - level - gain_db(blocks.range_m, factor, from_m, absorption)
    return blocks.homogeneous & (np.abs(off) <= within_db)


def best_line(blocks, absorption, starts, weights):
    """Least squares of (level, log factor, start) for weights [draw, block]."""
    found, errors = [], []
    for from_m in starts:
        r = np.maximum(blocks.range_m, from_m)
        x, y = np.log10(r), blocks.level_db - 2.0 * absorption * r
        w = weights.sum(axis=1)
        sx, sy, sxx, sxy, syy = (weights @ np.stack([x, y, x * x, x * y, y * y], axis=1)).T
        with np.errstate(all="ignore"):
            factor = (sxy - sx * sy / w) / (sxx - sx * sx / w)
            level = (sy - factor * sx) / w
            errors.append(syy - level * sy - factor * sxy)
        found.append(np.stack([level, factor, np.full(len(w), from_m)], axis=1))
    best = np.argmin(np.where(np.isfinite(errors), errors, np.inf), axis=0)
    return np.array(found)[best, np.arange(len(weights))]


def find_noise(recording, law, absorption):
    """The noise, first of all beams, then without those that stand out straight ahead."""
    noise = fit_noise(noise_blocks(recording, law), absorption)
    ahead = None if noise is None else ahead_beams(recording, law, noise)
    if ahead is None:
        return noise
    noise = fit_noise(noise_blocks(recording, law, ahead), absorption)
    return noise and dataclasses.replace(noise, ahead=ahead)


def ahead_beams(recording, law, noise):
    """The beams whose noise exceeds that of the fan, from straight ahead on to both sides: noise that all elements
    share acts like a wave from there. None if the beam straight ahead does not stand out."""
    if recording.bearing_rad is None or recording.values.shape[2] < 3 or not noise.used.without_echo.any():
        return None
    blocks = noise.used.part(noise.used.without_echo)
    rows = (blocks.row[:, None] + np.arange(ROWS)).ravel()
    of_row = np.repeat(noise.at(blocks.range_m), ROWS) / DB_OF_E
    over = np.mean([(law.log_power(values[rows]) - of_row[:, None]).mean(axis=0) for values in recording.values], axis=0)
    over = DB_OF_E * (over - np.median(over))
    stands_out = over > max(DEVIATIONS_AHEAD * 1.48 * np.median(np.abs(over)), LEAST_OVER_DB)
    ahead = int(np.argmin(np.abs(np.sin(recording.bearing_rad))))
    if not stands_out[ahead]:
        return None
    ends = []
    for step in (-1, 1):
        last = j = ahead
        # Side lobes lie beyond nulls of a few beams.
        while 0 <= j < len(over) and abs(j - last) <= MOST_GAP:
            last, j = (j if stands_out[j] else last), j + step
        ends.append(last)
    index = np.arange(len(over))
    return (index >= ends[0]) & (index <= ends[1])
