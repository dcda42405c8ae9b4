"""Recordings in the files of instruments: joins files, and takes from recording.yaml what the format lacks."""
import struct

import numpy as np

from . import aris, didson, ek60, oculus, ping360, xtf
from .arrays import bearings_of, set_times
from .recording import MOST_VALUES, RecordingError, Soundings

LARGEST_FILE = 1 << 31
NO_LONGER_READ = {b"XML0": "an EK80", b"#": "a .kmall", b"\x02I": "an .all"}   # by the bytes from the fourth on


def read_files(own, most_pings):
    """The recording in the files of `xtf`, `oculus` or `logs`."""
    parts, values = [], 0
    for path in own.files:
        rest = most_pings - sum(map(len, parts))
        if not rest:
            break
        part = read_file(path, own, rest)
        if part.kind != own.kind:
            raise RecordingError(f"{path}: has pings of the kind {part.kind}, and recording.yaml says {own.kind}")
        values += (part.soundings.range_m if part.soundings else part.values).size
        if values > MOST_VALUES:
            raise RecordingError(f"{path}: makes more than {MOST_VALUES} values in all; take fewer pings")
        parts.append(part)
        require_alike(path, part, parts[0])
    return complete(own, joined(parts))


def read_file(path, own, most_pings):
    try:
        if path.stat().st_size > LARGEST_FILE:
            raise ValueError("is larger than 2 GB; split it")
        data = path.read_bytes()
        read = {"xtf": xtf.read, "oculus": oculus.read}.get(own.source) or reader_of(data)
        return read(data, most_pings, own)
    except OSError as fault:
        raise RecordingError(f"{path}: cannot be read: {fault.strerror}") from fault
    except struct.error as fault:
        raise RecordingError(f"{path}: is cut off") from fault
    except ValueError as fault:
        raise RecordingError(f"{path}: {fault}") from fault


def reader_of(data):
    """The reader of the format that the first bytes show."""
    if data[4:8] == b"CON0":
        return ek60.read
    if data[:3] == b"DDF":
        return aris.read if data[:4] == aris.MARK else didson.read
    for mark, what in NO_LONGER_READ.items():
        if data[4:].startswith(mark):
            raise ValueError(f"is {what} file, which is not read; write its pings as arrays (docs/compare.md)")
    return ping360.read


def require_alike(path, part, first):
    """RecordingError if a file has other ranges, beams or levels than the first."""
    if part.soundings:
        return
    share = 1e-2 if part.kind == "sidescan" else 1e-4       # side-scans round their ranges
    for is_other, what in (
            (part.law != first.law, "another scale of levels"),
            (part.values.shape[1:] != first.values.shape[1:], "another number of ranges or beams"),
            (abs(part.range_step_m - first.range_step_m) > share * first.range_step_m, "another step of range"),
            (abs(part.first_range_m - first.first_range_m) > 0.5 * first.range_step_m, "another first range"),
            # Sonars round it, and sweeps have a mean of their own. Chosen.
            (abs((part.frequency_hz or 0.0) - (first.frequency_hz or 0.0)) > 0.01 * (first.frequency_hz or 0.0),
             "another frequency")):
        if is_other:
            raise RecordingError(f"{path}: has {what} than the first file; split the recording there")


def joined(parts):
    """The recordings of several files as one."""
    first = parts[0]
    def together(arrays):
        return np.concatenate(arrays) if arrays[0] is not None else None
    if first.soundings:
        pings = [(ranges, angles, levels) for own in (part.soundings for part in parts)
                 for ranges, angles, levels in zip(own.range_m, own.angle_rad, own.intensity)]
        first.soundings = Soundings.of(pings)
    first.values, first.times_s, first.head_rad = (
        together([getattr(part, name) for part in parts]) for name in ("values", "times_s", "head_rad"))
    return first


def complete(own, recording):
    """Takes from recording.yaml what the format lacks."""
    for name in ("frequency_hz", "altitude_m"):
        setattr(recording, name, getattr(own, name) or getattr(recording, name))
    is_given = own.bearings_deg or own.bearing_first_deg != own.bearing_last_deg
    if own.kind == "imaging" and recording.bearing_rad is None:
        if not is_given:
            own.refuse("lacks 'bearing_first_deg' and 'bearing_last_deg', or 'bearings_deg': this format has no bearings")
        recording.bearing_rad = bearings_of(own, recording.values.shape[2])
    heads = recording.head_rad
    if recording.times_s is None:
        set_times(own, recording, own.kind == "imaging")
    recording.head_rad = np.radians(own.head_first_deg) + (np.zeros(len(recording)) if heads is None else heads)
    return recording
