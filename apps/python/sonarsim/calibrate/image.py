"""What images or records tell of the instrument that made them: law, noise, pulse, beams and texture, in this order."""
import copy
import dataclasses

import numpy as np

from .array import fit_array, predicted_correlations
from .judge import classified
from .law import Law, bits_of, fit_law, full_value_of
from .noise import Noise, find_noise
from .pulse import bins_of, fit_pulse, fit_texture, pulse_of, shape_of_share, steps_on_ground
from .statistics import LAGS, Bounded

LEAST_PATCHES = 24


@dataclasses.dataclass
class Fit:
    instrument: dict            # that of the start with the fitted values
    level_db: float             # of the noise, re full scale
    law: Law | None = None
    noise: Noise | None = None
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

    def find():
        fit.noise = find_noise(recording, fit.law, start.absorption_db_per_m, fit.instrument["receiver"]["tvg_from_m"])
    of_echoes = fit_laws(recording, fit, find)
    texture = fit_pulse_and_beams(recording, fit)
    if texture and of_echoes:
        # The law took the variance of the texture for speckle.
        factor = np.sqrt(1.0 - min(texture[0].value, 0.9))
        scale = fit.law.scale.scaled(1.0 / factor if fit.law.is_log else factor)
        fit.law.scale = scale.widened(0.5 * texture[0].half_width / factor**2 * scale.value)
        find()
    bits = bits_of(recording.values, fit.law.full_value) if recording.law.full_value else None
    if bits and 8 <= bits <= 16:
        fit.set("receiver.bits", bits)
    fit.set("receiver.companding", "log" if fit.law.is_log else "gamma")
    fit.set("receiver.dynamic_range_db" if fit.law.is_log else "receiver.gamma", fit.law.scale)
    set_levels(start, fit)
    return fit


def fit_laws(recording, fit, find):
    """Fits the law to all patches, finds the noise, and fits the law again to the patches of noise: these are surely
    Rayleigh distributed, an even patch of echoes may hold a texture. True if there is too little noise."""
    values, full, receiver = recording.values, full_value_of(recording), fit.instrument["receiver"]
    bins, offset = bins_of(fit.instrument, recording.range_step_m), receiver["offset"]
    statistics = pulse_of(fit.instrument, "noise").statistics(bins)
    fit.law = fit_law(values, full, statistics, None, offset)
    find()
    patches, noise, echoes = classified(recording, fit.law, fit.noise)
    of_echoes, places = len(noise) < LEAST_PATCHES, None
    if not of_echoes:
        places = np.bincount(patches.place[noise], minlength=patches.places) > 0
    elif fit.noise is None:
        places = whole_places(patches, fit.law)
    if receiver["samples"] > 1:
        # The statistics depend on the pulse; no law changes the correlations to which it is fitted.
        chosen, pulse = echoes if of_echoes else noise, pulse_of(fit.instrument, "echo" if of_echoes else "noise")
        width = fit_pulse(patches, chosen, pulse) if len(chosen) >= LEAST_PATCHES else None
        statistics = pulse.statistics(width.value if width else bins)
    fit.law = fit_law(values, full, statistics, places, offset, fit.law.is_log)
    find()
    return of_echoes


def whole_places(patches, law):
    """The places with hardly any values of 0, or None for all. A patch must not be chosen by its own zeros."""
    count, mean = patches.sums(np.arange(len(patches.place)), np.ones(len(patches.place)), patches.mean).T
    whole = ~law.cuts_off(np.exp(mean / count - law.statistics.mean))
    return whole if count[whole].sum() >= 2 * LEAST_PATCHES else None


def fit_pulse_and_beams(recording, fit):
    """Sets pulse, beams and texture, and returns the texture or None."""
    patches, noise, echoes = classified(recording, fit.law, fit.noise)
    of_echoes, texture = len(noise) < LEAST_PATCHES, None
    chosen = echoes if of_echoes else noise
    if len(chosen) < LEAST_PATCHES:
        fit.notes.append("pulse and beams: too few patches of noise or of even echoes; those of the start are kept")
        return None
    pulse = pulse_of(fit.instrument, "echo" if of_echoes else "noise")
    width = fit_pulse(patches, chosen, pulse)
    if width is None:
        fit.notes.append("pulse.resolution_m: neighbouring bins are not correlated, so the pulse is shorter than a bin; "
                         "that of the start is kept")
    elif fit.noise is None:
        other = fit_pulse(patches, chosen, pulse_of(fit.instrument, "noise"))
        width = Bounded(width.value, min(width.low, other.low), max(width.high, other.high))
        fit.notes.append("pulse.resolution_m: noise and echoes cannot be told apart, so the interval holds the pulses "
                         "of both")
    sines = np.zeros(0) if recording.bearing_rad is None else np.sin(recording.bearing_rad)
    if len(sines) > LAGS:
        fit_beams(patches.beam_covariance(chosen, not of_echoes), sines, fit)
    # If pulse and law are fitted to noise, the texture does not affect them.
    if width and fit.noise and of_echoes:
        texture = texture_of(recording, patches, echoes, sines, pulse, fit)
    if width:
        fit.set("pulse.resolution_m", (texture[2] if texture else width).scaled(recording.range_step_m))
    return texture


def fit_beams(seen, sines, fit):
    found = fit_array(*seen, sines, fit.law.statistics)
    if found is None:
        fit.notes.append("beams: too few places of even echoes; width and taper are those of the start")
        return
    fit.set("beam.width_deg", found[0])
    fit.set("beam.side_lobe_db", found[1])
    if found[1].high - found[1].low > 8.0:
        fit.notes.append("beam.width_deg and beam.side_lobe_db can hardly be separated: the two belong together")


def texture_of(recording, patches, echoes, sines, pulse, fit):
    """Fits the texture of echoes, with their pulse without the texture."""
    statistics = fit.law.statistics
    of_beams = predicted_correlations(fit.instrument["beam"], sines, statistics) if len(sines) > LAGS else np.zeros(LAGS)
    texture = fit_texture(patches, echoes, pulse, steps_on_ground(recording, patches, echoes), of_beams)
    if texture is None:
        return None
    share, edge_m, _ = texture
    fit.set("speckle.clutter_shape", Bounded(*(float(shape_of_share(s, statistics))
                                               for s in (share.value, share.high, share.low))))
    fit.set("speckle.clutter_m", edge_m)
    fit.notes.append("speckle.clutter_shape and clutter_m are those of this bottom, not of the sonar")
    if recording.altitude_m is None:
        fit.notes.append("speckle.clutter_m: the recording has no altitude_m, so lengths on the ground are slant ranges")
    return texture


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
    level = noise.level_db.widened(share * noise.level_db.value)
    growth = (noise.at(far) - noise.at(near)) / np.log10(far / near)
    fit.set("receiver.tvg_log", noise.tvg_log.widened(share * growth))
    fit.instrument["receiver"]["tvg_absorption"] = True
    fit.level_db = level.value
    fit.set("receiver.full_scale_db", Bounded(*(start.noise_db - x for x in (level.value, level.high, level.low))))
    fit.notes.append("full_scale_db is fitted to noise_db and source_level_db of the start, tvg_log to the absorption "
                     "of its water: pings show only differences")
