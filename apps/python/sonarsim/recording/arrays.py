"""Arrays in .npy files and in grey PNG files."""
import numpy as np

from ..data import FAULTS
from .recording import MAX_RANGES, MAX_VALUES, Recording, RecordingError, Soundings


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
