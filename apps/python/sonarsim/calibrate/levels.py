"""Gain and noise of records: noise, gain and law are applied to echoes of usual scenes until levels are the pings'."""
import numpy as np
from scipy import optimize

from ..compare.images import RING_SHARE
from .scene import BOTTOMS, Echoes, own_mission, usual_mission, view_of
from .statistics import Bounded, delivered, is_too_wide

FULL, MAX_IMAGES, MAX_COLUMNS, RINGS = 255.0, 3, 32, 16
QUANTILES = 0.1, 0.5, 0.9, 0.98
# In dB, of all ranges, and of rings where the scene is seen as the pings see theirs, and where not. Chosen.
LEVEL_ERROR, RING_ERROR, RING_ERROR_USUAL = 0.5, 1.5, 20.0
WIDEST_DB = 40.0    # of an interval of levels: twice what two scenes of one sonar differed by
NUMBERS = {"full_scale_db": 30.0, "noise_db": 30.0, "tvg_log": 10.0}    # deviations from the start


class Records:
    """Records of the echoes of a scene. `numbers`: those of NUMBERS, the first for the law "gamma" or "log"."""

    def __init__(self, echoes, start, seed, mixing=None):
        self.echoes, self.receiver, self.absorption = echoes, start.instrument["receiver"], start.absorption_db_per_m
        normal = np.random.default_rng(seed).standard_normal((2, *echoes.amplitude.shape)).astype(np.float32)
        real, imaginary = normal if mixing is None else normal @ mixing
        self.noise = np.sqrt(0.5) * (real + 1j * imaginary)
        samples, combine, expansion = (self.receiver.get(key, 1.0) for key in ("samples", "combine", "expansion"))
        if (samples, expansion) != (1.0, 1.0):      # the program delivers echoes so
            power = delivered(np.abs(self.noise) ** 2, samples, combine) ** expansion
            self.noise *= np.sqrt(power / power.mean()) / np.abs(self.noise)

    def greys(self, law, numbers):
        """[ping, range, beam], from 0 to 255."""
        scale, full_scale_db, noise_db, tvg_log, _ = numbers
        r = self.echoes.range_m
        gain_db = tvg_log * np.log10(r) + 2.0 * self.absorption * r * self.receiver["tvg_absorption"] - full_scale_db
        noise = np.sqrt(10.0 ** (0.1 * noise_db) + 10.0 ** (0.1 * (self.receiver.get("converter_noise_db", -300.0) - gain_db)))
        amplitude = np.abs(self.echoes.amplitude + noise * self.noise) * 10.0 ** (0.05 * gain_db)
        share = amplitude**scale if law == "gamma" else 1.0 + 20.0 * np.log10(np.maximum(amplitude, 1e-15)) / scale
        return np.floor(FULL * np.clip(np.minimum(share, 1.0) - self.receiver["offset"], 0.0, 1.0) + 0.5)


def levels_of(greys, law, scale):
    """Quantiles and means of the levels in dB of greys [image, range, column], in all ranges and in rings."""
    db = scale * (greys / FULL - 1.0) if law == "log" else 20.0 / scale * np.log10(np.maximum(greys, 0.5) / FULL)
    db = db[:, db.shape[1] // RING_SHARE:]     # without that of the transmit pulse
    return np.array([[*np.quantile(part, QUANTILES), 10.0 * np.log10((10.0 ** (0.1 * part)).mean())]
                     for part in (db, *np.array_split(db, RINGS, axis=1))])


def some_of(images):
    """A few images and columns of many."""
    number, column = (np.unique(np.linspace(0, count - 1, most).astype(int)) for count, most in (
        (len(images), MAX_IMAGES), (images.shape[2], MAX_COLUMNS)))
    return images[number][:, :, column]


def greys_of(recording):
    """The values as greys from 0 to 255, [image, range, column]: pings are the columns of sonars with few beams."""
    values = recording.values * np.float32(FULL / (recording.law.full_value or recording.values.max()))
    return some_of(values if recording.kind == "imaging" else np.stack(
        [values[..., beam].T for beam in range(values.shape[2])]))


def scenes_of(recording, start, mission=None):
    """((mission, name of its sonar, its folder), whether it is seen as the pings see theirs) of scenes."""
    if mission:
        return [((*own_mission(mission, None), mission.absolute().parent), True)]
    view = view_of(recording, start)
    return [((usual_mission(recording.kind, recording.ranges_m[-1], view, bottom), "sonar", None), view is not None)
            for bottom in BOTTOMS]


def records_of(windows, scenes, receiver, settings):
    """(Records, the errors of their levels) of the echoes of scenes, one for each window."""
    out = []
    for (_, own), (scene, is_alike) in zip(windows, scenes):
        echoes = Echoes(own, *scene, settings)
        echoes.amplitude = some_of(echoes.amplitude)
        out.append((Records(echoes, own, 1), np.array([[LEVEL_ERROR]] + RINGS * [[RING_ERROR if is_alike else
                                                                                  RING_ERROR_USUAL]])))
        out[-1][0].receiver = receiver
    return out


def numbers_of(pairs, measured, first, law, scale, known):
    """(numbers, their standard errors) with which Records have the measured levels of their windows."""
    spread = np.array([1e-6 if name in known else deviation for name, deviation in NUMBERS.items()])

    def residuals(z):
        numbers = scale, *(first + (z - 10.0) * spread), 0.0
        off = [((levels_of(records.greys(law, numbers), law, scale) - levels) / errors).ravel()
               for (records, errors), levels in zip(pairs, measured)]
        return np.concatenate([*off, z - 10.0])
    grid = [10.0 + np.array([a, b, 0.0]) for a in np.arange(-1.6, 1.61, 0.4) for b in (-0.7, 0.0, 0.7)]
    begin = grid[int(np.argmin([np.abs(residuals(z)).sum() for z in grid]))]
    found = optimize.least_squares(residuals, begin, diff_step=[0.01, 0.01, 0.03], max_nfev=20)    # greys are whole
    errors = spread * np.sqrt(np.diag(np.linalg.inv(found.jac.T @ found.jac)) * max(2.0 * found.cost / len(found.fun), 1.0))
    return first + (found.x - 10.0) * spread, errors


def is_wide(name, number):
    """True for a number that the levels do not show. The key tvg_log has limits."""
    if name in ("full_scale_db", "noise_db"):
        return number.high - number.low > WIDEST_DB
    return is_too_wide(name, number) or name == "tvg_log" and not 0.0 <= number.value <= 60.0


def fit_levels(windows, start, fit, mission=None, settings=()):
    """Sets gain and noise of a Fit to those with which the echoes of scenes have the levels of the pings. The first scene
    gives the value, all give the interval. `windows`: (recording, start of its shape)."""
    receiver = fit.instrument["receiver"]
    law = "log" if receiver["companding"] == "log" else "gamma"
    scale = {"log": receiver["dynamic_range_db"], "linear": 1.0}.get(receiver["companding"], receiver["gamma"])
    first = np.array([start.full_scale_db, start.noise_db, receiver["tvg_log"]])
    measured = [levels_of(greys_of(one), law, scale) for one, _ in windows]
    scenes = [records_of(windows, of, receiver, settings) for of in zip(*(scenes_of(one, own, mission)
                                                                           for one, own in windows))]
    known, wide = ["tvg_log"] if "receiver.tvg_log" in fit.estimates else [], True
    while wide:
        found = [numbers_of(pairs, measured, first, law, scale, known) for pairs in scenes]
        low = np.min([values - 1.96 * errors for values, errors in found], axis=0)
        high = np.max([values + 1.96 * errors for values, errors in found], axis=0)
        numbers = {name: Bounded(*map(float, ends)) for name, *ends in zip(NUMBERS, found[0][0], low, high)}
        wide = [name for name in numbers if name not in known and is_wide(name, numbers[name])]
        for name in wide:
            fit.estimates.pop(f"receiver.{name}", None)
            receiver[name] = start.instrument["receiver"].get(name)
            fit.notes.append(f"{name}: the levels hardly show it; that of the start is kept")
        known = known + wide
    for name, number in numbers.items():
        if name not in known:
            fit.set(f"receiver.{name}", number)
    if len(known) < len(NUMBERS):
        fit.notes.append("gain and noise are those with which " + ("the mission's scene" if mission else
                     f"a level bottom of {BOTTOMS[0]}") + " has the levels of the pings. The scene decides them, and the law: two "
                     "scenes of one sonar differed by 20 dB; " + ("the intervals are of this scene alone" if mission else
                                                                  f"the intervals hold {', '.join(BOTTOMS)}"))
