"""Intervals by the bootstrap, and closed forms of the logarithm of the power of speckle and noise."""
import typing

import numpy as np
from scipy import special

DB_OF_E = 10.0 / np.log(10.0)   # a ratio e of powers in dB
LAGS = 8                        # the greatest lag of correlations, in bins and beams


class CalibrationError(ValueError):
    """One sentence: what is wrong and what would be right."""


class Bounded(typing.NamedTuple):
    """A number with the interval that holds the true one in 95 of 100 cases."""

    value: float
    low: float
    high: float

    @classmethod
    def exactly(cls, value):
        return cls(float(value), float(value), float(value))

    @property
    def half_width(self):
        return 0.5 * (self.high - self.low)

    def widened(self, by):
        """The interval with an independent error added to both sides."""
        more = np.hypot(self.half_width, by) - self.half_width
        return Bounded(self.value, self.low - more, self.high + more)

    def scaled(self, factor):
        ends = sorted((factor * self.low, factor * self.high))
        return Bounded(factor * self.value, *ends)

    def holds(self, number):
        return self.low <= number <= self.high

    def __str__(self):
        return f"{self.value:.4g} ({self.low:.4g} to {self.high:.4g})"


def bootstrap(count, estimate, least=0.0, draws=80):
    """The estimates with all weights 1, as a list of Bounded, with 1.96 standard deviations over drawn samples of
    the `count` units to either side and an independent error of `least`. `estimate` takes weights [draw, unit] and
    returns numbers [draw] or [draw, number]. Draws whose number is not finite do not count."""
    weights = np.ones((draws + 1, count))
    if count > 1:
        weights[1:] = np.random.default_rng(1).multinomial(count, np.full(count, 1.0 / count), draws)
    with np.errstate(all="ignore"):
        found = np.asarray(estimate(weights), float).reshape(draws + 1, -1)
        off = np.where(np.isfinite(found), found - found[0], np.nan)
        number = np.maximum(np.isfinite(off).sum(axis=0), 1)
        variance = np.nansum(off**2, axis=0) / number - (np.nansum(off, axis=0) / number) ** 2
    half = np.hypot(1.96 * np.sqrt(np.maximum(variance, 0.0)), least)
    return [Bounded(float(v), float(v - h), float(v + h)) for v, h in zip(found[0], half)]


def sums_by(unit, count, *columns):
    """The sums of columns over the members of each unit, [unit, column]."""
    return np.stack([np.bincount(unit, column, count) for column in columns], axis=1)


class LogStatistics:
    """The logarithm of the mean power P of n independent looks: P is gamma distributed with shape n. A law
    P^(g / 2) or a + b ln P scales and shifts ln P, so its skewness and correlations do not depend on the law."""

    def __init__(self, looks=1):
        self.looks = looks
        self.mean = special.digamma(looks) - np.log(looks)
        self.variance = special.polygamma(1, looks)
        self.skewness = special.polygamma(2, looks) / self.variance**1.5
        self.variation = amplitude_variation(looks)     # of the amplitude, the root of P
        self.excess = np.zeros(2)   # of correlations, at even steps of k2 from 0 to 1, if samples are combined

    def correlation(self, k2):
        """The correlation of ln P where complex amplitudes have the squared correlation k2. Laguerre polynomials
        diagonalise the joint density of both powers (Kibble's bivariate gamma) with the factors k2^j; ln P has the
        coefficients -1 / j, so the covariance is sum k2^j / (j^2 h_j), h_j = binomial(n + j - 1, j)."""
        k2 = np.clip(np.asarray(k2, float), 0.0, 1.0)
        if self.looks == 1:
            of_looks = special.spence(1.0 - k2) / self.variance     # the dilogarithm of k2
        else:
            j = np.arange(1, 400)
            of_looks = (k2[..., None] ** j / (j**2 * special.binom(self.looks + j - 1, j))).sum(-1) / self.variance
        return of_looks + np.interp(k2, np.linspace(0.0, 1.0, len(self.excess)), self.excess)


def amplitude_variation(shape):
    """The coefficient of variation of the root of a gamma distributed power: 0.5227 for shape 1."""
    mean = np.exp(special.gammaln(shape + 0.5) - special.gammaln(shape)) / np.sqrt(shape)
    return np.sqrt(1.0 / mean**2 - 1.0)


# The largest of several correlated samples has no closed form, so sequences are drawn; a result is the closed form of
# single samples plus the drawn difference between combined and single ones. `correlation(lag)` is that of amplitudes,
# lags in samples.

def sampled_statistics(receiver, correlation, bins=80000):
    """The statistics of a receiver that makes one value of several samples."""
    samples, looks = receiver["samples"], receiver["looks"]
    out = LogStatistics(looks)
    if samples == 1:
        return out
    one, other = (drawn_sequences(looks, bins * samples, correlation, seed) for seed in (1, 2))
    whole, single = combined_logs(receiver, one)
    for name, of in (("mean", np.mean), ("variance", np.var), ("skewness", skewness), ("variation", variation_of)):
        setattr(out, name, getattr(out, name) + of(whole) - of(single))
    excess = []
    for k2 in np.linspace(0.0, 1.0, 9):
        mixed = combined_logs(receiver, np.sqrt(k2) * one + np.sqrt(1.0 - k2) * other)
        excess.append(np.corrcoef(whole, mixed[0])[0, 1] - np.corrcoef(single, mixed[1])[0, 1])
    out.excess = np.array(excess)
    return out


def sampled_correlations(receiver, correlation, bins=20000):
    """The correlations of ln P 1 to LAGS bins apart."""
    samples, looks = receiver["samples"], receiver["looks"]
    along = LogStatistics(looks).correlation(correlation(samples * np.arange(1, LAGS + 1)) ** 2)
    if samples == 1:
        return along
    whole, single = combined_logs(receiver, drawn_sequences(looks, bins * samples, correlation, 1))
    return along + [lagged(whole, lag) - lagged(single, lag) for lag in range(1, LAGS + 1)]


def drawn_sequences(looks, count, correlation, seed):
    """Complex normal sequences [look, sample] with a correlation of amplitudes."""
    lags = np.minimum(np.arange(count), count - np.arange(count))
    far = np.where(lags < 64 * LAGS, lags, 0)
    rho = np.where(lags == far, correlation(far), 0.0)
    amplitude = np.sqrt(np.maximum(np.fft.fft(rho).real, 0.0))
    draws = np.random.default_rng(seed)
    white = draws.standard_normal((looks, count)) + 1j * draws.standard_normal((looks, count))
    return np.fft.ifft(amplitude * white, axis=1) * np.sqrt(count / 2.0)


def combined_logs(receiver, looks):
    """The logarithms of the values of bins, and of the first sample of each bin."""
    powers = (np.abs(looks) ** 2).mean(axis=0).reshape(-1, receiver["samples"])
    rule = {"max": lambda p: p.max(axis=1), "mean": lambda p: np.sqrt(p).mean(axis=1) ** 2,
            "rms": lambda p: p.mean(axis=1)}[receiver["combine"]]
    return np.log(rule(powers) + 1e-12), np.log(powers[:, 0] + 1e-12)


def skewness(x):
    return ((x - x.mean()) ** 3).mean() / x.std() ** 3


def variation_of(logs):
    return np.exp(0.5 * logs).std() / np.exp(0.5 * logs).mean()


def lagged(x, lag):
    x = x - x.mean()
    return (x[:-lag] * x[lag:]).mean() / x.var()
