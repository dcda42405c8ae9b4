"""Recordings in files, of instruments or of arrays (.npy, grey PNG), with what recording.yaml adds to them."""
import math
import struct

import numpy as np

from ..data import FAULTS
from . import didson, ek60, oculus, ping360, xtf
from .recording import MAX_RANGES, MAX_VALUES, Recording, RecordingError, Soundings

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
            own.refuse("lacks 'bearing_first_deg' and 'bearing_last_deg', or 'bearings_deg': this format has no bearings")
        recording.bearing_rad = bearings_of(own, recording.values.shape[2])
        if own.bearing_first_deg != 0.0 and recording.values.shape[2] > 1 and np.ptp(recording.bearing_rad) == 0.0:
            own.refuse("has the same bearing for all beams")
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


def read_array(path):
    """The array of a file, mapped where it is a .npy file; RecordingError if it is neither format or damaged."""
    try:
        with open(path, "rb") as file:
            is_png = file.read(8) == b"\x89PNG\r\n\x1a\n"
        array = read_png(path) if is_png else np.lib.format.open_memmap(path, mode="r")
    except OSError as fault:
        raise RecordingError(f"{path}: cannot be read: {fault.strerror or 'the PNG is not whole'}") from fault
    except (*FAULTS, MemoryError) as fault:
        raise RecordingError(f"{path}: cannot be read as a .npy or PNG file: {fault}") from fault
    if array.dtype.str[1:] not in ("u1", "u2", "f4", "f8"):
        raise RecordingError(f"{path}: has values of the type {array.dtype}; uint8, uint16, float32 and float64 are read")
    if not 0 < array.size <= MAX_VALUES:
        raise RecordingError(f"{path}: has {array.size} values; a file of 1 to {MAX_VALUES} is read")
    return array


def read_png(path):
    from PIL import Image   # pylint: disable=import-outside-toplevel
    Image.MAX_IMAGE_PIXELS = None   # the number is checked here
    with Image.open(path, formats=["PNG"]) as picture:
        if picture.width * picture.height > MAX_VALUES:
            raise ValueError("it has too many pixels")
        if picture.mode not in ("L", "I") and not picture.mode.startswith("I;16"):     # Pillow 9: I for 16 bits
            raise ValueError("it is a picture in colours or with a colour table; save its values in grey")
        return np.asarray(picture).astype(np.uint8 if picture.mode == "L" else np.uint16)


def pings_of(array, kind, path):
    """An array of a file as [ping, range, beam]."""
    dimensions = array.ndim
    if dimensions == 2:
        array = array[None] if kind == "imaging" else array[:, :, None]
    if array.ndim != 3 or dimensions == 3 and kind != "imaging" or max(array.shape[1:]) > MAX_RANGES:
        wanted = "[range, beam] or [ping, range, beam]" if kind == "imaging" else "[ping, range]"
        raise RecordingError(f"{path}: has another shape than {wanted}, which the kind {kind} needs, or more than "
                             f"{MAX_RANGES} ranges")
    if kind == "sidescan" and array.shape[1] % 2:
        raise RecordingError(f"{path}: has {array.shape[1]} columns; a side-scan has as many of port as of starboard")
    return two_sides(array[:, :, 0]) if kind == "sidescan" else array


def two_sides(rows):
    """Rows of a side-scan, port from the largest range to nadir and then starboard, as [ping, range, side]."""
    side = rows.shape[1] // 2
    return np.stack([rows[:, side - 1::-1], rows[:, side:]], axis=2)


def bearings_of(own, beams):
    """The bearings of the beams in radians, from the keys of recording.yaml."""
    if own.bearings_deg:
        return np.radians(own.bearings_deg)
    is_sine = own.spread == "sine"
    first, last = (np.sin if is_sine else np.array)(np.radians([own.bearing_first_deg, own.bearing_last_deg]))
    even = first + (np.linspace(0.0, 1.0, beams) if beams > 1 else np.array([0.5])) * (last - first)
    return np.arcsin(np.clip(even, -1.0, 1.0)) if is_sine else even


def read_pings(path, own, max_pings):
    """The recording in a file of `files`."""
    return Recording(own.kind, own.law, "", own.sound_speed_m_s, own.first_range_m, own.range_step_m,
                     values=np.asarray(pings_of(read_array(path), own.kind, path)[:max_pings], np.float32))


def read_soundings(own, max_pings):
    """The recording in the three arrays of `soundings`."""
    arrays = [read_array(path) for path in own.files]
    for array, path in zip(arrays, own.files):
        if array.ndim != 2 or array.shape != arrays[0].shape:
            raise RecordingError(f"{path}: has the shape {list(array.shape)}, not [ping, beam] as {own.files[0]}")
    if own.full_value_is_auto:      # floats have none
        own.law.full_value = float(np.iinfo(arrays[2].dtype).max) if arrays[2].dtype.kind == "u" else 0.0
    arrays = np.array([array[:max_pings] for array in arrays], np.float32)
    arrays[:, ~np.isfinite(arrays).all(axis=0)] = np.nan
    return Recording(own.kind, own.law, "", own.sound_speed_m_s, soundings=Soundings(*arrays))
