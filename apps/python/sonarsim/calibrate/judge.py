"""The figures by which an instrument is judged: what it predicts in closed form, and what pings show under its law. A
rendered pass of the start and of the fit beside the judged pings, and the fits that are not written."""
import dataclasses
import typing

import numpy as np

from ..compare.bootstrap import tolerance_of
from ..compare.comparison import measure_both
from ..compare.figure import value_of
from .correlations import predicted_correlations, pulse_of
from .law import full_value_of, stated_law
from .levels import scenes_of
from .noise import ROWS, Noise, noise_blocks
from .patches import Patches
from .scene import pass_of, with_shape
from .statistics import DB_OF_E, LAGS, Bounded, CalibrationError, bootstrap, receiver_statistics

MIN_PATCHES, MIN_ECHO_DB, DRAWS = 12, 6.0, 40
MAX_WHITE = 0.05            # of a rendered pass


class Figure(typing.NamedTuple):
    name: str
    tolerance: object       # "dB": 1 dB; "correlation": 0.05; a share
    predicted: float | None
    measured: Bounded

    @property
    def most(self):
        return {"dB": 1.0, "correlation": 0.05}.get(self.tolerance) or self.tolerance * abs(self.measured.value)

    @property
    def is_known(self):
        """True if the pings determine the figure within its tolerance."""
        return self.tolerance == "dB" or self.measured.half_width <= self.most

    @property
    def agrees(self):
        return self.predicted is not None and abs(self.predicted - self.measured.value) <= self.most


def classified(recording, law, noise):
    """(patches of log powers less the level of the noise, numbers of noise patches, of echo patches). Patches are
    noise if all their rows are blocks of `noise` without echoes and zeros. Even patches 6 dB above the noise, or without `noise` all, are echoes."""
    level = (noise.at(recording.ranges_m) if noise else np.zeros(recording.values.shape[1]))[:, None] / DB_OF_E
    patches = Patches(recording.values, law.full_value, lambda ping: law.log_power(ping) - level)
    is_noise = np.zeros(len(patches.place), bool)
    if noise and noise.used is not None:
        rows = noise.used.row[noise.used.without_echo & noise.used.without_zeros]
        is_noise = np.all([np.isin(patches.row + k, rows) for k in range(0, patches.shape[0], ROWS)], axis=0)
    chosen, echoes = np.flatnonzero(is_noise), patches.even()
    if len(chosen):
        # Some have bright particles. Of one level the variance of four means exceeds four times its median in 2.4 %.
        chosen = chosen[patches.unevenness[chosen] <= 4.0 * np.median(patches.unevenness[chosen])]
    if noise:
        echoes = echoes[DB_OF_E * (patches.mean[echoes] - law.statistics.mean) > MIN_ECHO_DB]
    return patches, chosen, echoes


def figures_of(recording, instrument, level_db, start, fit):
    """The figures of noise and of echoes, where the pings determine them. `fit` has the blocks of noise."""
    receiver, bins = instrument["receiver"], instrument["pulse"]["resolution_m"] / recording.range_step_m or 1.0
    statistics = receiver_statistics(receiver)
    law = stated_law(receiver, full_value_of(recording), statistics)
    noise = Noise(Bounded(*3 * [level_db]), Bounded(*3 * [receiver["tvg_log"]]), receiver["tvg_from_m"],
                  start.absorption_db_per_m if receiver["tvg_absorption"] else 0.0, fit.noise and fit.noise.used)
    patches, noise_part, echoes = classified(recording, law, noise)
    to_shape, out = 2.0 * np.pi / np.sqrt(6.0), []
    of = Patches(recording.values, law.full_value, lambda ping: np.exp(
        0.5 * (law.log_power(ping) - noise.at(recording.ranges_m)[:, None] / DB_OF_E)))
    columns = np.ones(len(patches.place)), np.sqrt(of.variance) / of.mean, patches.variance
    for where, kind, chosen in (("noise", "noise", noise_part), ("echoes", "echo", echoes)):
        if len(chosen) < MIN_PATCHES:
            continue
        pulse, sums = pulse_of(instrument, kind), patches.sums(chosen, *columns)

        def distribution(weights, sums=sums):
            count, coefficient, variance = (weights @ sums).T
            return np.stack([coefficient / count, to_shape / np.sqrt(variance / count)], axis=1)
        measured = bootstrap(patches.places, distribution, draws=DRAWS)
        out += [Figure(f"{where}: variation of the amplitude", 0.1, float(statistics.variation), measured[0]),
                Figure(f"{where}: Weibull shape of the amplitude", 0.1, to_shape / statistics.variance**0.5, measured[1])]
        measured = bootstrap(patches.places, patches.correlations(chosen), draws=DRAWS)
        predicted = [pulse.correlations(bins)]
        if recording.bearing_rad is not None and len(recording.bearing_rad) > LAGS:
            predicted.append(predicted_correlations(instrument["beam"], np.sin(recording.bearing_rad), statistics))
        for axis, speckle_part in enumerate(predicted):
            out += [Figure(f"{where}: correlation {lag} {('bins', 'beams')[axis]} apart", "correlation",
                           float(speckle_part[lag - 1]), measured[axis * LAGS + lag - 1]) for lag in (1, 2, 4)]
        if kind == "noise":
            out += noise_levels(recording, law, noise)
    out = [figure for figure in out if np.isfinite(figure.measured.value)]
    return [figure for figure in out if figure.is_known] or out


def noise_levels(recording, law, noise):
    """The level of the noise in the nearest, middle and farthest third of its blocks."""
    blocks, count, out = noise_blocks(recording, law), len(noise.used), []
    for k, name in enumerate(("near", "middle", "far")):
        third = noise.used[k * count // 3:(k + 1) * count // 3]
        here = np.isin(blocks.row, third.row[third.without_echo])   # one ping does not show noise below an echo
        if here.any():
            level = blocks.level_db[here]
            measured = bootstrap(len(level), lambda w: w @ level / w.sum(axis=1))[0]
            out.append(Figure(f"noise: level by full scale, {name}, dB", "dB",
                              float(noise.at(blocks.range_m[here]).mean()), measured))
    return out


def rows_beside(judged, simulated):
    """(group, figure, judged, simulated, agrees) of each figure of the judged pings, NaN where the other has none. Values
    of both are taken by the law of the judged pings, so the law of the instrument counts as well as its gain."""
    full = simulated.law.full_value
    simulated = dataclasses.replace(simulated, law=dataclasses.replace(judged.law, full_value=full if judged.law.full_value
                                                                       else 0.0))
    _, _, measured = measure_both((judged, simulated), judged.law.full_value == 0.0, False)
    others, rows = {figure.name: figure for figure in measured[1]}, []
    for figure in measured[0]:
        real, other = value_of(figure), value_of(others[figure.name]) if figure.name in others else np.nan
        if np.isfinite(real):
            rows.append((figure.group, figure.name, real, other, abs(other - real) <= tolerance_of(figure.tolerance, real)))
    return rows


@dataclasses.dataclass
class Judged:
    """A rendered pass for each window. `agree`: the figures that agree with the fitted and with the judged pings."""
    rows: list              # of rows_beside() the judged pings, for each window
    agree: tuple
    white: float            # the largest share of a pass


def judge(windows, text, mission=None, settings=()):
    """Renders a pass with the text of a preset for each window: (start of its shape, (fitted pings, judged pings))."""
    rows, white = [], 0.0
    for start, parts in windows:
        (scene, _), *_ = scenes_of(parts[1], start, mission)
        one = pass_of(start, with_shape(start, text), *scene, settings)
        rows.append([rows_beside(part, one) for part in parts])
        white = max(white, float((one.values >= one.law.full_value - 0.5).mean()))
    agree = tuple(sum(row[4] for window in rows for row in window[k]) for k in (0, 1))
    return Judged([window[1] for window in rows], agree, white)


def is_worse(fit, start, part):
    """True for a pass that is white, or in which fewer figures agree with the fitted (0) or judged (1) pings."""
    return fit.white > MAX_WHITE or fit.agree[part] < start.agree[part]


def check_judged(fit, start, lacks):
    """CalibrationError for a fit that is not to be written. `lacks`: what the recording lacks."""
    figures = sum(len(window) for window in fit.rows)
    lacks = "the recording lacks " + (", ".join(lacks) or "a scene like the rendered one: name one by --mission")
    if fit.white > MAX_WHITE:
        raise CalibrationError(f"{fit.white:.0%} of a pass that is rendered with the fit is white, so it is not written: {lacks}")
    if is_worse(fit, start, 1) or fit.agree[1] == start.agree[1] < 0.5 * figures:
        raise CalibrationError(f"{fit.agree[1]} of {figures} figures of a pass that is rendered with the fit agree with the "
                               f"judged pings, and {start.agree[1]} with the start, so it is not written: {lacks}")
