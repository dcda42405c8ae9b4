"""Intervals by the bootstrap, and the logarithm of the power of speckle and noise in closed form."""
import typing

import numpy as np
from scipy import linalg, special

DB_OF_E = 10.0 / np.log(10.0)   # a ratio e of powers in dB
WIDEST = 0.3                    # interval of a number over its value that a preset may have
LAGS = 8                        # the greatest lag of correlations, in bins and beams


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
    """ln P of the mean power P of n independent looks, which is gamma distributed with shape n. A law P^(g / 2) or
    a + b ln P scales and shifts ln P, so its skewness and its correlations do not depend on the law."""
    def __init__(self, looks=1):
        self.looks = looks
        self.mean = special.digamma(looks) - np.log(looks)
        self.variance = special.polygamma(1, looks)
        self.skewness = special.polygamma(2, looks) / self.variance**1.5
        # Of the root of a gamma distributed power: 0.5227 for one look.
        self.variation = np.sqrt(looks * np.exp(2.0 * (special.gammaln(looks) - special.gammaln(looks + 0.5))) - 1.0)
        self.excess = np.zeros(2)   # of the correlation at even steps of k2, where samples are combined
        self.sorted = np.log(special.gammaincinv(looks, (np.arange(4000) + 0.5) / 4000) / looks)    # ln P, evenly likely

    def cut_variance(self, shares):
        """The share of the variance that is left where the lowest values, these shares of all, become one value."""
        known = np.linspace(0.0, 0.2, 41)
        left = [np.maximum(self.sorted, np.quantile(self.sorted, share)).var() for share in known]
        return np.interp(shares, known, np.array(left) / left[0])

    def correlation(self, k2):
        """The correlation of ln P where complex amplitudes have the squared correlation k2. Laguerre polynomials
        diagonalise the joint density of both powers (Kibble's bivariate gamma) with the factors k2^j; ln P has the
        coefficients -1 / j, so the covariance is sum k2^j / (j^2 h_j), h_j = binomial(n + j - 1, j)."""
        k2 = np.clip(np.asarray(k2, float), 0.0, 1.0)
        if self.looks == 1:
            covariance = special.spence(1.0 - k2)   # the dilogarithm of k2
        else:
            j = np.arange(1, 400)
            covariance = (k2[..., None] ** j / (j**2 * special.binom(self.looks + j - 1, j))).sum(axis=-1)
        excess = np.interp(k2, np.linspace(0.0, 1.0, len(self.excess)), self.excess)
        return covariance / special.polygamma(1, self.looks) + excess


# Several correlated samples that become one value have no closed form: a result is that of single samples plus a drawn
# difference between combined and single ones. `amplitude(lag)` is the correlation of complex amplitudes, in samples.

def sampled_statistics(receiver, amplitude, count=120000):
    """The statistics of the values of a receiver."""
    out = LogStatistics(receiver["looks"])
    if receiver["samples"] == 1:
        return out
    one, other = (drawn(receiver, amplitude, 1, count, seed) for seed in (1, 2))
    (whole,), (single,) = pair = combined(receiver, one)
    out.sorted = np.sort(whole)[::10]
    out.mean += whole.mean() - single.mean()
    out.variance += whole.var() - single.var()
    out.skewness += np.subtract(*(((x - x.mean()) ** 3).mean() / x.std() ** 3 for x in pair))
    out.variation += np.subtract(*(np.exp(0.5 * x).std() / np.exp(0.5 * x).mean() for x in pair))
    mixed = [combined(receiver, np.sqrt(k2) * one + np.sqrt(1.0 - k2) * other) for k2 in np.linspace(0.0, 1.0, 17)]
    out.excess = np.array([np.corrcoef(whole, m)[0, 1] - np.corrcoef(single, s)[0, 1] for m, s in mixed])
    return out


def sampled_correlations(receiver, amplitude, count=6000):
    """The correlations of ln P 1 to LAGS bins apart."""
    lags = np.arange(1, LAGS + 1)
    along = LogStatistics(receiver["looks"]).correlation(amplitude(receiver["samples"] * lags) ** 2)
    if receiver["samples"] == 1:
        return along
    pair = combined(receiver, drawn(receiver, amplitude, LAGS + 1, count, 1))
    return along + [np.subtract(*(np.corrcoef(x[:-k].ravel(), x[k:].ravel())[0, 1] for x in pair)) for k in lags]


def drawn(receiver, amplitude, bins, count, seed):
    """Complex normal samples [look, sample, draw] of some bins."""
    size = bins * receiver["samples"]
    root = np.linalg.cholesky(linalg.toeplitz(amplitude(np.arange(size))) + 1e-9 * np.eye(size))
    draws = np.random.default_rng(seed).standard_normal((2, receiver["looks"], size, count))
    return root @ draws[0] + 1j * (root @ draws[1])


def combined(receiver, looks):
    """ln P of the values of bins, [bin, draw], and of the first sample of each bin."""
    powers = (looks.real**2 + looks.imag**2).mean(axis=0)
    powers = powers.reshape(-1, receiver["samples"], powers.shape[1]) + 1e-12
    rule = {"max": lambda: powers.max(axis=1), "mean": lambda: np.sqrt(powers).mean(axis=1) ** 2,
            "rms": lambda: powers.mean(axis=1)}[receiver["combine"]]
    return np.log(rule()), np.log(powers[:, 0])
