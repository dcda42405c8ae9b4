"""The uncertainty of a figure of two recordings, and the test by exchange of places.

Errors come from the Bayesian bootstrap (Rubin 1981): draws of weights for places, for pings and for cells. The variance is
the one over places, plus the excess of that over pings above that over cells (Cameron, Gelbach and Miller 2011): speckle
that stays from ping to ping counts once, and a gain that drifts counts as often as there are pings."""
import dataclasses

import numpy as np
from scipy import stats

from .figure import joined, value_of, without_gain

DRAWS, CELL_DRAWS, EXCHANGES = 300, 100, 499
FEWEST_PLACES, MAX_DEGREES, SIGNIFICANCE = 8, 300.0, 0.05
TOLERANCES = {"decibel": 1.0, "texture": 0.3, "correlation": 0.05, "skewness": 0.1, "hundredth": 0.01}


@dataclasses.dataclass
class ComparedFigure:
    """A figure of both recordings and what its difference means. Errors are standard errors."""
    name: str
    group: str
    real: float
    simulated: float
    tolerance: float            # in the figure's unit
    real_error: float = 0.0
    simulated_error: float = 0.0
    error: float = 0.0          # of the difference
    degrees: float = 0.0        # of freedom, of the difference; 0: its error cannot be known
    p: float = 1.0              # two-sided, of no difference
    adjusted_p: float = 1.0     # for all figures together

    @property
    def difference(self):
        return self.simulated - self.real

    @property
    def halves(self):
        """Half of the 95 % intervals of real, simulated and the difference."""
        factor = stats.t.ppf(0.975, min(self.degrees, MAX_DEGREES)) if self.degrees > 0.0 else 0.0
        return [float(factor * error) for error in (self.real_error, self.simulated_error, self.error)]

    @property
    def standardised(self):
        """The difference over its standard error; 0 without one."""
        return self.difference / self.error if self.error > 0.0 else 0.0

    @property
    def tolerances_off(self):
        return abs(self.difference) / max(self.tolerance, self.halves[2], 1e-9)

    @property
    def agrees(self):
        return abs(self.difference) <= max(self.tolerance, self.halves[2])

    @property
    def differs(self):
        return self.adjusted_p < SIGNIFICANCE


def tolerance_of(kind, value):
    tenth = 0.1 * abs(value)
    return {"tenth": tenth, "share": max(0.001, tenth), **TOLERANCES}[kind]


def compared(real, simulated, same_places, same_pings, seed):
    """The ComparedFigure of two figures. What they share at common places, or in common pings, cancels in the difference."""
    out = ComparedFigure(real.name, real.group, value_of(real), value_of(simulated),
                         tolerance_of(real.tolerance, value_of(real)))
    places, pings = (min(len(np.unique(units)) for units in both) for both in (
        (real.places, simulated.places), (real.pings, simulated.pings)))
    by_places, by_pings = corrected(variances(real, simulated, "places", same_places, seed), places), np.zeros(3)
    if pings > 1:
        cells = variances(real, simulated, "cells", same_places and same_pings, seed)
        by_pings = np.maximum(corrected(variances(real, simulated, "pings", same_pings, seed), pings) - cells, 0.0)
    out.real_error, out.simulated_error, out.error = map(float, np.sqrt(by_places + by_pings))
    if places < FEWEST_PLACES:
        return out
    least = 1e-9 * (abs(out.real) + abs(out.simulated)) + 1e-30
    if out.error < least:
        out.degrees, out.p = places - 1.0, float(abs(out.difference) <= least)
        return out
    # Satterthwaite's degrees of freedom.
    parts = by_places[2] ** 2 / degrees_of(real, simulated, same_places, places) + by_pings[2] ** 2 / max(pings - 1.0, 1.0)
    out.degrees = float((by_places + by_pings)[2] ** 2 / parts)
    out.p = float(2.0 * stats.t.sf(abs(out.standardised), min(out.degrees, MAX_DEGREES)))
    return out


def corrected(drawn, units):
    """The Bayesian bootstrap of n units has (n - 1) / (n + 1) of the true variance."""
    return drawn * (units + 1.0) / (units - 1.0) if units > 1 else np.zeros(3)


def variances(real, simulated, kind, is_paired, seed):
    """The variances over draws of the real figure, the simulated one and their difference."""
    pings = 1 + max(figure.pings.max() for figure in (real, simulated))
    units = np.concatenate([{"places": one.places, "pings": one.pings, "cells": one.places * pings + one.pings}[kind]
                            for one in (real, simulated)])
    known, numbers = np.unique(units, return_inverse=True)
    real_part, simulated_part = np.split(numbers, [real.places.size])
    random = np.random.default_rng([seed, ("places", "pings", "cells").index(kind)])
    shape = (CELL_DRAWS if kind == "cells" else DRAWS, len(known))
    draws = random.standard_exponential(shape)
    a = joined((real, real_part, draws))
    b = joined((simulated, simulated_part, draws if is_paired else random.standard_exponential(shape)))
    return np.array([np.var(x[np.isfinite(x)], ddof=1) if np.isfinite(x).sum() > 1 else 0.0 for x in (a, b, b - a)])


def degrees_of(real, simulated, is_paired, places):
    """The degrees of freedom of a variance to which places contribute unequally: normal contributions x of n equal
    variances have the expectation 3 / (n + 2) of sum(x^4) / sum(x^2)^2. A few bright places then count as few."""
    without = 1.0 - np.eye(1 + max(figure.places.max() for figure in (real, simulated)))
    changes = [joined((figure, figure.places, without)) - value_of(figure) for figure in (real, simulated)]
    changes = [np.where(np.isfinite(change), change, 0.0) for change in changes]
    change = changes[1] - changes[0] if is_paired else np.concatenate(changes)
    fourth, most = np.sum(change ** 4), places - 1.0
    return float(np.clip(3.0 * np.sum(change ** 2) ** 2 / fourth - 2.0, 1.0, most)) if fourth > 0.0 else most


def adjust(figures):
    """Holm's step-down correction: the k-th smallest p of m is multiplied by m - k."""
    largest = 0.0
    for k, figure in enumerate(sorted(figures, key=lambda one: one.p)):
        largest = figure.adjusted_p = max(largest, min(1.0, figure.p * (len(figures) - k)))


def exchange_p(pairs, errors, seed):
    """For each pair of figures with common places the probability, if both come from one distribution, that the greatest
    standardised difference is as great as its own (Westfall and Young 1993, step-down). A draw exchanges a place in all
    figures alike, or leaves it, so the level holds for all figures together whatever their distributions."""
    places = 1 + max(figure.places.max() for pair in pairs for figure in pair)
    swaps = np.random.default_rng([seed, 3]).integers(0, 2, (EXCHANGES + 1, places)).astype(float)
    swaps[0] = 0.0
    sizes = np.zeros((len(pairs), EXCHANGES + 1))
    for size, (real, simulated), error in zip(sizes, [tuple(map(without_gain, pair)) for pair in pairs], errors):
        if error > 0.0:
            one, other = (joined((real, real.places, a), (simulated, simulated.places, b))
                          for a, b in ((1.0 - swaps, swaps), (swaps, 1.0 - swaps)))
            size[:] = np.nan_to_num(np.abs(other - one) / error, posinf=0.0)
    # From the smallest difference up: each is compared with those that are not larger.
    order = np.argsort(sizes[:, 0], kind="stable")
    greatest = np.maximum.accumulate(sizes[order, 1:], axis=0)
    p, out = (1.0 + (greatest >= sizes[order, :1]).sum(axis=1)) / (EXCHANGES + 1.0), np.empty(len(pairs))
    out[order] = np.maximum.accumulate(p[::-1])[::-1]   # none is more significant than one with a larger difference
    return out
