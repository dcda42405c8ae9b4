"""The pulse by the correlation along range, and a texture of the bottom by correlations along range and beams."""
import dataclasses
import functools

import numpy as np
from scipy import interpolate, linalg, optimize, special

from .array import line_array, line_pattern
from .statistics import LAGS, bootstrap, sampled_correlations, sampled_statistics

LEAST_CORRELATION = 0.04
LEAST_SHARE_OF_WIDTH = {False: 0.01, True: 0.025}   # the least error of a pulse; True: of drawn correlations
MOST_LEFT = 0.05            # a texture that leaves more of a correlation unexplained is rejected
EDGES, HALF_PATCH = 24, 12.0    # tried edges of its squares, from 1 to 12 bins


@dataclasses.dataclass(eq=False)
class Pulse:
    """The effect of a pulse on values. `kind`: "noise" after the matched filter has the spectrum |S|^2, an "echo" of
    many scatterers |S|^4. With speckle of the scene an echo is shared between two bins before the pulse; with speckle
    of the ping ("echo of bins") amplitudes are drawn for whole bins."""

    receiver: dict
    side_lobe_db: float
    kind: str

    def statistics(self, bins):
        return sampled_statistics(self.receiver, self.amplitude(bins))

    def correlations(self, bins):
        """The correlations of log powers 1 to LAGS bins apart."""
        return sampled_correlations(self.receiver, self.amplitude(bins))

    def amplitude(self, bins):
        """The correlation of complex amplitudes as a function of the lag in samples."""
        in_samples = bins * self.receiver["samples"]
        if self.kind == "noise":
            # It is as high as the compressed pulse at that distance from its peak.
            array = line_array(1e-3, self.side_lobe_db)
            return lambda lag: line_pattern(array, np.asarray(lag) / in_samples * 1e-3)
        taps = echo_taps(in_samples, self.side_lobe_db, self.kind == "echo")
        whole = np.append(np.correlate(taps, taps, "full")[len(taps) - 1:] / (taps @ taps), 0.0)
        return lambda lag: whole[np.minimum(lag, len(whole) - 1)]

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


def bins_of(instrument, range_step_m):
    return instrument["pulse"]["resolution_m"] / range_step_m or 1.0


def echo_taps(bins, side_lobe_db, shared):
    """The amplitudes at whole bins whose linear spline is nearest to the pulse, as the model spreads echoes. An echo
    that is shared between two bins in proportion to its closeness has on average the products 1/6, 2/3, 1/6, as
    fixed shares with the sum 1 and the product 1/6 have."""
    reach = int(np.clip(np.ceil(3.0 * bins), 2, 64))
    x, m = np.arange(-63, 64) / 64.0, np.arange(-reach, reach + 1)
    pulse = line_pattern(line_array(1e-3, side_lobe_db), (m[:, None] + x) / bins * 1e-3)
    band = np.tile([[1.0 / 6.0], [2.0 / 3.0], [1.0 / 6.0]], len(m))
    taps = linalg.solve_banded((1, 1), band, pulse @ (1.0 - np.abs(x)) / 64.0)
    share = 0.5 + 0.5 / np.sqrt(3.0)
    return np.convolve(taps, [share, 1.0 - share]) if shared else taps


def fit_pulse(patches, chosen, pulse):
    """The half-power width in bins; None if neighbouring bins are not correlated: the pulse is shorter than a bin."""
    correlations = patches.correlations(chosen)
    seen = correlations(np.ones((1, patches.places)))[0, 0]
    if seen[0] < LEAST_CORRELATION:
        return None
    bins, rows = pulse.table
    rows = rows[:, np.isfinite(seen)]

    def width(weights):
        seen = correlations(weights)[:, 0, :rows.shape[1]]
        return bins[((rows**2).sum(axis=1) - 2.0 * seen @ rows.T).argmin(axis=1)]
    found = bootstrap(patches.places, width)[0]
    return found.widened(LEAST_SHARE_OF_WIDTH[pulse.receiver["samples"] > 1] * found.value)


# A texture as speckle.clutter_shape and clutter_m make it: gamma distributed strengths in squares of the scene. ln P
# is the sum of the logarithms of speckle and strength; the texture has the share trigamma(shape) / (trigamma(shape) +
# the variance of speckle) of its variance, and places a distance d apart lie in one square of the edge e in a share
# 1 - d / e of all cases.

def texture_share(speckle, statistics):
    own = special.polygamma(1, speckle["clutter_shape"]) if speckle["clutter_shape"] > 0.0 else 0.0
    return own / (own + statistics.variance)


def shape_of_share(share, statistics):
    """The shape that gives a texture this share."""
    share = min(max(share, 0.001), 0.95)
    return np.exp(optimize.brentq(
        lambda x: texture_share({"clutter_shape": np.exp(x)}, statistics) - share, -7.0, 9.0))


def with_texture(of_speckle, distance_m, share, edge_m):
    return (1.0 - share) * of_speckle + share * np.maximum(1.0 - distance_m / edge_m, 0.0)


def steps_on_ground(recording, patches, echoes):
    """The mean distances of bins and of beams on a flat bottom at the recording's altitude."""
    if not len(echoes):
        return recording.range_step_m, 0.0
    at = recording.first_range_m + (patches.row[echoes] + 0.5 * patches.shape[0]) * recording.range_step_m
    # Straight below no length of the ground belongs to a bin.
    stretch = np.mean(np.maximum(1.0 - ((recording.altitude_m or 0.0) / at) ** 2, 0.1) ** -0.5)
    sines = np.zeros(1) if recording.bearing_rad is None else np.sin(recording.bearing_rad)
    return recording.range_step_m * stretch, at.mean() * np.ptp(sines) / max(len(sines) - 1, 1)


def fit_texture(patches, echoes, pulse, steps_m, of_beams):
    """(share, edge in m, pulse in bins) by least squares over a grid of edges and pulses; None where the share lies
    less than 3.3 standard errors off 0, or where the correlations are not those of a texture."""
    bins, rows = (of[::5] for of in pulse.table)
    edges = steps_m[0] * np.linspace(1.0, HALF_PATCH, EDGES)
    axes = 2 if steps_m[1] > 0.0 else 1
    squares = np.maximum(1.0 - np.outer(steps_m[:axes], np.arange(1, LAGS + 1)) / edges[:, None, None], 0.0)
    own = np.hstack([rows, np.broadcast_to(of_beams, rows.shape)][:axes])
    t = (squares.reshape(EDGES, 1, -1) - own).reshape(-1, axes * LAGS)       # [edge and pulse, lag]
    own, norm = np.tile(own, (EDGES, 1)), (t**2).sum(axis=1, keepdims=True)
    correlations = patches.correlations(echoes)

    def estimate(weights):
        # Least squares of seen - own = share (squares - own), with own the speckle's correlation.
        seen = correlations(weights)[:, :axes].reshape(len(weights), -1).T
        ty = t @ seen - (t * own).sum(axis=1, keepdims=True)
        share = np.maximum(ty / norm, 0.0)
        error = (seen**2).sum(axis=0) - 2.0 * own @ seen + (own**2).sum(axis=1, keepdims=True) - share * ty
        best, draw = error.argmin(axis=0), np.arange(len(weights))
        left = np.sqrt(np.maximum(error[best, draw], 0.0) / (axes * LAGS))
        return np.stack([share[best, draw], edges[best // len(bins)], bins[best % len(bins)], left], axis=1)
    found = bootstrap(patches.places, estimate, [0.0, edges[1] - edges[0], bins[1] - bins[0], 0.0])
    share, left = found[0], found[3]
    return None if share.value < 3.3 * share.half_width / 1.96 or left.value > MOST_LEFT else found[:3]
