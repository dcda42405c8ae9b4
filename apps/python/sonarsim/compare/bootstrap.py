"""The uncertainty of a figure of two recordings, and the test by exchange of places.

Errors come from the Bayesian bootstrap (Rubin 1981): draws of weights for places, for pings and for cells. The variance is
the one over places, plus the excess of that over pings above that over cells (Cameron, Gelbach and Miller 2011): speckle that
stays from ping to ping counts once, and a gain that drifts counts as often as there are pings."""
import dataclasses

import numpy as np
from scipy import stats

from .figure import joined

DRAWS, CELL_DRAWS, EXCHANGES = 300, 100, 499
FEWEST_PLACES = 8
MOST_DEGREES = 300.0


@dataclasses.dataclass
class Estimate:
    """A figure of both recordings; errors are standard errors."""

    real: float
    simulated: float
    real_error: float = 0.0
    simulated_error: float = 0.0
    difference_error: float = 0.0
    degrees: float = 0.0        # of freedom, of the difference; 0: its error cannot be known
    p: float = 1.0              # two-sided, of no difference

    @property
    def factor(self):
        """The half interval of 95 % over the standard error."""
        return float(stats.t.ppf(0.975, min(self.degrees, MOST_DEGREES))) if self.degrees > 0.0 else 0.0


def estimate(real, simulated, same_places, same_pings, seed):
    """The Estimate of two figures. What they share at common places, or in common pings, cancels in the difference."""
    out = Estimate(real.value(), simulated.value())
    if not np.isfinite(out.real + out.simulated):
        return out
    places = min(len(np.unique(figure.places)) for figure in (real, simulated))
    pings = min(len(np.unique(figure.pings)) for figure in (real, simulated))
    of_places = corrected(variances(real, simulated, "places", same_places, seed), places)
    of_pings = np.zeros(3)
    if pings > 1:
        cells = variances(real, simulated, "cells", same_places and same_pings, seed)
        drifting = corrected(variances(real, simulated, "pings", same_pings, seed), pings)
        of_pings = np.maximum(drifting - cells, 0.0)
    errors = np.sqrt(of_places + of_pings)
    out.real_error, out.simulated_error, out.difference_error = map(float, errors)
    if places < FEWEST_PLACES:
        return out
    least = 1e-9 * (abs(out.real) + abs(out.simulated)) + 1e-30
    if out.difference_error < least:
        out.degrees = places - 1.0
        out.p = 1.0 if abs(out.simulated - out.real) <= least else 0.0
        return out
    # Satterthwaite's degrees of freedom.
    parts = of_places[2] ** 2 / degrees_of(real, simulated, same_places, places)
    parts += of_pings[2] ** 2 / (pings - 1.0) if pings > 1 else 0.0
    out.degrees = float(errors[2] ** 4 / parts)
    off = abs(out.simulated - out.real) / out.difference_error
    out.p = float(2.0 * stats.t.sf(off, min(out.degrees, MOST_DEGREES)))
    return out


def corrected(drawn, units):
    """The Bayesian bootstrap of n units has (n - 1) / (n + 1) of the true variance."""
    return drawn * (units + 1.0) / (units - 1.0) if units > 1 else np.zeros(3)


def units_of(figure, kind, pings):
    if kind == "cells":
        return figure.places * pings + figure.pings
    return figure.places if kind == "places" else figure.pings


def variances(real, simulated, kind, is_paired, seed):
    """The variances over draws of the real figure, the simulated one and their difference."""
    pings = 1 + max(figure.pings.max() for figure in (real, simulated))
    units = [units_of(figure, kind, pings) for figure in (real, simulated)]
    known, numbers = np.unique(np.concatenate(units), return_inverse=True)
    numbers = np.split(numbers, [len(units[0])])
    random = np.random.default_rng([seed, ("places", "pings", "cells").index(kind)])
    count = CELL_DRAWS if kind == "cells" else DRAWS
    draws = random.standard_exponential((count, len(known)))
    a = real.drawn(numbers[0], draws)
    b = simulated.drawn(numbers[1], draws if is_paired else random.standard_exponential((count, len(known))))
    return np.array([np.var(x[np.isfinite(x)], ddof=1) if np.isfinite(x).sum() > 1 else 0.0 for x in (a, b, b - a)])


def degrees_of(real, simulated, is_paired, places):
    """The degrees of freedom of a variance to which places contribute unequally: normal contributions x of n equal
    variances have the expectation 3 / (n + 2) of sum(x^4) / sum(x^2)^2. A few bright places then count as few."""
    count = 1 + max(figure.places.max() for figure in (real, simulated))
    changes = []
    for figure in (real, simulated):
        without = figure.drawn(figure.places, 1.0 - np.eye(count)) - figure.value()
        changes.append(np.where(np.isfinite(without), without, 0.0))
    change = changes[1] - changes[0] if is_paired else np.concatenate(changes)
    fourth = np.sum(change ** 4)
    most = places - 1.0
    return float(np.clip(3.0 * np.sum(change ** 2) ** 2 / fourth - 2.0, 1.0, most)) if fourth > 0.0 else most


def exchange_p(pairs, errors, seed):
    """For each pair of figures with common places the probability, if both come from one distribution, that the greatest
    standardised difference is as great as its own (Westfall and Young 1993, step-down). A draw exchanges a place in all
    figures alike, or leaves it, so the level holds for all figures together whatever their distributions."""
    places = 1 + max(figure.places.max() for pair in pairs for figure in pair)
    swaps = np.random.default_rng([seed, 3]).integers(0, 2, (EXCHANGES + 1, places)).astype(float)
    swaps[0] = 0.0
    sizes = np.zeros((len(pairs), EXCHANGES + 1))
    for size, (real, simulated), error in zip(sizes, pairs, errors):
        if error > 0.0:
            one = joined([(real, real.places, 1.0 - swaps), (simulated, simulated.places, swaps)])
            other = joined([(real, real.places, swaps), (simulated, simulated.places, 1.0 - swaps)])
            size[:] = np.nan_to_num(np.abs(other - one) / error, posinf=0.0)
    # From the smallest difference up: each is compared with those that are not larger.
    order = np.argsort(sizes[:, 0], kind="stable")
    greatest = np.maximum.accumulate(sizes[order, 1:], axis=0)
    p = (1.0 + (greatest >= sizes[order, :1]).sum(axis=1)) / (EXCHANGES + 1.0)
    out = np.empty(len(pairs))
    # A figure is no more significant than one with a larger difference.
    out[order] = np.maximum.accumulate(p[::-1])[::-1]
    return out
