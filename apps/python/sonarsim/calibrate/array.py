"""The receiving array by the correlations of noise or speckle across the beams.

A line array is weighted along x = position / length in [-1/2, 1/2] by p + (1 - p) cos^2(pi x): p = 1 is uniform (side
lobes at -13.3 dB), p = 0.08 is Hamming's (-42 dB)."""
import functools
import typing

import numpy as np
from scipy import optimize

from .statistics import LAGS, Bounded

NO_TAPER_DB, LEAST_TAPER_DB, TAPER_STEP_DB = -13.3, -41.0, 0.5
LEAST_UNITS = 24
MOST_PAIRS = 16
# The error by the model's interpolation between the columns of its grid.
MODEL_ERROR = 0.002
CHI2_95 = 3.84      # chi^2 of one degree of freedom stays below it in 95 of 100 cases


class LineArray(typing.NamedTuple):
    wavelengths: float      # length over wavelength
    pedestal: float         # p


def pattern(pedestal, t):
    """The amplitude at t = sine of the angle x length / wavelength: the Fourier transform of the weights."""
    cosine = 0.5 * (np.sinc(t) + 0.5 * (np.sinc(t + 1.0) + np.sinc(t - 1.0)))
    return (pedestal * np.sinc(t) + (1.0 - pedestal) * cosine) / (0.5 * (1.0 + pedestal))


def line_pattern(array, u):
    return pattern(array.pedestal, np.asarray(u) * array.wavelengths)


def highest_side_lobe_db(pedestal):
    t = np.arange(1.0, 5.0, 0.005)
    value = pattern(pedestal, t)
    null = np.flatnonzero(value[1:] * value[:-1] <= 0.0)[0]
    return 10.0 * np.log10(np.max(value[null + 1:] ** 2))


@functools.lru_cache(256)
def taper(side_lobe_db):
    """The pedestal of the highest side lobe, and the t at which the power is halved."""
    if side_lobe_db >= -13.27:
        pedestal = 1.0
    elif side_lobe_db <= highest_side_lobe_db(0.08):
        pedestal = 0.08
    else:
        pedestal = optimize.brentq(lambda p: highest_side_lobe_db(p) - side_lobe_db, 0.08, 1.0)
    return pedestal, optimize.brentq(lambda t: pattern(pedestal, t) ** 2 - 0.5, 0.0, 1.0)


def line_array(width_rad, side_lobe_db):
    """The array with this highest side lobe and half-power width."""
    pedestal, half_power = taper(float(side_lobe_db))
    return LineArray(half_power / np.sin(0.5 * width_rad), pedestal)


def beam_correlation(pedestal, t):
    """The squared correlation of the amplitudes of two beams t apart: elements have independent noise, so it is the
    Fourier transform of the squared weights. Phase errors cancel, and speckle has the same correlation."""
    a, b = 0.5 * (1.0 + pedestal), 0.5 * (1.0 - pedestal)
    even = a * a + 0.5 * b * b
    total = (even * np.sinc(t) + a * b * (np.sinc(t + 1.0) + np.sinc(t - 1.0))
             + 0.25 * b * b * (np.sinc(t + 2.0) + np.sinc(t - 2.0)))
    return (total / even) ** 2


def differences(sines):
    """The differences of sines of beams 1 to LAGS apart, some evenly over the fan."""
    step = max(len(sines) // MOST_PAIRS, 1)
    return [np.abs(sines[lag:] - sines[:-lag])[::step] for lag in range(1, LAGS + 1)]


def predicted_correlations(array, sines, statistics):
    """The mean correlations of log powers 1 to LAGS beams apart."""
    return np.array([statistics.correlation(beam_correlation(array.pedestal, u * array.wavelengths)).mean()
                     for u in differences(sines)])


def fit_array(seen, covariance, units, sines, statistics):
    """(width in degrees, side lobe in dB) of the array with the least chi^2 on a grid of tapers and lengths. An
    interval covers all arrays whose chi^2 is within 3.84 of the least (profile likelihood; Wilks 1938). None for
    fewer than 24 units."""
    if units < LEAST_UNITS:
        return None
    covariance = covariance + MODEL_ERROR**2 * np.eye(LAGS)
    # The inverse of a covariance from n units is (n - 1) / (n - p - 2) too large (Hartlap 2007).
    inverse = (units - LAGS - 2.0) / (units - 1.0) * np.linalg.inv(covariance)
    tapers = np.arange(NO_TAPER_DB, LEAST_TAPER_DB - 1e-9, -TAPER_STEP_DB)
    table_t = 0.02 * np.arange(801)
    tables = [statistics.correlation(beam_correlation(taper(float(db))[0], table_t)) for db in tapers]
    apart = differences(sines)

    def chi2(log_lengths):
        out = []
        for table in tables:
            model = [np.interp(np.exp(log_lengths)[:, None] * u, table_t, table, right=0.0).mean(axis=1) for u in apart]
            off = seen - np.array(model).T
            out.append(np.einsum("ki,ij,kj->k", off, inverse, off))
        return np.array(out)
    coarse = np.arange(np.log(0.5), np.log(5000.0), 0.05)
    middle = coarse[np.unravel_index(np.argmin(chi2(coarse)), (len(tapers), len(coarse)))[1]]
    fine = middle + np.arange(-0.6, 0.6, 0.004)
    found = chi2(fine)
    best = np.unravel_index(np.argmin(found), found.shape)
    near = np.nonzero(found <= found[best] + CHI2_95)
    half_power = np.array([taper(float(db))[1] for db in tapers])
    width = np.degrees(2.0 * np.arcsin(np.minimum(half_power[:, None] / np.exp(fine), 1.0)))
    return (Bounded(width[best], width[near].min(), width[near].max()),
            Bounded(tapers[best[0]], tapers[near[0]].min(), tapers[near[0]].max()))
