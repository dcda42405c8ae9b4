"""Compares two recordings figure by figure (docs/compare.md)."""
import dataclasses

import numpy as np

from ..recording import Recording, RecordingError
from .bootstrap import Estimate, estimate, exchange_p
from .images import decibels, have_one_grid, images_of, patch_size_of, zones_of
from .measure import Bands, measure_images
from .soundings import common_angles, measure_soundings

SIGNIFICANCE = 0.05
HISTOGRAM_DRAWS = 200


@dataclasses.dataclass
class ComparedFigure:
    """A figure of both recordings and what its difference means."""

    name: str
    estimate: Estimate
    tolerance: float            # in the figure's unit
    adjusted_p: float = 1.0     # for all figures together

    @property
    def difference(self):
        return self.estimate.simulated - self.estimate.real

    @property
    def half(self):
        """Half of the 95 % interval of the difference."""
        return self.estimate.factor * self.estimate.difference_error

    @property
    def standardised(self):
        """The difference over its standard error; 0 without one."""
        return self.difference / self.estimate.difference_error if self.estimate.difference_error > 0.0 else 0.0

    @property
    def agrees(self):
        return abs(self.difference) <= max(self.tolerance, self.half)

    @property
    def differs(self):
        return self.adjusted_p < SIGNIFICANCE


@dataclasses.dataclass
class ComparedHistogram:
    """Distances of two histograms."""

    name: str
    unit: str
    jensen_shannon: float       # bits
    usual: float                # 95 % of draws that exchange places lie below
    kullback_leibler: float     # nats
    earth_movers: float         # in the unit


@dataclasses.dataclass
class Comparison:
    real: Recording
    simulated: Recording
    has_one_grid: bool
    is_relative: bool           # powers are relative to the mean of each recording
    figures: list
    histograms: list
    levels: list                # (ranges in m, levels in dB) of both, for the plot

    @property
    def agreeing(self):
        return sum(figure.agrees for figure in self.figures)

    @property
    def differing(self):
        return sum(figure.differs for figure in self.figures)

    @property
    def is_same(self):
        return self.differing == 0

    @property
    def first_change(self):
        """The figure that is furthest off among those that differ and do not agree, else among all that differ."""
        return max((figure for figure in self.figures if figure.differs), default=None,
                   key=lambda figure: (not figure.agrees, abs(figure.standardised)))


def compare_recordings(real, simulated, seed=1):
    """The Comparison of two recordings. RecordingError if they are of different kinds or have no figure in common."""
    if real.kind != simulated.kind:
        raise RecordingError(f"{real.name} is of the kind {real.kind}, {simulated.name} of the kind {simulated.kind}; "
                             "compare recordings of one kind")
    # A recording without a known largest value has no absolute level.
    is_relative = real.law.full_value == 0.0 or simulated.law.full_value == 0.0
    same_places, same_pings, measured, levels = measure_both(real, simulated, is_relative)
    others = {figure.name: figure for figure in measured[1][0]}
    pairs, figures = [], []
    for figure in measured[0][0]:
        other = others.get(figure.name)
        own = other and estimate(figure, other, same_places, same_pings, seed)
        if own and own.degrees > 0.0:       # else it was found at fewer than eight places
            pairs.append((figure, other))
            figures.append(ComparedFigure(figure.name, own, tolerance_of(figure.tolerance, own.real)))
    if not figures:
        raise RecordingError("the recordings have no figure in common: too few ranges, beams or pings")
    adjust(figures)
    if same_places:
        adjust_by_exchange(figures, pairs, seed)
    histograms = [compared_histograms(*both, same_places, seed) for both in zip(measured[0][1], measured[1][1])]
    return Comparison(real, simulated, same_places, is_relative, figures, histograms, levels)


def tolerance_of(kind, real):
    tenth = 0.1 * abs(real)
    return {"tenth": tenth, "decibel": 1.0, "correlation": 0.05, "share": max(0.001, tenth)}[kind]


def measure_both(real, simulated, is_relative):
    """(same places, same pings, [(figures, histograms)] of both, levels by range of both)."""
    if real.kind == "soundings":
        angles = common_angles(real, simulated)
        return False, False, [(measure_soundings(one, angles, is_relative), []) for one in (real, simulated)], []
    images = [images_of(one) for one in (real, simulated)]
    if is_relative:
        images = [one.relative() for one in images]
    a, b = images
    is_one = have_one_grid(a, b)
    means = [one.mean_powers() for one in images]
    # With a common grid both have the zones of their mean, so that chance does not shift one's against the other's.
    zones = [zones_of(mean) for mean in ([0.5 * (means[0] + means[1])] * 2 if is_one else means)]
    size, bands = patch_size_of(a, b), common_bands(a, b)
    measured = [measure_images(one, size, own, bands) for one, own in zip(images, zones)]
    levels = [(one.first_range_m + one.range_step_m * np.arange(len(mean)), decibels(mean))
              for one, mean in zip(images, means)]
    return is_one, is_one and len(a.powers) == len(b.powers), measured, levels


def common_bands(a, b):
    begin = max(a.first_range_m, b.first_range_m)
    end = min(one.first_range_m + one.shape[0] * one.range_step_m for one in (a, b))
    if end <= begin:
        raise RecordingError("the recordings have no ranges in common")
    bearings = None
    if a.bearing_rad is not None and b.bearing_rad is not None:
        low, high = max(a.bearing_rad.min(), b.bearing_rad.min()), min(a.bearing_rad.max(), b.bearing_rad.max())
        bearings = (low, high) if high > low else None
    return Bands((begin, end), bearings)


def adjust(figures):
    """Holm's step-down correction: the k-th smallest p of m is multiplied by m - k."""
    largest = 0.0
    for k, figure in enumerate(sorted(figures, key=lambda one: one.estimate.p)):
        largest = max(largest, min(1.0, figure.estimate.p * (len(figures) - k)))
        figure.adjusted_p = largest


def adjust_by_exchange(figures, pairs, seed):
    """A figure of common places must also differ in the test by exchange, since a few bright places cause other tails than
    Student's. A figure without variance has no such tails."""
    of_exchange = exchange_p(pairs, [figure.estimate.difference_error for figure in figures], seed)
    for figure, p in zip(figures, of_exchange):
        if figure.estimate.difference_error > 0.0:
            figure.adjusted_p = max(figure.adjusted_p, float(p))


def compared_histograms(real, simulated, is_paired, seed):
    a, b = real.counts.sum(axis=0), simulated.counts.sum(axis=0)
    random = np.random.default_rng([seed, 4])
    share = 0.5 if is_paired else len(real.counts) / (len(real.counts) + len(simulated.counts))
    drawn = []
    for _ in range(HISTOGRAM_DRAWS):
        # Redistributes the places of both; common places are exchanged one by one.
        of_real = random.random(len(real.counts)) < share
        of_simulated = ~of_real if is_paired else random.random(len(simulated.counts)) < share
        one = of_real @ real.counts + of_simulated @ simulated.counts
        other = a + b - one
        drawn.append(jensen_shannon(one, other) if one.sum() > 0.0 and other.sum() > 0.0 else 1.0)
    return ComparedHistogram(real.name, real.unit, jensen_shannon(a, b), float(np.quantile(drawn, 0.95)),
                             kullback_leibler(a, b), real.bin_width * earth_movers(a, b))


def jensen_shannon(one, other):
    """The Jensen-Shannon divergence of two histograms, bits: 0 for equal shares, 1 for those that share no bin."""
    p, q = one / one.sum(), other / other.sum()
    middle = 0.5 * (p + q)
    return float(0.5 * sum(np.sum(x[x > 0.0] * np.log2(x[x > 0.0] / middle[x > 0.0])) for x in (p, q)))


def kullback_leibler(one, other):
    """The Kullback-Leibler divergence, nats, with half a count added to each bin, so that an empty one does not make it
    infinite."""
    p, q = ((x + 0.5) / (x + 0.5).sum() for x in (one, other))
    return float(np.sum(p * np.log(p / q)))


def earth_movers(one, other):
    """The mean number of bins by which counts have to be moved."""
    return float(np.abs(np.cumsum(one / one.sum() - other / other.sum())).sum())
