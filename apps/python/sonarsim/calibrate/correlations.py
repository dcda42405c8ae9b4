"""Pulse and array by the correlations of log powers along range and beams.

An array, or the band of a pulse, is weighted along x = position / length in [-1/2, 1/2] by p + (1 - p) cos^2(pi x):
p = 1 is uniform (side lobes at -13.3 dB), p = 0.08 is Hamming's (-42 dB)."""
import dataclasses
import functools

import numpy as np
from scipy import interpolate, linalg, optimize

from .statistics import LAGS, Bounded, bootstrap, receiver_statistics

TAPERS_DB = np.arange(-13.3, -41.0, -0.5)
MIN_UNITS, MAX_PAIRS = 24, 16
CHI2_95 = 3.84          # chi^2 of one degree of freedom stays below it in 95 of 100 cases
# Of correlations: the error of the model between the columns of its grid, and the least that shows a pulse.
MODEL_ERROR, MIN_CORRELATION = 0.002, 0.04


def pattern(pedestal, t):
    """The Fourier transform of the weights: the amplitude at t = sine of the angle x length / wavelength."""
    cosine = 0.5 * (np.sinc(t) + 0.5 * (np.sinc(t + 1.0) + np.sinc(t - 1.0)))
    return (pedestal * np.sinc(t) + (1.0 - pedestal) * cosine) / (0.5 * (1.0 + pedestal))


def highest_side_lobe_db(pedestal):
    value = pattern(pedestal, np.arange(1.0, 5.0, 0.005))
    return 10.0 * np.log10(np.max(value[np.flatnonzero(value[1:] * value[:-1] <= 0.0)[0] + 1:] ** 2))


@functools.lru_cache(256)
def taper(side_lobe_db):
    """The pedestal of the highest side lobe, and the t at which the power is halved."""
    limits = highest_side_lobe_db(0.08), -13.27
    pedestal = 0.08 if side_lobe_db <= limits[0] else 1.0
    if limits[0] < side_lobe_db < limits[1]:
        pedestal = optimize.brentq(lambda p: highest_side_lobe_db(p) - side_lobe_db, 0.08, 1.0)
    return pedestal, optimize.brentq(lambda t: pattern(pedestal, t) ** 2 - 0.5, 0.0, 1.0)


@dataclasses.dataclass(eq=False)
class Pulse:
    """The effect of a pulse on values. `kind`: "noise" has the spectrum |S|^2, an "echo" of many scatterers |S|^4. An
    echo is shared between two bins before the pulse; "echo of bins": speckle of the ping is drawn for whole bins."""
    receiver: dict
    side_lobe_db: float
    kind: str

    def correlations(self, bins):
        """The correlations of ln P 1 to LAGS bins apart."""
        taps = taps_of(bins, self.side_lobe_db, self.kind)
        whole = np.pad(np.correlate(taps, taps, "full")[len(taps):] / (taps @ taps), (0, LAGS))[:LAGS]
        return receiver_statistics(self.receiver).correlation(whole**2)

    @functools.cached_property
    def table(self):
        """Widths in bins, and the correlations that they predict, [width, lag]."""
        bins = np.linspace(0.6, 8.0, 75)
        rows = interpolate.CubicSpline(bins, [self.correlations(b) for b in bins])
        fine = np.linspace(0.6, 8.0, 741)
        return fine, rows(fine)


def pulse_of(instrument, kind):
    if kind == "echo" and instrument["speckle"]["mode"] != "scene":
        kind = "echo of bins"
    return Pulse(instrument["receiver"], instrument["pulse"]["side_lobe_db"], kind)


def pulse_at(widths, side_lobe_db):
    """The amplitude of the compressed pulse some half-power widths off its peak."""
    pedestal, half_power = taper(side_lobe_db)
    return pattern(pedestal, 2.0 * half_power * widths)


def taps_of(bins, side_lobe_db, kind):
    """The amplitudes at whole bins with which the model filters white noise, or spreads echoes."""
    reach = int(np.clip(np.ceil(3.0 * bins), 2, 8192))
    if kind == "noise":
        # Noise is correlated as high as the compressed pulse is. A thousandth of the energy at the ends is left out.
        lags = np.fft.ifftshift(np.abs(np.arange(-max(1024, 4 * reach), max(1024, 4 * reach))))
        spectrum = np.fft.fft(pulse_at(lags / max(bins, 0.1), side_lobe_db)).real
        taps = np.roll(np.fft.ifft(np.sqrt(np.maximum(spectrum, 0.0))).real, reach)[:2 * reach + 1]
        cut = int((2.0 * np.cumsum(taps[:reach] ** 2) <= 1e-3 * (taps @ taps)).sum())
        return taps[cut:len(taps) - cut]
    # The linear spline that is nearest to the pulse.
    x, m = np.arange(-63, 64) / 64.0, np.arange(-reach, reach + 1)
    band = np.tile([[1.0 / 6.0], [2.0 / 3.0], [1.0 / 6.0]], len(m))
    pulse = pulse_at((m[:, None] + x) / bins, side_lobe_db)
    taps = linalg.solve_banded((1, 1), band, pulse @ (1.0 - np.abs(x)) / 64.0)
    # An echo that is shared between two bins in proportion to its closeness has on average the products 1/6, 2/3, 1/6,
    # as fixed shares with the sum 1 and the product 1/6 have.
    share = 0.5 + 0.5 / np.sqrt(3.0)
    return np.convolve(taps, [share, 1.0 - share]) if kind == "echo" else taps


def fit_pulse(patches, chosen, pulse):
    """The half-power width in bins; None if neighbouring bins are not correlated: the pulse is shorter than a bin."""
    correlations = patches.correlations(chosen)
    measured = correlations(np.ones((1, patches.places)))[0, 0]
    if measured[0] < MIN_CORRELATION:
        return None
    bins, rows = pulse.table
    rows = rows[:, np.isfinite(measured)]

    def width(weights):
        measured = correlations(weights)[:, 0, :rows.shape[1]]
        return bins[((rows**2).sum(axis=1) - 2.0 * measured @ rows.T).argmin(axis=1)]
    found = bootstrap(patches.places, width)[0]
    return found.widened(0.01 * found.value)


def beam_correlation(pedestal, t):
    """The squared correlation of the amplitudes of two beams t apart: elements have independent noise, so it is the
    Fourier transform of the squared weights. Phase errors cancel, and speckle has the same correlation."""
    a, b = 0.5 * (1.0 + pedestal), 0.5 * (1.0 - pedestal)
    total = ((a * a + 0.5 * b * b) * np.sinc(t) + a * b * (np.sinc(t + 1.0) + np.sinc(t - 1.0))
             + 0.25 * b * b * (np.sinc(t + 2.0) + np.sinc(t - 2.0)))
    return (total / (a * a + 0.5 * b * b)) ** 2


def differences(sines):
    """The differences of sines of beams 1 to LAGS apart, some evenly over the fan."""
    return [np.abs(sines[lag:] - sines[:-lag])[::max(len(sines) // MAX_PAIRS, 1)] for lag in range(1, LAGS + 1)]


def predicted_correlations(beam, sines, statistics):
    """The mean correlations of log powers 1 to LAGS beams apart, by the keys of a beam."""
    pedestal, half_power = taper(beam["side_lobe_db"])
    wavelengths = half_power / np.sin(0.5 * np.radians(beam["width_deg"]))
    return np.array([statistics.correlation(beam_correlation(pedestal, u * wavelengths)).mean() for u in differences(sines)])


def fit_array(measured, covariance, units, sines, statistics):
    """(width in degrees, side lobe in dB) of the array with the least chi^2 on a grid of tapers and lengths; intervals cover
    chi^2 within 3.84 of the least (profile likelihood; Wilks 1938). None for fewer than 24 units."""
    if units < MIN_UNITS:
        return None
    # The inverse of a covariance from n units is (n - 1) / (n - p - 2) too large (Hartlap 2007).
    inverse = np.linalg.inv(covariance + MODEL_ERROR**2 * np.eye(LAGS)) * (units - LAGS - 2.0) / (units - 1.0)
    designs = [taper(db) for db in TAPERS_DB]
    t = 0.02 * np.arange(801)
    tables = [statistics.correlation(beam_correlation(pedestal, t)) for pedestal, _ in designs]
    apart = differences(sines)

    def chi2(log_lengths):
        out = []
        for table in tables:
            model = [np.interp(np.exp(log_lengths)[:, None] * u, t, table, right=0.0).mean(axis=1) for u in apart]
            off = measured - np.array(model).T
            out.append(np.einsum("ki,ij,kj->k", off, inverse, off))
        return np.array(out)
    coarse = np.arange(np.log(0.5), np.log(5000.0), 0.05)
    fine = coarse[chi2(coarse).min(axis=0).argmin()] + np.arange(-0.6, 0.6, 0.004)
    found = chi2(fine)
    best = np.unravel_index(np.argmin(found), found.shape)
    near = np.nonzero(found <= found[best] + CHI2_95)
    half_power = np.array(designs)[:, 1:]
    width = np.degrees(2.0 * np.arcsin(np.minimum(half_power / np.exp(fine), 1.0)))
    return (Bounded(width[best], width[near].min(), width[near].max()),
            Bounded(TAPERS_DB[best[0]], TAPERS_DB[near[0]].min(), TAPERS_DB[near[0]].max()))
