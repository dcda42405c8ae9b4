"""What images or records tell of the instrument that made them: law, noise, pulse, beams and texture, in this order."""
import copy
import dataclasses

import numpy as np

from .array import fit_array, line_array, predicted_correlations
from .judge import classified
from .law import Law, bits_of, chosen_offset, fit_law, fit_offset, full_value_of
from .noise import Noise, find_noise
from .pulse import bins_of, fit_pulse, fit_texture, pulse_of, shape_of_share, steps_on_ground
from .statistics import LAGS, Bounded

LEAST_PATCHES = 24


@dataclasses.dataclass
class Fit:
    instrument: dict            # that of the start with the fitted values
    level_db: float             # of the noise, re full scale
    law: Law | None = None
    offset: Bounded | None = None
    noise: Noise | None = None
    of_echoes: bool = False     # the law is fitted to echoes, for lack of noise
    estimates: dict = dataclasses.field(default_factory=dict)   # key -> Bounded or a word
    notes: list = dataclasses.field(default_factory=list)

    def set(self, key, value):
        """Notes an estimate, and puts it into the instrument."""
        section, name = key.split(".")
        self.instrument[section][name] = value.value if isinstance(value, Bounded) else value
        self.estimates[key] = value


def fit_image(recording, start):
    """Fits pings. CalibrationError for values that are not from a sonar."""
    fit = Fit(copy.deepcopy(start.instrument), start.noise_db - start.full_scale_db)
    fit_laws(recording, start, fit)
    texture = fit_pulse_and_beams(recording, fit)
    if texture and fit.of_echoes:
        # The law took the variance of the texture for speckle.
        factor = np.sqrt(1.0 - min(texture.value, 0.9))
        error = 0.5 * texture.half_width / factor**2
        scale = fit.law.scale.scaled(1.0 / factor if fit.law.is_log else factor)
        fit.law.scale = scale.widened(error * scale.value)
        fit.noise = find_noise(recording, fit.law, start.absorption_db_per_m)
    set_law(recording, fit)
    set_levels(start, fit)
    fit.notes += ["beam.aberration_rad, elevation_width_deg and elevation_side_lobe_db are not estimated: they need "
                  "echoes of points, or surfaces of known strength",
                  "receiver.samples, receiver.looks and receiver.common_mode_db are those of the start"]
    return fit


def fit_laws(recording, start, fit):
    """Fits law and offset to all patches, finds the noise, and fits them again to the patches of noise: these are
    surely Rayleigh distributed, an even patch of echoes may hold a texture."""
    values, full = recording.values, full_value_of(recording)
    receiver = fit.instrument["receiver"]
    bins = bins_of(fit.instrument, recording.range_step_m)
    statistics = pulse_of(fit.instrument, "noise").statistics(bins)
    of_start = receiver["offset"]
    fit.offset = chosen_offset(values, full, of_start)
    fit.law = fit_law(values, full, statistics, None, fit.offset.value if fit.offset else of_start)
    if fit.law.is_log:
        # Under a logarithm deviations do not grow with the mean, so the fitted offset is far off.
        fit.offset = None
        fit.law = fit_law(values, full, statistics, None, of_start)
    fit.noise = find_noise(recording, fit.law, start.absorption_db_per_m)
    patches, noise, echoes = classified(recording, fit.law, fit.noise)
    fit.of_echoes = len(noise) < LEAST_PATCHES
    places = None
    if not fit.of_echoes:
        places = np.bincount(patches.place[noise], minlength=patches.places) > 0
    elif fit.noise is None:
        places = whole_places(patches, fit.law)
    if receiver["samples"] > 1:
        # The statistics depend on the pulse; no law changes the correlations to which it is fitted.
        chosen = echoes if fit.of_echoes else noise
        pulse = pulse_of(fit.instrument, "echo" if fit.of_echoes else "noise")
        width = fit_pulse(patches, chosen, pulse) if len(chosen) >= LEAST_PATCHES else None
        statistics = pulse.statistics(width.value if width else bins)
    if fit.offset and not fit.of_echoes:
        # Noise has one shape at all levels. If its offset is another one, it decides.
        own = fit_offset(values, full, places)
        if own and not (own.low <= fit.offset.high and fit.offset.low <= own.high):
            fit.offset = chosen_offset(values, full, of_start, places)
    offset = fit.offset.value if fit.offset else of_start
    fit.law = fit_law(values, full, statistics, places, offset, fit.law.is_log)
    if fit.of_echoes and receiver["samples"] > 1:
        # Even patches may be noise as well as echoes, whose variances differ.
        of_noise = pulse_of(fit.instrument, "noise").statistics(bins).variance
        share = abs(np.sqrt(of_noise / statistics.variance) - 1.0)
        fit.law.scale = fit.law.scale.widened(share * fit.law.scale.value)
    fit.noise = find_noise(recording, fit.law, start.absorption_db_per_m)


def whole_places(patches, law):
    """The places with hardly any values of 0, or None for all. A patch must not be chosen by its own zeros."""
    sums = patches.sums(np.arange(len(patches.place)), np.ones(len(patches.place)), patches.mean)
    whole = ~law.cuts_off(np.exp(sums[:, 1] / sums[:, 0] - law.statistics.mean))
    return whole if sums[whole, 0].sum() >= 2 * LEAST_PATCHES else None


def fit_pulse_and_beams(recording, fit):
    """Sets pulse, beams and texture, and returns the share of the texture or None."""
    patches, noise, echoes = classified(recording, fit.law, fit.noise)
    of_echoes = len(noise) < LEAST_PATCHES
    chosen = echoes if of_echoes else noise
    if len(chosen) < LEAST_PATCHES:
        fit.notes.append("pulse and beams: too few patches of noise or of even echoes")
        return None
    pulse = pulse_of(fit.instrument, "echo" if of_echoes else "noise")
    width = fit_pulse(patches, chosen, pulse)
    if width is None:
        fit.notes.append("pulse: neighbouring bins are not correlated, so it is shorter than a bin, and its length "
                         "cannot be measured; that of the start is kept")
    elif fit.noise is None:
        other = fit_pulse(patches, chosen, pulse_of(fit.instrument, "noise"))
        width = Bounded(width.value, min(width.low, other.low), max(width.high, other.high))
        fit.notes.append("pulse.resolution_m: noise and echoes cannot be separated here, so the interval holds the "
                         "pulses of both")
    sines = np.zeros(0) if recording.bearing_rad is None else np.sin(recording.bearing_rad)
    if len(sines) > LAGS:
        fit_beams(patches, chosen, of_echoes, sines, fit)
    texture = None
    # If pulse and law are fitted to noise, the texture does not affect them.
    if width and fit.noise and of_echoes:
        texture = texture_of(recording, patches, echoes, sines, pulse, fit)
        width = texture[2] if texture else width
    if width:
        fit.set("pulse.resolution_m", width.scaled(recording.range_step_m))
    return texture and texture[0]


def fit_beams(patches, chosen, of_echoes, sines, fit):
    found = fit_array(*patches.beam_covariance(chosen, not of_echoes), sines, fit.law.statistics)
    if found is None:
        fit.notes.append("beams: too few places of even echoes; width and taper are those of the start")
        return
    fit.set("beam.width_deg", found[0])
    fit.set("beam.side_lobe_db", found[1])
    if found[1].high - found[1].low > 8.0:
        fit.notes.append("beam.width_deg and beam.side_lobe_db can hardly be separated here: the two belong together")


def texture_of(recording, patches, echoes, sines, pulse, fit):
    """Fits the texture of echoes, with their pulse without the texture."""
    beam, statistics = fit.instrument["beam"], fit.law.statistics
    steps_m = steps_on_ground(recording, patches, echoes)
    of_beams = np.zeros(LAGS)
    if len(sines) > LAGS:
        array = line_array(np.radians(beam["width_deg"]), beam["side_lobe_db"])
        of_beams = predicted_correlations(array, sines, statistics)
    texture = fit_texture(patches, echoes, pulse, steps_m, of_beams)
    if texture is None:
        return None
    share, edge_m, _ = texture
    fit.set("speckle.clutter_shape", Bounded(*(shape_of_share(s, statistics)
                                               for s in (share.value, share.high, share.low))))
    fit.set("speckle.clutter_m", edge_m)
    fit.notes.append("speckle.clutter_shape and clutter_m are those of this bottom, not of the sonar")
    if recording.altitude_m is None:
        fit.notes.append("speckle.clutter_m: without altitude_m in the recording lengths on the ground are taken as "
                         "slant ranges")
    return texture


def set_law(recording, fit):
    law = fit.law
    bits = bits_of(recording.values, law.full_value) if recording.law.full_value else None
    if bits and 8 <= bits <= 16:
        fit.set("receiver.bits", bits)
    else:
        fit.notes.append("receiver.bits: the recording has no largest value of 8 to 16 bits, or its values are not "
                         "whole steps of it; those of the start are kept")
    fit.set("receiver.companding", "log" if law.is_log else "gamma")
    if law.is_log:
        fit.notes.append("receiver.offset: after a logarithm it is one with full_scale_db; that of the start is kept")
    elif fit.offset is None:
        fit.notes.append("receiver.offset: patches of one level do not tell it; that of the start is kept")
    else:
        fit.set("receiver.offset", fit.offset)
        # A greater offset raises all values and lowers gamma.
        scale, by = law.scale, law.scale.value / law.mean_share
        law.scale = Bounded(scale.value,
                            scale.value - np.hypot(scale.value - scale.low, by * (fit.offset.high - fit.offset.value)),
                            scale.value + np.hypot(scale.high - scale.value, by * (fit.offset.value - fit.offset.low)))
    fit.set("receiver.dynamic_range_db" if law.is_log else "receiver.gamma", law.scale)


def set_levels(start, fit):
    """Sets gain and levels by the noise. Pings show only differences of levels, so full_scale_db is fitted."""
    noise, law = fit.noise, fit.law
    if noise is None:
        fit.notes.append("noise and gain: no rows show noise alone (without zeros, even over the beams, on one law of "
                         "range); noise_db, full_scale_db and tvg_log are those of the start")
        return
    # An error of the law scales all levels below full scale, and the gain with them.
    share = law.scale.half_width / law.scale.value
    near, far = noise.used.range_m[[0, -1]]
    growth = (noise.at(far) - noise.at(near)) / np.log10(far / near)
    level = noise.level_db.widened(share * noise.level_db.value)
    fit.set("receiver.tvg_log", noise.tvg_log.widened(share * growth))
    if noise.tvg_from_m.value > 0.0:
        fit.set("receiver.tvg_from_m", noise.tvg_from_m)
    fit.instrument["receiver"].update(tvg_absorption=True, tvg_from_m=noise.tvg_from_m.value, noise_db=start.noise_db)
    fit.level_db = level.value
    fit.set("receiver.full_scale_db",
            Bounded(start.noise_db - level.value, start.noise_db - level.high, start.noise_db - level.low))
    fit.notes += ["tvg_log and the absorption of the water cannot be separated here: tvg_log is for the water of the "
                  "start",
                  "noise_db, full_scale_db and source_level_db cannot be separated here: the pings have their "
                  "differences; noise_db and source_level_db are those of the start, and full_scale_db is fitted to "
                  "them",
                  "transmit level and strength of the bottom cannot be separated here: echoes have their sum"]
