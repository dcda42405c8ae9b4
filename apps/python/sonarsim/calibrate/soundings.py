"""The level of the bottom and the spread of the ranges, by the angle of incidence."""
import numpy as np

from .array import LineArray, line_array
from .judge import Figure
from .statistics import CalibrationError, bootstrap

ANGLE_STEP_DEG = 4.0
LEAST_SOUNDINGS = 100
LEAST_ANGLES = 6
STRETCHES = 20      # of pings, the units of the bootstrap: neighbours see the same bottom


def taper_loss(array):
    """The mean of the squared weights over the square of their mean."""
    p, q = array.pedestal, 1.0 - array.pedestal
    return (p * p + p * q + 0.375 * q * q) / (p + 0.5 * q) ** 2


def geometry_db(angle, range_m, instrument, sample_m):
    """The parts of a level besides the strength of the bottom: the insonified area, which the beam or the pulse
    limits, and the spreading that the gain leaves, (40 - tvg_log) log10 r."""
    pulse = instrument["pulse"]
    band: LineArray = line_array(1e-3, pulse["side_lobe_db"])
    pulse_m = taper_loss(band) * (pulse["resolution_m"] or sample_m) / (band.wavelengths * 1e-3)
    width = np.radians(instrument["beam"]["width_deg"])
    across = np.minimum(width * range_m / np.cos(angle), pulse_m / np.maximum(np.sin(angle), 1e-6))
    return 10.0 * np.log10(across * range_m) - (40.0 - instrument["receiver"]["tvg_log"]) * np.log10(range_m)


def bends_of(soundings):
    """The second differences of the depth between neighbouring beams, as ranges with the deviation of one range;
    NaN where there is none. Neither heave nor roll nor a plane slope changes them."""
    angle, range_m = soundings.angle_rad.astype(float), soundings.range_m.astype(float)
    out = np.full(angle.shape, np.nan)
    for k in range(len(angle)):
        # Beams that found no bottom are left out, so the next ones are the neighbours.
        j = np.flatnonzero(np.isfinite(range_m[k]))
        depth, across = range_m[k, j] * np.cos(angle[k, j]), range_m[k, j] * np.sin(angle[k, j])
        if len(j) < 3:
            continue
        with np.errstate(all="ignore"):
            part = (across[1:-1] - across[:-2]) / (across[2:] - across[:-2])
        line = (1.0 - part) * depth[:-2] + part * depth[2:]
        bend = (depth[1:-1] - line) / np.sqrt(1.0 + part**2 + (1.0 - part) ** 2) / np.cos(angle[k, j[1:-1]])
        out[k, j[1:-1]] = np.where((part > 0.1) & (part < 0.9), bend, np.nan)
    return out


def fit_soundings(recording, slope_rad, instrument, sample_m):
    """Mean angles, and Bounded strengths in dB and spreads in m at each, port and starboard together. The strength
    has the level of the sonar in it. `slope_rad` turns the bottom about the track, positive down to port."""
    soundings = recording.soundings
    found = np.isfinite(soundings.range_m)
    angle = np.abs(soundings.angle_rad.astype(float) - slope_rad)
    step = np.where(found, np.degrees(angle) / ANGLE_STEP_DEG, 0.0).astype(int)
    ping = np.broadcast_to(np.arange(len(recording))[:, None] * STRETCHES // len(recording), found.shape)
    power = np.asarray(recording.law.powers(np.where(found, soundings.intensity, 0.0)), float)
    bend = bends_of(soundings)
    rows = []
    for number in range(int(step.max(initial=0)) + 1):
        here = found & (step == number)
        sizes = np.abs(np.where(here, bend, np.nan))
        if here.sum() < LEAST_SOUNDINGS or np.isfinite(sizes).sum() < 10:
            continue
        # Second differences far beyond their median size are outliers.
        usable = here & (sizes <= 6.0 * 1.4826 * np.nanmedian(sizes))
        columns = [(here, np.ones_like(angle)), (here, angle), (here, soundings.range_m), (here, power),
                   (usable, np.ones_like(angle)), (usable, bend**2)]
        sums = np.stack([np.bincount(ping[of], x[of], STRETCHES) for of, x in columns], axis=1)
        if sums[:, 5].sum() > 0.0:
            rows.append(sums)
    if len(rows) < LEAST_ANGLES:
        raise CalibrationError("fewer than six angles, 4 degrees apart, have 100 soundings: record more pings")
    rows = np.array(rows)

    def estimate(weights):
        count, at, range_m, level, bends, squares = np.einsum("du,kuc->cdk", weights, rows)
        strength = 10.0 * np.log10(level / count) - geometry_db(at / count, range_m / count, instrument, sample_m)
        return np.concatenate([strength, np.sqrt(squares / bends)], axis=1)
    bounded = bootstrap(STRETCHES, estimate, draws=40)
    total = rows.sum(axis=1)
    return total[:, 1] / total[:, 0], bounded[:len(rows)], bounded[len(rows):]


def calibrate_soundings(parts, start, slope_rad):
    """The figures of the judged pings with what the fitted ones predict, by a line between the nearest two angles."""
    instrument = start.instrument
    sample_m = start.range_bin_m / instrument["receiver"]["samples"]
    fit, judged = (fit_soundings(part, slope_rad, instrument, sample_m) for part in parts)
    figures = []
    for j, angle in enumerate(judged[0]):
        near = int(np.argmin(np.abs(fit[0] - angle)))
        for name, unit, tolerance, k in (("strength with the level of the sonar", "dB", "dB", 1),
                                         ("spread of ranges", "m", 0.15, 2)):
            text = f"{name}, {np.degrees(angle):.0f} degrees, {unit}"
            predicted = float(np.interp(angle, fit[0], [b.value for b in fit[k]]))
            # The start predicts neither the bottom nor its spread.
            figures.append((Figure(text, tolerance, None, judged[k][j]),
                            Figure(text, tolerance, fit[k][near].value, fit[k][near]),
                            Figure(text, tolerance, predicted, judged[k][j])))
    return figures, [
        "transmit level, gain and strength of the bottom cannot be separated here: the levels have their sum",
        "on a flat bottom range and angle go together: the gain by range and the strength by angle cannot be "
        "separated, so tvg_log is that of the start",
        "the spread of the ranges is a table by angle: it depends on how the sonar detects the bottom, which has no "
        "key. No key of the preset changes"]
