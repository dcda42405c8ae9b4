"""recording.yaml, which describes a folder of arrays or of an instrument's files (docs/compare.md)."""
import dataclasses
import difflib
import math
import pathlib

import yaml

from .recording import KINDS, LAWS, Law, RecordingError

FILE_NAME = "recording.yaml"
LARGEST_FILE = 1 << 24
# The keys that name the files of the pings, and the kinds that each can have.
SOURCES = {"files": KINDS[:4], "xtf": ("sidescan", "soundings"), "oculus": ("imaging",), "logs": KINDS[:4],
           "soundings": ("soundings",)}
ANGLE = (-360.0, 360.0)
NUMBERS = {     # key: least, greatest
    "sound_speed_m_s": (300.0, 1e4), "first_range_m": (0.0, 1e6), "range_step_m": (0.0, 1e4),
    "bearing_first_deg": ANGLE, "bearing_last_deg": ANGLE, "head_first_deg": ANGLE, "head_step_deg": ANGLE,
    "frequency_hz": (1e3, 1e8), "altitude_m": (0.0, 1e5), "pitch_deg": (-180.0, 180.0), "rate_hz": (0.0, 1e6)}
LISTS = {"bearings_deg": ANGLE, "times_s": (-1e12, 1e12)}
LAW_NUMBERS = {"exponent": (0.1, 2.0), "range_db": (0.0, 300.0), "full_value": (0.0, 1e30), "offset": (0.0, 0.9)}


@dataclasses.dataclass
class Description:
    """The keys of a recording.yaml; None where a key is missing."""

    path: pathlib.Path
    kind: str
    source: str                     # the key that names the files
    files: list                     # paths; three for `soundings`: ranges, angles, intensities
    law: Law | None                 # missing: the format of `logs` defines it
    full_value_is_auto: bool = False
    spread: str = "angle"
    sound_speed_m_s: float | None = None
    first_range_m: float | None = None
    range_step_m: float | None = None
    bearing_first_deg: float = 0.0
    bearing_last_deg: float = 0.0
    bearings_deg: list | None = None
    head_first_deg: float = 0.0
    head_step_deg: float = 0.0
    frequency_hz: float | None = None
    altitude_m: float | None = None
    pitch_deg: float | None = None
    rate_hz: float | None = None
    times_s: list | None = None

    def refuse(self, what):
        raise RecordingError(f"{self.path}: {what}")


def read_yaml(path, largest):
    """The mapping in a YAML file; RecordingError if there is none."""
    try:
        if path.stat().st_size > largest:
            raise RecordingError(f"{path}: is larger than {largest >> 20} MB")
        loader = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
        document = yaml.load(path.read_bytes(), loader)     # a safe loader, the quick one where it is built
    except OSError as fault:
        raise RecordingError(f"{path}: cannot be read: {fault.strerror}") from fault
    except (yaml.YAMLError, ValueError, RecursionError) as fault:
        if isinstance(fault, RecordingError):
            raise
        raise RecordingError(f"{path}: is no YAML: {' '.join(str(fault).split())}") from fault
    if not isinstance(document, dict):
        raise RecordingError(f"{path}: holds no keys")
    return document


def read_description(path):
    """The recording.yaml at a path, each key checked."""
    keys = read_yaml(path, LARGEST_FILE)
    require_known(path, keys, ["kind", *SOURCES, "law", "spread", *NUMBERS, *LISTS])
    kind = choice(path, keys, "kind", KINDS)
    named = [key for key in SOURCES if keys.get(key)]
    if len(named) != 1:
        raise RecordingError(f"{path}: needs one of the keys {', '.join(SOURCES)}, and has "
                             f"{' and '.join(named) or 'none'}")
    source = named[0]
    if kind not in SOURCES[source]:
        raise RecordingError(f"{path}: has '{source}', which has pings of the kind "
                             f"{' or '.join(SOURCES[source])}, not {kind}")
    law, is_auto = law_of(path, keys.get("law"))
    if law is None and source != "logs":
        raise RecordingError(f"{path}: lacks the key 'law', the meaning of the values")
    numbers = {key: number(path, keys, key, limits) for key, limits in NUMBERS.items() if key in keys}
    lists = {key: [number(path, {key: value}, key, limits) for value in as_list(path, keys, key)]
             for key, limits in LISTS.items() if keys.get(key)}
    given = {key: value for key, value in {**numbers, **lists}.items() if value is not None}
    out = Description(path, kind, source, files_of(path, keys, source), law, is_auto,
                      choice(path, keys, "spread", ("angle", "sine"), "angle"), **given)
    check_keys(out)
    return out


def check_keys(own):
    """RecordingError where keys lack others, or contradict each other."""
    needed = {"files": ("sound_speed_m_s", "first_range_m", "range_step_m"), "soundings": ("sound_speed_m_s",)}
    for key in needed.get(own.source, ()):
        if getattr(own, key) is None:
            own.refuse(f"lacks the key '{key}'")
    if own.source == "files" and own.range_step_m == 0.0:
        own.refuse("has 'range_step_m' 0, which must be above 0")
    if own.spread == "sine" and max(abs(own.bearing_first_deg), abs(own.bearing_last_deg)) > 90.0:
        own.refuse("has bearings beyond -90 and 90 degrees, which 'spread: sine' cannot have")


def law_of(path, keys):
    """The section `law` and whether its full_value follows the samples; (None, False) without it."""
    if keys is None:
        return None, False
    if not isinstance(keys, dict):
        raise RecordingError(f"{path}: 'law' must be like {{kind: gamma, exponent: 0.5, full_value: 255}}")
    require_known(path, keys, ["kind", *LAW_NUMBERS])
    law = Law(choice(path, keys, "kind", LAWS))
    given = {key: number(path, keys, key, limits) for key, limits in LAW_NUMBERS.items() if key in keys}
    for key, value in given.items():
        if value is not None:
            setattr(law, key, value)
    if law.kind == "decibel" and not (law.range_db > 0.0 and law.full_value > 0.0):
        raise RecordingError(f"{path}: the law decibel needs range_db and full_value above 0")
    return law, given.get("full_value") is None


def require_known(path, keys, known):
    for key in keys:
        if key not in known:
            near = difflib.get_close_matches(str(key), known, 1)
            raise RecordingError(f"{path}: has the unknown key {str(key)[:80]!r}"
                                 + (f"; did you mean '{near[0]}'?" if near else f"; there are {', '.join(known)}"))


def choice(path, keys, key, choices, default=None):
    value = keys.get(key, default)
    if value not in choices:
        raise RecordingError(f"{path}: '{key}' is {str(value)[:80]!r} and must be one of {', '.join(choices)}")
    return value


def number(path, keys, key, limits):
    """The number of a key; None where it is `auto`. PyYAML takes 1e3 as a text."""
    value = keys[key]
    if value in ("auto", None):
        return None
    try:
        value = math.nan if isinstance(value, bool) else float(value)
    except (TypeError, ValueError, OverflowError):
        value = math.nan
    if not limits[0] <= value <= limits[1]:
        raise RecordingError(f"{path}: '{key}' must be a number from {limits[0]:g} to {limits[1]:g}")
    return value


def as_list(path, keys, key):
    if not isinstance(keys[key], list):
        raise RecordingError(f"{path}: '{key}' must be a list")
    return keys[key]


def files_of(path, keys, source):
    """The paths that a key names, from the folder of recording.yaml on."""
    names = keys[source]
    if source == "soundings":
        wanted = ("range_m", "angle_rad", "intensity")
        if not isinstance(names, dict) or set(names) != set(wanted):
            raise RecordingError(f"{path}: 'soundings' must have the keys {', '.join(wanted)}")
        names = [names[key] for key in wanted]
    names = [names] if isinstance(names, str) else names
    if not isinstance(names, list) or not all(isinstance(name, str) and name and "\0" not in name for name in names):
        raise RecordingError(f"{path}: '{source}' must be the path of a file, or a list of paths")
    return [path.parent / name for name in names]
