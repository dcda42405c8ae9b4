"""The preset that a calibration starts from, and the text of the one that it writes."""
import dataclasses
import json
import os
import pathlib
import shutil
import subprocess

import numpy as np
import yaml

from ..recording.description import read_yaml
from .statistics import Bounded, CalibrationError

LARGEST_PRESET = 1 << 20
MAX_ABSORBED_DB = 100.0    # more than any sonar has to spare
# The defaults of the program, for the keys that a fit reads.
DEFAULTS = {"beam": {"width_deg": 1.0, "side_lobe_db": -13.3},
            "pulse": {"resolution_m": 0.0, "side_lobe_db": -30.0}, "speckle": {"mode": "scene"},
            "receiver": {"tvg_log": 40.0, "tvg_absorption": True, "tvg_from_m": 0.0, "companding": "gamma", "gamma": 0.5,
                         "dynamic_range_db": 60.0, "samples": 1.0, "combine": "max", "expansion": 1.0, "offset": 0.0,
                         "converter_noise_db": -300.0}}


def program_of(package):
    """The program of a package folder, .../python/sonarsim (links kept): SONARSIM, else that beside it, else of PATH."""
    python = pathlib.Path(package).absolute().parent
    came_with_it = [python.parent / "sonarsim", *(prefix / "bin" / "sonarsim" for prefix in python.parents[2:3])]
    return (os.environ.get("SONARSIM") or next((str(one) for one in came_with_it if one.is_file()), None)
            or shutil.which("sonarsim") or "sonarsim")


PROGRAM = program_of(pathlib.Path(__file__).parent.parent)


@dataclasses.dataclass
class Start:
    file: pathlib.Path
    text: str
    kind: str                   # as that of a recording
    instrument: dict            # the sections of DEFAULTS with the keys of the file
    shape: dict = dataclasses.field(default_factory=dict)   # keys that the pings set
    noise_db: float = 0.0
    full_scale_db: float = 0.0
    absorption_db_per_m: float = 0.0


def preset_file(name):
    """A file, or that of a preset of configs/sensors by its name."""
    if pathlib.Path(name).is_file():
        return pathlib.Path(name)
    roots = [*pathlib.Path(__file__).resolve().parents, *pathlib.Path(PROGRAM).resolve().parents]
    folders = [root / part for root in roots for part in ("configs/sensors", "share/sonarsim/configs/sensors")]
    shipped = {path.stem: path for folder in folders for path in folder.glob("*.yaml")}
    if name not in shipped:
        raise CalibrationError(f"{name}: is not a file, and no preset of this name came with the program; there are: "
                               + ", ".join(sorted(shipped)))
    return shipped[name]


def read_start(name):
    file = preset_file(name)
    given = read_yaml(file, LARGEST_PRESET)
    try:
        instrument = given.get("instrument") or {}
        sections = {section: keys | (instrument.get(section) or {}) for section, keys in DEFAULTS.items()}
    except (AttributeError, TypeError) as fault:
        raise CalibrationError(f"{file}: is not a preset, a YAML file of a sensor's keys with the section instrument") from fault
    if given.get("model") != "calibrated":
        raise CalibrationError(f"{file}: has nothing to calibrate: only model: calibrated has an instrument")
    kind = given.get("kind", "imaging")
    return Start(file, file.read_text("utf-8"), "soundings" if kind == "profiling" else kind, sections)


def set_shape(start, recording, settings):
    """Gives the start the shape of the pings, and their levels."""
    bins, step = recording.values.shape[1], recording.range_step_m
    start.shape = {"range_min_m": max(recording.first_range_m - 0.5 * step, 0.0),
                   "range_max_m": recording.first_range_m + (bins - 0.5) * step, "range_bins": bins}
    if recording.kind == "imaging" and len(recording.bearing_rad) > 1:
        beams, bearing = len(recording.bearing_rad), recording.bearing_rad
        uneven = [np.std(np.diff(row)) / abs(np.mean(np.diff(row))) for row in (np.sin(bearing), bearing)]
        is_sine = uneven[0] < uneven[1]
        extent = np.ptp(np.sin(bearing) if is_sine else bearing) * beams / (beams - 1)
        extent = 2.0 * np.arcsin(min(0.5 * extent, 1.0)) if is_sine else extent
        start.shape.update({"azimuth_deg": float(np.degrees(extent)), "azimuth_bins": beams,
                            "instrument.beam.spread": "sine" if is_sine else "angle"})
    if recording.frequency_hz:
        start.shape["instrument.frequency_hz"] = f"{recording.frequency_hz:g}"
    set_levels(start, [*settings, f"water.sound_speed_m_s={recording.sound_speed_m_s}"])
    absorbed_db = 2.0 * start.absorption_db_per_m * start.shape["range_max_m"]
    if absorbed_db > MAX_ABSORBED_DB:
        raise CalibrationError(f"water absorbs {absorbed_db:.0f} dB over the range of the pings at the frequency of "
                               f"{start.file}: give that of the sonar, frequency_hz in recording.yaml")


def set_levels(start, settings):
    """Gives the start the levels that the program computes for its shape."""
    settings = [*(f"sensors.sonar.{key}={value}" for key, value in start.shape.items()), *settings]
    found = json.loads(run_program("preset", start.file, "--json", *(f"--set={setting}" for setting in settings)))
    for key in ("noise_db", "full_scale_db", "absorption_db_per_m"):
        setattr(start, key, found[key])


def run_program(*words):
    """What the program prints. CalibrationError with the last line of its messages."""
    try:
        run = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)
    except OSError as fault:
        raise CalibrationError(f"{PROGRAM}: {fault.strerror}; set SONARSIM to the path of the program") from fault
    if run.returncode:
        last = (run.stderr.strip().splitlines() or ["it failed"])[-1]
        raise CalibrationError(json.loads(last)["message"] if last.startswith("{") else last.removeprefix("error: "))
    return run.stdout


def new_keys(start, fit):
    """key -> (value, comment) of all keys that differ from the start."""
    out = {key: (value, "file: of the pings") for key, value in start.shape.items()}
    for key, value in fit.estimates.items():
        out[f"instrument.{key}"] = ((f"{value.value:.4g}", f"fit: {value.low:.4g} to {value.high:.4g}")
                                    if isinstance(value, Bounded) else (value, "fit" if isinstance(value, str) else "file"))
    receiver = start.instrument["receiver"]
    if not fit.estimates.keys() & {"receiver.tvg_log", "receiver.full_scale_db"}:
        return out
    if fit.noise and not receiver["tvg_absorption"]:
        out["instrument.receiver.tvg_absorption"] = "true", "rule: tvg_log is fitted beside the absorption of the water"
    if fit.noise and receiver.get("noise_db", "auto") == "auto" and "receiver.noise_db" not in fit.estimates:
        out["instrument.receiver.noise_db"] = f"{start.noise_db:.4g}", "rule: that of the start, for full_scale_db"
    return out


def with_key(text, path, value, comment, name):
    """The text of a preset with another value. A key that it lacks is added at the head of its section."""
    lines, node, parts = text.split("\n"), yaml.compose(text), path.split(".")
    for depth, part in enumerate(parts):
        at, indent = node.start_mark.line, node.start_mark.column
        if not isinstance(node, yaml.MappingNode) or node.flow_style:
            raise CalibrationError(f"{name}:{at + 1}: write each key in a line of its own, so that it can be replaced")
        pair = next((pair for pair in node.value if pair[0].value == part), None)
        if pair is None:
            break
        at, node = pair[0].start_mark.line, pair[1]
    new = [f"{' ' * (indent + 2 * k)}{part}:" for k, part in enumerate(parts[depth:])]
    lines[at:at + (pair is not None)] = [*new[:-1], f"{new[-1]} {value}  # {comment}"]
    return "\n".join(lines)
