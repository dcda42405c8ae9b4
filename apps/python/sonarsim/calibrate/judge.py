"""The figures by which an instrument is judged: what it predicts in closed form, and what pings show under its law."""
import typing

import numpy as np

from .correlations import predicted_correlations, pulse_of
from .law import full_value_of, stated_law
from .noise import ROWS, Noise, noise_blocks
from .patches import Patches
from .statistics import DB_OF_E, LAGS, Bounded, bootstrap, receiver_statistics

MIN_PATCHES, MIN_ECHO_DB, DRAWS = 12, 6.0, 40


class Figure(typing.NamedTuple):
    name: str
    tolerance: object       # "dB": 1 dB; "correlation": 0.05; a share
    predicted: float | None
    measured: Bounded

    @property
    def agrees(self):
        most = {"dB": 1.0, "correlation": 0.05}.get(self.tolerance) or self.tolerance * abs(self.measured.value)
        return self.predicted is not None and abs(self.predicted - self.measured.value) <= most


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
        # Particles are bright points in some. The variance of four means of one level exceeds four times its median
        # in 2.4 % of the patches.
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
                  start.absorption_db_per_m if receiver["tvg_absorption"] else 0.0,
                  fit.noise and fit.noise.used)
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
    return [figure for figure in out if np.isfinite(figure.measured.value)]


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
