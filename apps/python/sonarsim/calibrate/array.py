"""The receiving array by the correlations of noise or speckle across the beams.

A line array is weighted along x = position / length in [-1/2, 1/2] by p + (1 - p) cos^2(pi x): p = 1 is uniform (side
lobes at -13.3 dB), p = 0.08 is Hamming's (-42 dB)."""
import functools
import typing

import numpy as np
from scipy import optimize

from .statistics import LAGS, Bounded

TAPERS_DB = np.arange(-13.3, -41.0, -0.5)
LEAST_UNITS, MOST_PAIRS = 24, 16
MODEL_ERROR = 0.002     # of a correlation, by the model's interpolation between the columns of its grid
CHI2_95 = 3.84          # chi^2 of one degree of freedom stays below it in 95 of 100 cases


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
    value = pattern(pedestal, np.arange(1.0, 5.0, 0.005))
    null = np.flatnonzero(value[1:] * value[:-1] <= 0.0)[0]
    return 10.0 * np.log10(np.max(value[null + 1:] ** 2))


@functools.lru_cache(256)
def taper(side_lobe_db):
    """The pedestal of the highest side lobe, and the t at which the power is halved."""
    limits = highest_side_lobe_db(0.08), -13.27
    pedestal = 0.08 if side_lobe_db <= limits[0] else 1.0
    if limits[0] < side_lobe_db < limits[1]:
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
    total = ((a * a + 0.5 * b * b) * np.sinc(t) + a * b * (np.sinc(t + 1.0) + np.sinc(t - 1.0))
             + 0.25 * b * b * (np.sinc(t + 2.0) + np.sinc(t - 2.0)))
    return (total / (a * a + 0.5 * b * b)) ** 2


def differences(sines):
    """The differences of sines of beams 1 to LAGS apart, some evenly over the fan."""
    return [np.abs(sines[lag:] - sines[:-lag])[::max(len(sines) // MOST_PAIRS, 1)] for lag in range(1, LAGS + 1)]


def predicted_correlations(beam, sines, statistics):
    """The mean correlations of log powers 1 to LAGS beams apart, by the keys of a beam."""
    array = line_array(np.radians(beam["width_deg"]), beam["side_lobe_db"])
    return np.array([statistics.correlation(beam_correlation(array.pedestal, u * array.wavelengths)).mean()
                     for u in differences(sines)])


def fit_array(seen, covariance, units, sines, statistics):
    """(width in degrees, side lobe in dB) of the array with the least chi^2 on a grid of tapers and lengths. An
    interval covers all arrays whose chi^2 is within 3.84 of the least (profile likelihood; Wilks 1938). None for
    fewer than 24 units."""
    if units < LEAST_UNITS:
        return None
    # The inverse of a covariance from n units is (n - 1) / (n - p - 2) too large (Hartlap 2007).
    inverse = np.linalg.inv(covariance + MODEL_ERROR**2 * np.eye(LAGS)) * (units - LAGS - 2.0) / (units - 1.0)
    designs = [taper(float(db)) for db in TAPERS_DB]
    t = 0.02 * np.arange(801)
    tables = [statistics.correlation(beam_correlation(pedestal, t)) for pedestal, _ in designs]
    apart = differences(sines)

    def chi2(log_lengths):
        out = []
        for table in tables:
            model = [np.interp(np.exp(log_lengths)[:, None] * u, t, table, right=0.0).mean(axis=1) for u in apart]
            off = seen - np.array(model).T
            out.append(np.einsum("ki,ij,kj->k", off, inverse, off))
        return np.array(out)
    coarse = np.arange(np.log(0.5), np.log(5000.0), 0.05)
    fine = coarse[chi2(coarse).min(axis=0).argmin()] + np.arange(-0.6, 0.6, 0.004)
    found = chi2(fine)
    best = np.unravel_index(np.argmin(found), found.shape)
    near = np.nonzero(found <= found[best] + CHI2_95)
    half_power = np.array([design[1] for design in designs])
    width = np.degrees(2.0 * np.arcsin(np.minimum(half_power[:, None] / np.exp(fine), 1.0)))
    return (Bounded(width[best], width[near].min(), width[near].max()),
            Bounded(TAPERS_DB[best[0]], TAPERS_DB[near[0]].min(), TAPERS_DB[near[0]].max()))
