"""Intervals by the bootstrap, and the logarithm of the power of speckle and noise."""
import functools
import typing

import numpy as np
from scipy import special

DB_OF_E = 10.0 / np.log(10.0)   # a ratio e of powers in dB
WIDEST, WIDEST_TVG = 0.3, 10.0  # intervals that a preset may have: over the value; of tvg_log, dB a decade. Chosen
LAGS = 8                        # the greatest lag of correlations, in bins and beams
TERMS = 400                     # of the correlation of ln P


class CalibrationError(ValueError):
    """One sentence: what is wrong and what would be right."""


class Bounded(typing.NamedTuple):
    """A number with the interval that holds the true one in 95 of 100 cases."""
    value: float
    low: float
    high: float

    @property
    def half_width(self):
        return 0.5 * (self.high - self.low)

    def widened(self, by):
        """The interval with an independent error added to both sides."""
        more = np.hypot(self.half_width, by) - self.half_width
        return Bounded(self.value, self.low - more, self.high + more)

    def scaled(self, factor):
        return Bounded(*(factor * number for number in self))

    def __str__(self):
        return f"{self.value:.4g} ({self.low:.4g} to {self.high:.4g})"


def is_too_wide(name, number):
    return number.high - number.low > (WIDEST_TVG if name == "tvg_log" else WIDEST * abs(number.value))


def bootstrap(count, estimate, least=0.0, draws=80):
    """The estimates with all weights 1, as a list of Bounded: 1.96 standard deviations over drawn samples of the
    `count` units to either side, with an independent error of `least`. `estimate` takes weights [draw, unit] and
    returns numbers [draw] or [draw, ...]. Draws whose number is not finite do not count."""
    weights = np.ones((draws + 1, count))
    weights[1:] = np.random.default_rng(1).multinomial(count, np.full(count, 1.0 / count), draws)
    with np.errstate(all="ignore"):
        found = np.asarray(estimate(weights), float).reshape(draws + 1, -1)
        off = np.where(np.isfinite(found), found - found[0], np.nan)
        number = np.maximum(np.isfinite(off).sum(axis=0), 1)
        variance = np.nansum(off**2, axis=0) / number - (np.nansum(off, axis=0) / number) ** 2
    half = np.hypot(1.96 * np.sqrt(np.maximum(variance, 0.0)), least)
    return [Bounded(float(v), float(v - h), float(v + h)) for v, h in zip(found[0], half)]


class LogStatistics:
    """ln P of the delivered power P of speckle of the mean 1: the rank of one sample, whose power x is exponential,
    becomes that rank of the largest (or mean) power of n independent samples, whose logarithm is then multiplied by the
    expansion. A law P^(g / 2) or a + b ln P scales and shifts ln P, which changes no skewness and no correlation."""
    def __init__(self, samples=1.0, combine="max", expansion=1.0):
        self.is_single = samples == 1.0 and expansion == 1.0
        step = 0.005
        x = np.exp(np.arange(-40.0, 4.0, step))
        weight = step * x * np.exp(-x)      # of x in steps of its logarithm

        def log_of(x):
            return expansion * np.log(delivered(x, samples, combine))
        logs = log_of(x)
        mean_power = weight @ np.exp(logs)
        logs -= np.log(mean_power)
        self.mean = weight @ logs
        off = logs - self.mean
        self.variance = weight @ off**2
        self.skewness = weight @ off**3 / self.variance**1.5
        self.variation = np.sqrt((weight @ np.exp(0.5 * logs)) ** -2.0 - 1.0)   # of the root of P: 0.5227 for one sample
        self.sorted = log_of(-np.log1p(-(np.arange(4000) + 0.5) / 4000)) - np.log(mean_power)   # evenly likely
        # Laguerre polynomials L_j diagonalise the joint density of two samples' powers (Kibble's bivariate gamma) with
        # the factors k2^j; ln P of one sample has the coefficients -1 / j.
        shares, before, now = [], np.zeros_like(x), np.ones_like(x)
        for j in range(1, TERMS + 1):
            before, now = now, ((2 * j - 1 - x) * now - (j - 1) * before) / j
            shares.append((weight * off) @ now)
        shares = np.array(shares) ** 2 / self.variance
        powers = np.append(np.arange(1, TERMS + 1), 2 * TERMS)    # the last has what is left
        self.known = 1.0 - np.linspace(1.0, 0.0, 2001) ** 2
        self.correlations = self.known[:, None] ** powers @ np.append(shares, 1.0 - shares.sum())

    def cut_variance(self, shares):
        """The share of the variance that is left where the lowest values, these shares of all, become one value."""
        known = np.linspace(0.0, 0.2, 41)
        left = [np.maximum(self.sorted, np.quantile(self.sorted, share)).var() for share in known]
        return np.interp(shares, known, np.array(left) / left[0])

    def correlation(self, k2):
        """The correlation of ln P where the complex amplitudes of one sample have the squared correlation k2."""
        return np.interp(k2, self.known, self.correlations)


statistics_of = functools.lru_cache(16)(LogStatistics)


def delivered(x, samples, combine):
    """The largest or mean power of some samples that has the rank of the power x of one."""
    if samples == 1.0:
        return x
    below = -np.expm1(-x)
    if combine == "max":
        return -np.log(-np.expm1(np.where(x < 0.7, np.log(below), np.log1p(-np.exp(-np.maximum(x, 0.7)))) / samples))
    return np.where(x < 0.7, special.gammaincinv(samples, below), special.gammainccinv(samples, np.exp(-x))) / samples


def receiver_statistics(receiver):
    return statistics_of(*(receiver[key] for key in ("samples", "combine", "expansion")))
