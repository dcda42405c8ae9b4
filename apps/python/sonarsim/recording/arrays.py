"""Arrays in .npy files and in grey PNG files."""
import math
import warnings

import numpy as np

from .recording import MOST_RANGES, MOST_VALUES, RecordingError, Soundings

PNG_SIGNATURE = b"\x89PNG\r\n\x1a\n"
FAULTS = (ValueError, SyntaxError, EOFError, TypeError, OverflowError, MemoryError, RecursionError)


def read_array(path):
    """The array of a file, mapped where it is a .npy file; RecordingError if it is neither format or damaged."""
    try:
        with open(path, "rb") as file:
            is_png = file.read(8) == PNG_SIGNATURE
        array = read_png(path) if is_png else np.lib.format.open_memmap(path, mode="r")
    except RecordingError:
        raise
    except OSError as fault:
        why = fault.strerror or "is no PNG, or damaged"
        raise RecordingError(f"{path}: cannot be read: {why}") from fault
    except FAULTS as fault:
        raise RecordingError(f"{path}: is no .npy or PNG file, or is cut off: {fault}") from fault
    if array.dtype.kind + str(array.dtype.itemsize) not in ("u1", "u2", "f4", "f8"):
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
                # Pillow 9 has the mode I for 16 bits.
                if picture.mode not in ("L", "I") and not picture.mode.startswith("I;16"):
                    raise RecordingError(f"{path}: is a picture in colours or with a colour table; "
                                         "save its values in grey")
                array = np.asarray(picture)
        except Image.DecompressionBombError as fault:
            raise RecordingError(f"{path}: has more than {MOST_VALUES} values") from fault
    return array if array.dtype == np.uint8 else array.astype(np.uint16)


def values_of(own, most_pings):
    """The pings of `files` as float32 [ping, range, beam]."""
    arrays, count, values = [], 0, 0
    for path in own.files:
        array = pings_of(read_array(path), own.kind, path)[:most_pings - count]
        if arrays and array.shape[1:] != arrays[0].shape[1:]:
            raise RecordingError(f"{path}: has {shape_text(array)} ranges and beams, the first file "
                                 f"{shape_text(arrays[0])}")
        values += array.size
        if values > MOST_VALUES:
            raise RecordingError(f"{path}: makes more than {MOST_VALUES} values in all; take fewer pings")
        arrays.append(np.asarray(array, np.float32))
        count += len(array)
        if count == most_pings:
            break
    return np.concatenate(arrays)


def shape_text(array):
    return " x ".join(str(length) for length in array.shape[1:])


def pings_of(array, kind, path):
    """An array of a file as [ping, range, beam]."""
    if kind == "imaging":
        array = array[None] if array.ndim == 2 else array
    elif array.ndim == 2:
        array = array[:, :, None]
    if array.ndim != 3 or max(array.shape[1:]) > MOST_RANGES:
        wanted = "[range, beam] or [ping, range, beam]" if kind == "imaging" else "[ping, range]"
        raise RecordingError(f"{path}: has the shape {list(array.shape)}; the kind {kind} needs {wanted} with at "
                             f"most {MOST_RANGES} ranges")
    if kind != "sidescan":
        return array
    if array.shape[1] % 2:
        raise RecordingError(f"{path}: has {array.shape[1]} columns; a side-scan has as many of port as of starboard")
    return two_sides(array[:, :, 0])


def two_sides(rows):
    """Rows of a side-scan, port from the largest range to nadir and then starboard, as [ping, range, side]."""
    side = rows.shape[1] // 2
    return np.stack([rows[:, side - 1::-1], rows[:, side:]], axis=2)


def read_soundings(own, most_pings):
    arrays = [read_array(path) for path in own.files]
    for array, path in zip(arrays, own.files):
        if array.ndim != 2 or array.shape != arrays[0].shape:
            raise RecordingError(f"{path}: has the shape {list(array.shape)}, and must be [ping, beam] as "
                                 f"{own.files[0]}")
    arrays = np.array([np.asarray(array[:most_pings], np.float32) for array in arrays])
    arrays[:, ~np.isfinite(arrays).all(axis=0)] = np.nan
    return Soundings(*arrays)


def bearings_of(own, beams):
    """The bearings of the beams in radians, from the keys of recording.yaml."""
    if own.bearings_deg:
        return np.radians(own.bearings_deg)
    first, last = math.radians(own.bearing_first_deg), math.radians(own.bearing_last_deg)
    share = np.linspace(0.0, 1.0, beams) if beams > 1 else np.array([0.5])
    if own.spread == "angle":
        return first + share * (last - first)
    return np.arcsin(np.clip(math.sin(first) + share * (math.sin(last) - math.sin(first)), -1.0, 1.0))


def set_times(own, recording):
    """Times and directions of the head from the keys of recording.yaml."""
    count = len(recording)
    if own.times_s and len(own.times_s) < count:
        own.refuse(f"times_s has {len(own.times_s)} times for {count} pings")
    if not own.times_s and not own.rate_hz and count > 1:
        own.refuse("lacks the key 'rate_hz' or 'times_s': there are several pings")
    numbers = np.arange(count)
    recording.times_s = np.array(own.times_s[:count]) if own.times_s else numbers / (own.rate_hz or 1.0)
    recording.head_rad = np.radians(own.head_first_deg + numbers * own.head_step_deg)


def read_arrays(own, recording, most_pings):
    """Fills the recording from `files` or `soundings`."""
    if own.source == "soundings":
        recording.soundings = read_soundings(own, most_pings)
    else:
        recording.values = values_of(own, most_pings)
        recording.first_range_m, recording.range_step_m = own.first_range_m, own.range_step_m
        if own.kind == "imaging":
            recording.bearing_rad = bearings_of(own, recording.values.shape[2])
    set_times(own, recording)
