"""recording.yaml, which describes a folder of arrays or of an instrument's files (docs/calibrate.md)."""
import difflib
import math
import re
import types

import yaml

from .recording import KINDS, LAWS, Law, RecordingError

FILE_NAME, LARGEST_FILE = "recording.yaml", 1 << 24
# The keys that name the files of the pings, and the kinds that each can have.
SOURCES = {"files": KINDS[:4], "xtf": ("sidescan",), "oculus": ("imaging",),
           "logs": ("imaging", "scanning", "echosounder"), "soundings": ("soundings",)}
ANGLE = (-360.0, 360.0)
NUMBERS = {     # key: least, greatest, default
    "sound_speed_m_s": (300.0, 1e4), "first_range_m": (0.0, 1e6), "range_step_m": (0.0, 1e4),
    "bearing_first_deg": (*ANGLE, 0.0), "bearing_last_deg": (*ANGLE, 0.0), "frequency_hz": (1e3, 1e8)}
# Keys that describe a recording to its readers. No figure needs them.
NOTES = ("rate_hz", "times_s", "head_first_deg", "head_step_deg", "altitude_m", "pitch_deg")
LAW_NUMBERS = {"exponent": (0.1, 2.0, 0.5), "range_db": (0.0, 300.0, 0.0), "full_value": (1e-30, 1e30, 255.0),
               "offset": (0.0, 0.9, 0.0)}
SOUNDING_FILES = ("range_m", "angle_rad", "intensity")
NEEDED = {"files": ("sound_speed_m_s", "first_range_m", "range_step_m"), "soundings": ("sound_speed_m_s",)}


class Loader(getattr(yaml, "CSafeLoader", yaml.SafeLoader)):      # the quick one if built
    """Takes 1e+06 for a number, which YAML 1.2 says and PyYAML does not."""


Loader.add_implicit_resolver("tag:yaml.org,2002:float", re.compile(r"[-+]?(\d+\.?\d*|\.\d+)[eE][-+]?\d+$"), "-+.0123456789")


class Section:
    """The keys of a mapping in a YAML file, checked."""
    def __init__(self, path, keys, known):
        self.path, self.keys = path, keys
        if not isinstance(keys, dict):
            self.refuse(f"needs keys, of {', '.join(known)}")
        for key in keys:
            if key not in known:
                near = difflib.get_close_matches(str(key), known, 1) or [", ".join(known)]
                self.refuse(f"has the unknown key {str(key)[:80]!r}; did you mean {near[0]}?")

    def refuse(self, what):
        raise RecordingError(f"{self.path}: {what}")

    def choice(self, key, choices, default=None):
        value = self.keys.get(key, default)
        if value not in choices:
            self.refuse(f"'{key}' is {str(value)[:80]!r} and must be one of {', '.join(choices)}")
        return value

    def number(self, key, least, greatest, default=None):
        value = self.keys.get(key)
        return default if value in (None, "auto") else self.numbers(key, least, greatest, [value])[0]

    def numbers(self, key, least, greatest, values=None):
        values = (self.keys.get(key) or []) if values is None else values
        try:
            numbers = [math.nan if isinstance(one, bool) else float(one) for one in values]
        except (TypeError, ValueError, OverflowError):
            numbers = [math.nan]
        if not all(least <= one <= greatest for one in numbers):
            self.refuse(f"'{key}' must be a number from {least:g} to {greatest:g}, or a list of them where a list belongs")
        return numbers

    def files(self, key):
        """The paths that a key names, from the folder of the file on."""
        names = self.keys[key]
        if key == "soundings":
            names = [Section(self.path, names, SOUNDING_FILES).keys.get(name) for name in SOUNDING_FILES]
        names = [names] if isinstance(names, str) else names
        if not isinstance(names, list) or not all(isinstance(name, str) and name and "\0" not in name for name in names):
            self.refuse(f"'{key}' must be the path of a file, or a list of paths")
        return [self.path.parent / name for name in names]


def read_yaml(path, largest):
    try:
        if path.stat().st_size > largest:
            raise RecordingError(f"{path}: is larger than {largest >> 20} MB")
        return yaml.load(path.read_bytes(), Loader)
    except OSError as fault:
        raise RecordingError(f"{path}: cannot be read: {fault.strerror}") from fault
    except (yaml.YAMLError, UnicodeError, RecursionError) as fault:
        raise RecordingError(f"{path}: is not YAML: {' '.join(str(fault).split())}") from fault


def read_description(path):
    """The recording.yaml at a path as a namespace: a name for each key, None where it is missing and has no default; and
    `source`, the key that names the files, `files`, `full_value_is_auto` and `refuse`."""
    section = Section(path, read_yaml(path, LARGEST_FILE), ["kind", *SOURCES, "law", "spread", *NUMBERS, "bearings_deg",
                                                           *NOTES])
    kind, named = section.choice("kind", KINDS), [key for key in SOURCES if section.keys.get(key)]
    if len(named) != 1 or kind not in SOURCES[named[0]]:
        section.refuse(f"of the kind {kind} needs one of the keys {', '.join(k for k in SOURCES if kind in SOURCES[k])}, "
                       f"and has {' and '.join(named) or 'none'}")
    own = types.SimpleNamespace(refuse=section.refuse, kind=kind, source=named[0], files=section.files(named[0]), law=None,
        spread=section.choice("spread", ("angle", "sine"), "angle"), full_value_is_auto=False,
        bearings_deg=section.numbers("bearings_deg", *ANGLE),
        **{key: section.number(key, *limits) for key, limits in NUMBERS.items()})
    if section.keys.get("law") is not None:
        law = Section(path, section.keys["law"], ["kind", *LAW_NUMBERS])
        own.full_value_is_auto = law.keys.get("full_value") in (None, "auto")
        own.law = Law(law.choice("kind", LAWS), **{key: law.number(key, *limits) for key, limits in LAW_NUMBERS.items()})
        if own.law.kind == "decibel" and not own.law.range_db > 0.0:
            own.refuse("has the law decibel, which needs range_db above 0")
    elif own.source != "logs":
        own.refuse("lacks the key 'law', the meaning of the values")
    for key in NEEDED.get(own.source, ()):
        if getattr(own, key) is None or key == "range_step_m" and own.range_step_m == 0.0:
            own.refuse(f"lacks the key '{key}', or has it 0")
    if own.spread == "sine" and max(abs(own.bearing_first_deg), abs(own.bearing_last_deg)) > 90.0:
        own.refuse("has bearings beyond -90 and 90 degrees, which 'spread: sine' cannot have")
    return own
