"""Recordings in files: joins them, and takes from recording.yaml what a format lacks."""
import math
import struct

import numpy as np

from . import didson, ek60, oculus, ping360, xtf
from .arrays import bearings_of, read_pings
from .recording import MAX_VALUES, RecordingError

LARGEST_FILE = 1 << 31
READERS = {     # of `logs`, by an offset and the bytes there
    (0, b"DDF"): didson.read, (4, b"CON0"): ek60.read, (4, b"XML0"): "an EK80", (4, b"#"): "a .kmall",
    (4, b"\x02I"): "an .all"}


def read_files(own, max_pings):
    """The recording in the files of `files`, `xtf`, `oculus` or `logs`."""
    parts, pings, values = [], 0, 0
    for path in own.files:
        if pings == max_pings:
            break
        part = (read_pings if own.source == "files" else read_file)(path, own, max_pings - pings)
        if part.kind != own.kind:
            raise RecordingError(f"{path}: has pings of the kind {part.kind}, and recording.yaml says {own.kind}")
        pings, values = pings + len(part), values + part.values.size
        if values > MAX_VALUES:
            raise RecordingError(f"{path}: makes more than {MAX_VALUES} values in all; take fewer pings")
        parts.append(part)
    recording = joined(own, parts)
    if own.kind == "imaging" and recording.bearing_rad is None:
        if own.source != "files" and not own.bearings_deg and own.bearing_first_deg == own.bearing_last_deg:
            own.refuse("lacks 'bearing_first_deg' and 'bearing_last_deg', or 'bearings_deg': this format has no "
                       "bearings")
        recording.bearing_rad = bearings_of(own, recording.values.shape[2])
    return recording


def read_file(path, own, max_pings):
    try:
        if path.stat().st_size > LARGEST_FILE:
            raise ValueError("is larger than 2 GB; split it")
        content = path.read_bytes()
        read = {"xtf": xtf.read, "oculus": oculus.read}.get(own.source) or next(
            (reader for (at, mark), reader in READERS.items() if content.startswith(mark, at)), ping360.read)
        if isinstance(read, str):
            raise ValueError(f"is {read} file, which is not read; write its pings as arrays (docs/calibrate.md)")
        return read(content, max_pings, own)
    except OSError as fault:
        raise RecordingError(f"{path}: cannot be read: {fault.strerror}") from fault
    except struct.error as fault:
        raise RecordingError(f"{path}: is cut off") from fault
    except ValueError as fault:
        raise RecordingError(f"{path}: {fault}") from fault


def joined(own, parts):
    """The recordings of several files as one; RecordingError if one has other ranges, beams or levels than the first."""
    first = parts[0]
    # Sonars round these; chosen.
    shares = {"first_range_m": 0.01, "range_step_m": 0.01 if own.source == "xtf" else 1e-4}
    for path, part in zip(own.files, parts):
        others = [name for name, share in shares.items()
                  if not math.isclose(getattr(part, name) or 0.0, getattr(first, name) or 0.0, rel_tol=share)]
        others += ["scale of levels"] * (part.law != first.law)
        others += ["shape of its pings"] * (part.values.shape[1:] != first.values.shape[1:])
        if others:
            raise RecordingError(f"{path}: has another {others[0]} than the first file; split the recording there")
    first.values = np.concatenate([part.values for part in parts])
    return first
