"""Arrays in .npy files and in grey PNG files."""
import tokenize
import warnings

import numpy as np

from .recording import MOST_RANGES, MOST_VALUES, Recording, RecordingError, Soundings

PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"
TYPES = ("u1", "u2", "f4", "f8")
# What numpy and Pillow raise for damaged files.
FAULTS = (ValueError, SyntaxError, tokenize.TokenError, EOFError, TypeError, OverflowError, MemoryError, RecursionError)


def read_array(path):
    """The array of a file, mapped where it is a .npy file; RecordingError if it is neither format or damaged."""
    try:
        with open(path, "rb") as file:
            is_png = file.read(8) == PNG_SIGNATURE
        array = read_png(path) if is_png else np.lib.format.open_memmap(path, mode="r")
    except RecordingError:
        raise
    except OSError as fault:
        raise RecordingError(f"{path}: cannot be read: {fault.strerror or 'it is no whole PNG'}") from fault
    except FAULTS as fault:
        raise RecordingError(f"{path}: is no .npy or PNG file, or is cut off: {fault}") from fault
    if array.dtype.str[1:] not in TYPES:
        raise RecordingError(f"{path}: has values of the type {array.dtype}; uint8, uint16, float32 and float64 are read")
    if not 0 < array.size <= MOST_VALUES:
        raise RecordingError(f"{path}: has {array.size} values; a file of 1 to {MOST_VALUES} is read")
    return array


def read_png(path):
    from PIL import Image   # pylint: disable=import-outside-toplevel
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", Image.DecompressionBombWarning)
        try:
            with Image.open(path, formats=["PNG"]) as picture:
                if picture.mode not in ("L", "I") and not picture.mode.startswith("I;16"):  # Pillow 9: I for 16 bits
                    raise RecordingError(f"{path}: is a picture in colours or with a colour table; save its values in grey")
                return np.asarray(picture).astype(np.uint8 if picture.mode == "L" else np.uint16)
        except Image.DecompressionBombError as fault:
            raise RecordingError(f"{path}: has too many values: {fault}") from fault


def values_of(own, most_pings):
    """The pings of `files` as float32 [ping, range, beam]."""
    arrays = []
    for path in own.files:
        array = pings_of(read_array(path), own.kind, path)[:most_pings - sum(map(len, arrays))]
        if arrays and array.shape[1:] != arrays[0].shape[1:]:
            raise RecordingError(f"{path}: has pings of the shape {array.shape[1:]}, the first file {arrays[0].shape[1:]}")
        if array.size + sum(one.size for one in arrays) > MOST_VALUES:
            raise RecordingError(f"{path}: makes more than {MOST_VALUES} values in all; take fewer pings")
        arrays.append(np.asarray(array, np.float32))
    return np.concatenate(arrays)


def pings_of(array, kind, path):
    """An array of a file as [ping, range, beam]."""
    if array.ndim == 2:
        array = array[None] if kind == "imaging" else array[:, :, None]
    elif kind != "imaging":
        array = array[..., None, None, None]    # of no shape that is read
    if array.ndim != 3 or max(array.shape[1:]) > MOST_RANGES:
        wanted = "[range, beam] or [ping, range, beam]" if kind == "imaging" else "[ping, range]"
        raise RecordingError(f"{path}: has another shape than {wanted}, which the kind {kind} needs, or more than "
                             f"{MOST_RANGES} ranges")
    if kind == "sidescan" and array.shape[1] % 2:
        raise RecordingError(f"{path}: has {array.shape[1]} columns; a side-scan has as many of port as of starboard")
    return two_sides(array[:, :, 0]) if kind == "sidescan" else array


def two_sides(rows):
    """Rows of a side-scan, port from the largest range to nadir and then starboard, as [ping, range, side]."""
    side = rows.shape[1] // 2
    return np.stack([rows[:, side - 1::-1], rows[:, side:]], axis=2)


def soundings_of(own, most_pings):
    arrays = [read_array(path) for path in own.files]
    for array, path in zip(arrays, own.files):
        if array.ndim != 2 or array.shape != arrays[0].shape:
            raise RecordingError(f"{path}: has the shape {list(array.shape)}, not [ping, beam] as {own.files[0]}")
    return Soundings.of([ping for ping in zip(*(array[:most_pings] for array in arrays))])


def bearings_of(own, beams):
    """The bearings of the beams in radians, from the keys of recording.yaml."""
    if own.bearings_deg:
        return np.radians(own.bearings_deg)
    ends = np.radians([own.bearing_first_deg, own.bearing_last_deg])
    share = np.linspace(0.0, 1.0, beams) if beams > 1 else np.array([0.5])
    if own.spread == "angle":
        return ends[0] + share * (ends[1] - ends[0])
    sines = np.sin(ends)
    return np.arcsin(np.clip(sines[0] + share * (sines[1] - sines[0]), -1.0, 1.0))


def set_times(own, recording, are_needed=True):
    """Times and directions of the head from the keys of recording.yaml."""
    count = len(recording)
    if own.times_s and len(own.times_s) < count:
        own.refuse(f"times_s has {len(own.times_s)} times for {count} pings")
    if are_needed and not own.times_s and not own.rate_hz and count > 1:
        own.refuse("lacks the key 'rate_hz' or 'times_s': there are several pings")
    recording.times_s = np.array(own.times_s[:count]) if own.times_s else np.arange(count) / (own.rate_hz or 1.0)
    recording.head_rad = np.radians(own.head_first_deg + np.arange(count) * own.head_step_deg)


def read_arrays(own, most_pings):
    """The recording in the arrays of `files` or `soundings`."""
    recording = Recording(own.kind, own.law, sound_speed_m_s=own.sound_speed_m_s, frequency_hz=own.frequency_hz,
                          altitude_m=own.altitude_m)
    if own.source == "soundings":
        recording.soundings = soundings_of(own, most_pings)
    else:
        recording.values = values_of(own, most_pings)
        recording.first_range_m, recording.range_step_m = own.first_range_m, own.range_step_m
        if own.kind == "imaging":
            recording.bearing_rad = bearings_of(own, recording.values.shape[2])
    set_times(own, recording)
    return recording
