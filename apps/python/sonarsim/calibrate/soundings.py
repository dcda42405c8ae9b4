"""The level of soundings and the spread of their ranges, by the angle of incidence, port and starboard together."""
import numpy as np

from .judge import Figure
from .statistics import CalibrationError, bootstrap

ANGLE_STEP_DEG, LEAST_SOUNDINGS, LEAST_ANGLES = 4.0, 100, 6
STRETCHES = 20      # of pings, the units of the bootstrap: neighbours see the same bottom
NOTES = ["transmit level, gain and strength of the bottom cannot be separated: the levels have their sum",
         "no key of the preset changes: the spread depends on how the sonar detects the bottom, which has no key"]


def bends_of(soundings):
    """The second differences of the depth between neighbouring beams, as ranges with the deviation of one range; NaN
    where there is none. Neither heave nor roll nor a plane slope changes them."""
    angle, range_m = soundings.angle_rad.astype(float), soundings.range_m.astype(float)
    depth, across = range_m * np.cos(angle), range_m * np.sin(angle)
    with np.errstate(all="ignore"):
        part = (across[:, 1:-1] - across[:, :-2]) / (across[:, 2:] - across[:, :-2])
    off = depth[:, 1:-1] - (1.0 - part) * depth[:, :-2] - part * depth[:, 2:]
    bend = off / np.sqrt(1.0 + part**2 + (1.0 - part) ** 2) / np.cos(angle[:, 1:-1])
    return np.pad(np.where((part > 0.1) & (part < 0.9), bend, np.nan), ((0, 0), (1, 1)), constant_values=np.nan)


def fit_soundings(recording, slope_rad):
    """Mean angles, and a list of Bounded levels in dB and one of spreads in m at these. `slope_rad` turns the bottom
    about the track, positive down to port."""
    soundings = recording.soundings
    found = np.isfinite(soundings.range_m)
    angle = np.abs(soundings.angle_rad.astype(float) - slope_rad)
    step = np.where(found, np.degrees(angle) / ANGLE_STEP_DEG, 0.0).astype(int)
    stretch = np.broadcast_to(np.arange(len(recording))[:, None] * STRETCHES // len(recording), found.shape)
    power = np.asarray(recording.law.powers(np.where(found, soundings.intensity, 0.0)), float)
    bend, ones, rows = bends_of(soundings), np.ones_like(angle), []
    for number in range(int(step.max(initial=0)) + 1):
        here = found & (step == number)
        sizes = np.abs(np.where(here, bend, np.nan))
        if here.sum() < LEAST_SOUNDINGS or np.isfinite(sizes).sum() < 10 or not np.nanmax(sizes) > 0.0:
            continue
        usable = sizes <= 6.0 * 1.4826 * np.nanmedian(sizes)    # others are outliers
        columns = (here, ones), (here, angle), (here, power), (usable, ones), (usable, bend**2)
        rows.append(np.stack([np.bincount(stretch[of], x[of], STRETCHES) for of, x in columns], axis=1))
    if len(rows) < LEAST_ANGLES:
        raise CalibrationError("fewer than six angles, 4 degrees apart, have 100 soundings: record more pings")
    rows = np.array(rows)

    def estimate(weights):
        count, _, level, bends, squares = np.einsum("du,kuc->cdk", weights, rows)
        return np.concatenate([10.0 * np.log10(level / count), np.sqrt(squares / bends)], axis=1)
    bounded, total = bootstrap(STRETCHES, estimate, draws=40), rows.sum(axis=1)
    return total[:, 1] / total[:, 0], bounded[:len(rows)], bounded[len(rows):]


def soundings_figures(parts, slope_rad):
    """(start, fitted pings, judged pings) of each figure. The fitted pings predict by a line between two angles; the
    start predicts neither the bottom nor its spread."""
    fit, judged = (fit_soundings(part, slope_rad) for part in parts)
    figures = []
    for j, angle in enumerate(judged[0]):
        near = int(np.argmin(np.abs(fit[0] - angle)))
        for name, unit, tolerance, k in (("level", "dB", "dB", 1), ("spread of ranges", "m", 0.15, 2)):
            text = f"{name}, {np.degrees(angle):.0f} degrees, {unit}"
            predicted = float(np.interp(angle, fit[0], [b.value for b in fit[k]]))
            figures.append((Figure(text, tolerance, None, judged[k][j]),
                            Figure(text, tolerance, fit[k][near].value, fit[k][near]),
                            Figure(text, tolerance, predicted, judged[k][j])))
    return figures
