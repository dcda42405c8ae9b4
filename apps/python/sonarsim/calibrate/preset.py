"""The preset that a calibration starts from, and the text of the one that it writes."""
import copy
import dataclasses
import json
import os
import pathlib
import re
import shutil
import subprocess

import numpy as np
import yaml

from .statistics import Bounded, CalibrationError

LARGEST_PRESET = 1 << 20
KINDS = {"profiling": "soundings"}
# The defaults of the program, for the keys that a fit reads.
DEFAULTS = {
    "beam": {"width_deg": 1.0, "side_lobe_db": -13.3, "spread": "angle"},
    "pulse": {"resolution_m": 0.0, "side_lobe_db": -30.0},
    "speckle": {"mode": "scene", "clutter_shape": 0.0, "clutter_m": 0.1},
    "receiver": {"tvg_log": 40.0, "tvg_absorption": True, "tvg_from_m": 0.0, "companding": "gamma", "gamma": 0.5,
                 "dynamic_range_db": 60.0, "samples": 1, "combine": "max", "looks": 1, "offset": 0.0},
}


@dataclasses.dataclass
class Start:
    text: str
    kind: str                   # as that of a recording
    instrument: dict            # its sections with the defaults
    given: dict                 # the keys of the file
    shape: dict = dataclasses.field(default_factory=dict)   # keys that the pings set
    noise_db: float = 0.0
    full_scale_db: float = 0.0
    absorption_db_per_m: float = 0.0

    @property
    def range_bin_m(self):
        return (self.given["range_max_m"] - self.given.get("range_min_m", 0.0)) / self.given["range_bins"]


def program():
    """The program sonarsim: the one that runs this command, else the one on the path."""
    found = os.environ.get("SONARSIM") or shutil.which("sonarsim")
    if not found:
        raise CalibrationError("the program sonarsim, which computes the levels of a preset, is not on the PATH; set "
                               "SONARSIM to its path")
    return found


def preset_file(name):
    """A file, or that of a preset of configs/sensors by its name."""
    if pathlib.Path(name).is_file():
        return pathlib.Path(name)
    roots = [*pathlib.Path(__file__).resolve().parents, *pathlib.Path(program()).resolve().parents]
    folders = [root / part for root in roots for part in ("configs/sensors", "share/sonarsim/configs/sensors")]
    if not re.fullmatch(r"[\w-]+", name):
        raise CalibrationError(f"{name}: is no file; give a preset's file, or the name of one of configs/sensors")
    for folder in folders:
        if (folder / f"{name}.yaml").is_file():
            return folder / f"{name}.yaml"
    names = sorted({path.stem for folder in folders for path in folder.glob("*.yaml")})
    raise CalibrationError(f"{name}: is no file, and no preset of this name came with the program; there are: "
                           + ", ".join(names))


def read_start(name, settings):
    """The preset to start with, after `settings` (KEY=VALUE) changed it."""
    file = preset_file(name)
    if file.stat().st_size > LARGEST_PRESET:
        raise CalibrationError(f"{file}: is larger than 1 MiB, so it is no preset")
    try:
        text = file.read_text(encoding="utf-8")
        given = yaml.safe_load(text)
    except (yaml.YAMLError, UnicodeDecodeError, RecursionError) as fault:
        raise CalibrationError(f"{file}: is not YAML: {' '.join(str(fault).split())}") from fault
    if not isinstance(given, dict) or not isinstance(given.get("instrument", {}), dict):
        raise CalibrationError(f"{file}: a preset is a section of keys, with the section instrument")
    for setting in settings:
        apply(given, setting)
    if given.get("model") != "calibrated":
        raise CalibrationError(f"{file}: has nothing to calibrate: only model: calibrated has an instrument")
    levels(file, [f"--set={setting}" for setting in settings])     # refuses wrong keys and values
    instrument = copy.deepcopy(DEFAULTS)
    for section, keys in given.get("instrument", {}).items():
        if section in instrument:
            instrument[section].update(keys)
    kind = given.get("kind", "imaging")
    return file, Start(text, KINDS.get(kind, kind), numbers(instrument), given)


def apply(given, setting):
    """Sets sensors.sonar.KEY=VALUE in the keys of a preset; the program reads all other settings."""
    key, _, value = setting.partition("=")
    *path, last = key.split(".")
    if path[:2] != ["sensors", "sonar"]:
        return
    for part in path[2:]:
        given = given.setdefault(part, {})
        if not isinstance(given, dict):
            raise CalibrationError(f"--set {setting}: '{part}' is no section")
    given[last] = yaml.safe_load(value)


def numbers(instrument):
    """YAML takes 2.1e6 for a text."""
    return {section: {key: float(value) if isinstance(value, str) and re.fullmatch(r"[-+.\d]+[eE][-+\d]+", value)
                      else value for key, value in keys.items()} for section, keys in instrument.items()}


def levels(file, options):
    """What the program says of the preset."""
    try:
        run = subprocess.run([program(), "preset", str(file), "--json", *options], capture_output=True, text=True,
                             check=False)
        if run.returncode:
            lines = run.stderr.strip().splitlines() or [f"{program()} preset failed"]
            raise CalibrationError(re.sub("^error: ", "", lines[-1]))
        return json.loads(run.stdout)
    except (OSError, ValueError) as fault:
        if isinstance(fault, CalibrationError):
            raise
        raise CalibrationError(f"{program()}: cannot be run for the levels of {file}: {fault}") from fault


def set_shape(file, start, recording, settings):
    """The start with the shape of the pings, and its levels for that shape."""
    bins, step = recording.values.shape[1], recording.range_step_m
    start.shape = {"range_min_m": max(recording.first_range_m - 0.5 * step, 0.0),
                   "range_max_m": recording.first_range_m + (bins - 0.5) * step, "range_bins": bins}
    if recording.kind == "imaging" and len(recording.bearing_rad) > 1:
        beams, bearing = len(recording.bearing_rad), recording.bearing_rad
        is_sine = unevenness(np.sin(bearing)) < unevenness(bearing)
        extent = np.ptp(np.sin(bearing) if is_sine else bearing) * beams / (beams - 1)
        extent = 2.0 * np.arcsin(min(0.5 * extent, 1.0)) if is_sine else extent
        start.shape.update({"azimuth_deg": float(np.degrees(extent)), "azimuth_bins": beams,
                            "instrument.beam.spread": "sine" if is_sine else "angle"})
    options = [f"--set=sensors.sonar.{key}={value}" for key, value in start.shape.items()]
    options += [f"--set={setting}" for setting in settings]
    found = levels(file, [*options, f"--set=water.sound_speed_m_s={recording.sound_speed_m_s}"])
    start.noise_db, start.full_scale_db = found["noise_db"], found["full_scale_db"]
    start.absorption_db_per_m = found["absorption_db_per_m"]


def unevenness(row):
    return np.var(np.diff(row)) / np.mean(np.diff(row)) ** 2


def new_keys(start, fit):
    """key -> (value, comment) of all keys that differ from the start."""
    out = {key: (value, "file: of the pings") for key, value in start.shape.items()}
    for key, value in fit.estimates.items():
        if isinstance(value, Bounded):
            out[f"instrument.{key}"] = f"{value.value:.4g}", f"fit: {value.low:.4g} to {value.high:.4g}"
        else:
            out[f"instrument.{key}"] = value, "fit"
    given = start.given.get("instrument", {}).get("receiver", {})
    if fit.noise and not start.instrument["receiver"]["tvg_absorption"]:
        out["instrument.receiver.tvg_absorption"] = "true", "rule: tvg_log is fitted beside the absorption of the water"
    if fit.noise and fit.noise.tvg_from_m.value == 0.0 and start.instrument["receiver"]["tvg_from_m"] > 0.0:
        out["instrument.receiver.tvg_from_m"] = 0, "rule: the pings show no start of the gain"
    if fit.noise and given.get("noise_db", "auto") == "auto":
        out["instrument.receiver.noise_db"] = (f"{start.noise_db:.4g}",
                                               "rule: that of the start; full_scale_db is fitted to it")
    return out


LINE = re.compile(r"( *)([^\s#:-][^:#]*):(.*)")


def with_keys(text, keys, name):
    """The text of a preset with other values. Lines that do not change keep their comments; keys that it lacks are
    added at the head of their section."""
    lines = text.rstrip("\n").split("\n")

    def find(begin, indent, key):
        """The line of a key in the block from `begin`, or None, the end of the block and the indent of its keys."""
        own = None
        for k in range(begin, len(lines)):
            match = LINE.match(lines[k])
            if not match:
                continue
            here = len(match[1])
            if here <= indent:
                return None, k, own
            own = here if own is None else own
            if here == own and match[2].strip() == key:
                return k, k, own
        return None, len(lines), own
    for path, (value, comment) in keys.items():
        *sections, last = path.split(".")
        begin, indent = 0, -1
        for section in sections:
            at, end, own = find(begin, indent, section)
            own = indent + 2 if own is None else own
            own = max(own, 0) if begin else 0
            if at is None:
                at = end
                lines.insert(at, " " * own + section + ":")
            elif LINE.match(lines[at])[3].split("#")[0].strip():
                raise CalibrationError(f"{name}:{at + 1}: write each key of '{section}' in a line of its own, so that "
                                       "it can be replaced")
            begin, indent = at + 1, own
        at, _, own = find(begin, indent, last)
        own = indent + (2 if sections else 1) if own is None else own
        line = f"{' ' * own}{last}: {value}  # {comment}"
        lines[at if at is not None else begin:(at + 1) if at is not None else begin] = [line]
    return "\n".join(lines) + "\n"
