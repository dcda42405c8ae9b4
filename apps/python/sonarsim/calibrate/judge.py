"""The figures by which an instrument is judged: what it predicts in closed form, and what pings show under its law."""
import typing

import numpy as np

from .array import line_array, predicted_correlations
from .law import full_value_of, stated_law
from .noise import Noise, noise_blocks
from .patches import Patches
from .pulse import bins_of, pulse_of, steps_on_ground, texture_share, with_texture
from .statistics import DB_OF_E, LAGS, Bounded, amplitude_variation, bootstrap

LEAST_PATCHES = 12
LEAST_ECHO_DB = 6.0
DRAWS = 40


class Figure(typing.NamedTuple):
    name: str
    tolerance: object       # "dB": 1 dB; "correlation": 0.05; a share
    predicted: float | None
    measured: Bounded

    @property
    def agrees(self):
        if self.predicted is None:
            return False
        most = {"dB": 1.0, "correlation": 0.05}.get(self.tolerance) or self.tolerance * abs(self.measured.value)
        return abs(self.predicted - self.measured.value) <= most


def classified(recording, law, noise):
    """(patches of log powers less the level of the noise, numbers of noise patches, of echo patches). Patches are
    noise if all their rows are blocks of `noise` without echoes and zeros, except for those straight ahead. Even
    patches 6 dB above the noise are echoes; without `noise`, all even ones."""
    level = (noise.at(recording.ranges_m) if noise else np.zeros(recording.values.shape[1]))[:, None] / DB_OF_E
    patches = Patches(recording.values, law.full_value, lambda ping: law.log_power(ping) - level)
    is_noise = np.zeros(len(patches.place), bool)
    if noise and noise.used is not None:
        rows = np.zeros(recording.values.shape[1] + 8, bool)
        for row in noise.used.row[noise.used.without_echo & noise.used.without_zeros]:
            rows[row:row + 8] = True
        in_blocks = np.array([rows[row:row + patches.shape[0]].all() for row in range(len(rows))])
        is_noise = in_blocks[patches.row]
        if noise.ahead is not None:
            held = np.array([noise.ahead[b:b + patches.shape[1]].any() for b in range(len(noise.ahead))])
            is_noise &= ~held[patches.beam]
    chosen = patches.without_uneven(np.flatnonzero(is_noise))   # particles are bright points in some
    echoes = patches.even(6.0 if law.full_value > 15.0 else 0.0)
    if noise:
        echoes = echoes[DB_OF_E * (patches.mean[echoes] - law.statistics.mean) > LEAST_ECHO_DB]
    return patches, chosen, echoes


def figures_of(recording, instrument, level_db, absorption, of_fit):
    """The figures of noise and of echoes. `of_fit` defines the blocks and beams that count as noise. Figures that
    the pings do not determine are left out."""
    receiver = instrument["receiver"]
    bins = bins_of(instrument, recording.range_step_m)
    pulse = pulse_of(instrument, "noise")
    law = stated_law(receiver, full_value_of(recording), pulse.statistics(bins))
    noise = Noise(Bounded.exactly(level_db), Bounded.exactly(receiver["tvg_log"]),
                  Bounded.exactly(receiver["tvg_from_m"]), absorption if receiver["tvg_absorption"] else 0.0,
                  of_fit and of_fit.used, of_fit and of_fit.ahead)
    patches, of_noise, echoes = classified(recording, law, noise)
    out = []
    if len(of_noise) >= LEAST_PATCHES:
        still = dict(instrument, speckle=dict(instrument["speckle"], clutter_shape=0.0))
        out += figures_of_class("noise", recording, still, law, noise, patches, of_noise, echoes, pulse)
        out += noise_levels(recording, law, noise)
    if len(echoes) >= LEAST_PATCHES:
        out += figures_of_class("echoes", recording, instrument, law, noise, patches, echoes, echoes,
                                pulse_of(instrument, "echo"))
    return out


def figures_of_class(where, recording, instrument, law, noise, patches, chosen, echoes, pulse):
    """The distribution of amplitudes and the correlations of one class of patches."""
    bins = bins_of(instrument, recording.range_step_m)
    speckle, statistics = instrument["speckle"], pulse.statistics(bins)
    share, edge = texture_share(speckle, statistics), speckle["clutter_m"]
    variation = statistics.variation
    if share > 0.0:     # the mean squares of independent factors multiply
        variation = np.sqrt((1.0 + variation**2) * (1.0 + amplitude_variation(speckle["clutter_shape"]) ** 2) - 1.0)
    level = noise.at(recording.ranges_m)[:, None] / DB_OF_E
    amplitudes = Patches(recording.values, law.full_value, lambda ping: np.exp(0.5 * (law.log_power(ping) - level)))
    ones = np.ones(len(patches.place))
    sums = patches.sums(chosen, ones, np.sqrt(amplitudes.variance) / amplitudes.mean, patches.variance)
    to_shape = 2.0 * np.pi / np.sqrt(6.0)

    def distribution(weights):
        count, coefficient, variance = (weights @ sums).T
        return np.stack([coefficient / count, to_shape / np.sqrt(variance / count)], axis=1)
    measured = bootstrap(patches.places, distribution, draws=DRAWS)
    out = [Figure(f"{where}: variation of the amplitude", 0.1, float(variation), measured[0]),
           Figure(f"{where}: Weibull shape of the amplitude", 0.1,
                  float(to_shape / np.sqrt(statistics.variance / (1.0 - share))), measured[1])]
    steps_m = steps_on_ground(recording, patches, echoes)
    measured = bootstrap(patches.places, patches.correlations(chosen), draws=DRAWS)
    predicted = [pulse.correlations(bins)]
    if recording.bearing_rad is not None and len(recording.bearing_rad) > LAGS:
        beam = instrument["beam"]
        array = line_array(np.radians(beam["width_deg"]), beam["side_lobe_db"])
        predicted.append(predicted_correlations(array, np.sin(recording.bearing_rad), statistics))
    for axis, of_speckle in enumerate(predicted):
        for lag in (1, 2, 4):
            expected = with_texture(of_speckle[lag - 1], lag * steps_m[axis], share, edge)
            out.append(Figure(f"{where}: correlation {lag} {('bins', 'beams')[axis]} apart", "correlation",
                              float(expected), measured[axis * LAGS + lag - 1]))
    return [figure for figure in out if np.isfinite(figure.measured.value)]


def noise_levels(recording, law, noise):
    """The level of the noise in the nearest, middle and farthest third of its blocks."""
    blocks = noise_blocks(recording, law, noise.ahead)
    out = []
    # A single ping does not show the noise below a constant echo.
    usable = noise.used.without_echo
    for name, third in zip(("near", "middle", "far"), np.array_split(np.arange(len(usable)), 3)):
        rows = noise.used.row[third[usable[third]]]
        here = np.isin(blocks.row, rows)
        if here.any():
            level = blocks.level_db[here]
            measured = bootstrap(len(level), lambda w: w @ level / w.sum(axis=1))[0]
            out.append(Figure(f"noise: level by full scale, {name}, dB", "dB",
                              float(noise.at(blocks.range_m[here]).mean()), measured))
    return out
