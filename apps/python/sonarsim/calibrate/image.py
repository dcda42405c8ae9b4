"""What images or records tell of the instrument that made them: law, noise, pulse and beams, in this order."""
import copy
import dataclasses

import numpy as np

from .correlations import fit_array, fit_pulse, pulse_of
from .judge import classified
from .law import FewPatches, Law, fit_law, full_value_of
from .noise import Noise, fit_noise, noise_blocks
from .statistics import LAGS, Bounded, is_too_wide, receiver_statistics

MIN_PATCHES = 24
DECIBELS = "receiver.full_scale_db", "receiver.noise_db", "beam.side_lobe_db"   # they have no share of themselves


@dataclasses.dataclass
class Fit:
    instrument: dict            # that of the start with the fitted values
    level_db: float             # of the noise, re full scale
    law: Law | None = None
    noise: Noise | None = None
    estimates: dict = dataclasses.field(default_factory=dict)   # key -> Bounded or a word
    notes: list = dataclasses.field(default_factory=list)
    lacks: list = dataclasses.field(default_factory=list)   # what the recording lacks, for a refusal
    start: dict | None = None   # the instrument of the start

    def set(self, key, value):
        """Notes an estimate, and puts it into the instrument."""
        section, name = key.split(".")
        self.instrument[section][name] = value.value if isinstance(value, Bounded) else value
        self.estimates[key] = value


def fit_image(recording, start):
    """Fits pings. CalibrationError for values that are not from a sonar."""
    fit = Fit(copy.deepcopy(start.instrument), start.noise_db - start.full_scale_db, start=start.instrument)
    bits = np.log2(recording.law.full_value + 1.0)
    if bits in range(8, 17):
        fit.set("receiver.bits", int(bits))
    try:
        fit_laws(recording, fit, start.absorption_db_per_m)
    except FewPatches as fault:
        fit.lacks.append("even patches of speckle between the ends of the scale")
        if not recording.law.full_value:
            raise
        state_law(fit, recording.law, str(fault))
        return fit
    fit_pulse_and_beams(recording, fit)
    key = "receiver.dynamic_range_db" if fit.law.is_log else "receiver.gamma"
    fit.set("receiver.companding", "log" if fit.law.is_log else "gamma")
    fit.set(key, fit.law.scale)
    set_levels(start, fit)
    drop_wide(fit, start.noise_db - start.full_scale_db)
    if key not in fit.estimates:
        state_law(fit, recording.law, "the pings hardly show the law")
    return fit


def drop_wide(fit, level_at_start):
    """Takes the numbers out of a fit whose interval is too wide. `level_at_start`: of the noise."""
    for key, number in [*fit.estimates.items()]:
        if isinstance(number, Bounded) and key not in DECIBELS and is_too_wide(key.split(".")[1], number):
            section, name = key.split(".")
            del fit.estimates[key]
            fit.instrument[section][name] = fit.start[section].get(name)
            fit.lacks.append(f"what shows {name} well")
            fit.notes.append(f"{key}: the interval {number.low:.4g} to {number.high:.4g} is too wide; that of the start is kept")
            if name == "tvg_log" and fit.estimates.pop("receiver.full_scale_db", None):     # it holds for that growth alone
                fit.level_db = level_at_start
                fit.instrument["receiver"].update((key, fit.start["receiver"].get(key)) for key in ("full_scale_db", "tvg_absorption"))
                fit.notes = [note for note in fit.notes if not note.startswith("full_scale_db is fitted")]


def joined(fits):
    """One Fit of a sonar's windows: means weighted by 1 / variance; an interval also holds half of what they differ by."""
    whole = fits[0]
    for other in fits[1:]:
        whole.notes += [note for note in other.notes if note not in whole.notes]
        whole.lacks += [lack for lack in other.lacks if lack not in whole.lacks]
    for key in sorted({key for fit in fits for key in fit.estimates}):
        found = [fit.estimates[key] for fit in fits if key in fit.estimates]
        if not isinstance(found[0], Bounded) or len(found) == 1 or not all(isinstance(one, Bounded) for one in found):
            whole.set(key, found[0])
            continue
        weight = np.array([max(one.half_width, 1e-9) ** -2.0 for one in found])
        value = float(weight @ [one.value for one in found] / weight.sum())
        half = float(np.hypot(weight.sum() ** -0.5, 0.5 * np.ptp([one.value for one in found])))
        whole.set(key, Bounded(value, value - half, value + half))
    return whole


def state_law(fit, law, why):
    """Takes the law of recording.yaml for that of the instrument."""
    fit.notes.append(f"{why}; the law is that of recording.yaml")
    is_log = law.kind == "decibel"
    for key in ("receiver.gamma", "receiver.dynamic_range_db"):
        fit.estimates.pop(key, None)
    fit.set("receiver.companding", "log" if is_log else "gamma")
    fit.set("receiver.dynamic_range_db" if is_log else "receiver.gamma", min(law.range_db, 200.0) if is_log else
            {"amplitude": 1.0, "power": 2.0, "gamma": law.exponent}[law.kind])


def fit_laws(recording, fit, absorption):
    """Fits the law to all patches, finds the noise, and fits it again to patches of noise if enough: echoes have texture."""
    values, full, receiver = recording.values, full_value_of(recording), fit.instrument["receiver"]
    statistics, offset = receiver_statistics(receiver), receiver["offset"]

    def find():
        fit.noise = fit_noise(noise_blocks(recording, fit.law), absorption, receiver["tvg_from_m"])
    fit.law = fit_law(values, full, statistics, None, offset)
    find()
    patches, noise, _ = classified(recording, fit.law, fit.noise)
    by_echoes = len(noise) < MIN_PATCHES
    places = None if by_echoes else np.bincount(patches.place[noise], minlength=patches.places) > 0
    fit.law = fit_law(values, full, statistics, places, offset, fit.law.is_log)
    find()
    if by_echoes:
        fit.notes.append("companding is fitted to echoes: a texture of the bottom counts as speckle, and makes gamma too "
                         "large or dynamic_range_db too small")


def fit_pulse_and_beams(recording, fit):
    patches, noise, echoes = classified(recording, fit.law, fit.noise)
    by_echoes = len(noise) < MIN_PATCHES
    chosen = echoes if by_echoes else noise
    if len(chosen) < MIN_PATCHES:
        return fit.notes.append("pulse and beams: too few patches of noise or even echoes; those of the start are kept")
    pulse = pulse_of(fit.instrument, "echo" if by_echoes else "noise")
    width = fit_pulse(patches, chosen, pulse)
    if width is None:
        fit.notes.append("pulse.resolution_m: the pulse is shorter than a bin; that of the start is kept")
    elif fit.noise is None:
        other = fit_pulse(patches, chosen, pulse_of(fit.instrument, "noise"))
        width = Bounded(width.value, min(width.low, other.low), max(width.high, other.high))
        fit.notes.append("pulse.resolution_m: no rows show noise alone, so the interval holds pulses of both")
    beams = fit.instrument["beam"] if recording.bearing_rad is not None and len(recording.bearing_rad) > LAGS else None
    if beams:
        found = fit_array(*patches.beam_covariance(chosen, not by_echoes), np.sin(recording.bearing_rad), fit.law.statistics)
        for key, number in zip(("beam.width_deg", "beam.side_lobe_db"), found or ()):
            fit.set(key, number)
        if found is None:
            fit.notes.append("beams: too few places of even echoes; width and taper are those of the start")
        elif found[1].high - found[1].low > 8.0:
            fit.notes.append("beam.width_deg and side_lobe_db can hardly be separated: the two belong together")
    if width:
        fit.set("pulse.resolution_m", width.scaled(recording.range_step_m))


def set_levels(start, fit):
    """Sets gain and levels by the noise. Pings show only differences of levels, so full_scale_db is fitted."""
    noise, law = fit.noise, fit.law
    if noise is None:
        fit.lacks.append("rows that show noise alone")
        return fit.notes.append("tvg_log: no rows show noise alone; that of the start is kept")
    if noise.tvg_log.high < 0.0:    # tails of echoes
        return fit.notes.append("tvg_log: what looks like noise falls with range; that of the start is kept")
    # An error of the law scales all levels below full scale, and the gain with them.
    share = law.scale.half_width / law.scale.value
    near, far = noise.used.range_m[[0, -1]]
    level = noise.level_db.widened(share * noise.level_db.value)
    growth = (noise.at(far) - noise.at(near)) / np.log10(far / near)
    fit.set("receiver.tvg_log", Bounded(*map(float, np.clip(noise.tvg_log.widened(share * growth), 0.0, 60.0))))
    fit.instrument["receiver"]["tvg_absorption"] = True
    fit.level_db = level.value
    fit.set("receiver.full_scale_db", Bounded(*(start.noise_db - x for x in (level.value, level.high, level.low))))
    fit.notes.append("full_scale_db is fitted to noise_db and source_level_db of the start, tvg_log to the absorption "
                     "of its water: pings show only differences")
