"""Sound Metrics DIDSON (.ddf), versions 3 and 4: 8 bits over 90 dB in the order of the beams.

A header of the file, then frames, each a header and its samples [sample, beam]. Ranges follow Echoview's formula ("DIDSON
data files"): the begin of the window counts periods. The distortion of the lens is not taken out."""
import datetime
import struct

import numpy as np

from .bytes_of_pings import decibel_law, field, frames, timed_recording

HEADERS = {b"DDF\x03": (512, 256), b"DDF\x04": (1024, 1024)}   # of the file and of a frame
MOST_SAMPLES = 65536
CLASSIC_PERIOD_S, EXTENDED_PERIOD_S = 0.000512, 0.000572
LAST_CLASSIC_SERIAL = 18
MOST_PERIODS = 1000


def read(data, most_pings, own):
    mark = bytes(data[:4])
    if mark not in HEADERS:
        raise ValueError("is a DIDSON file of another version than 3, 4 and 5, which are read")
    file_header, frame_header = HEADERS[mark]
    is_fine, beams, rate_hz, samples, serial = (
        field(data, layout, at) for layout, at in (("i", 12), ("i", 16), ("f", 20), ("i", 24), ("i", 44)))
    if beams not in (48, 96) or not 0 < samples <= MOST_SAMPLES:
        raise ValueError(f"has {beams} beams and {samples} samples, which no DIDSON has")
    if not 0.0 < rate_hz < 1e9:
        raise ValueError("has no rate of samples")
    found = frames(data, file_header, frame_header + beams * samples, most_pings)
    if any(bytes(frame[12:16]) != mark for frame in found):
        raise ValueError("has a frame of another version")
    return timed_recording(
        "imaging", [np.frombuffer(frame, np.uint8, offset=frame_header).reshape(samples, beams) for frame in found], own,
        [(window_s(frame, is_fine, serial) + 0.5 / rate_hz, 1.0 / rate_hz) for frame in found],
        law=decibel_law(own, 90.0, 255.0), times_s=np.array([time_s(frame) for frame in found]))


def window_s(frame, is_fine, serial):
    """The two-way travel time at which a frame begins."""
    is_classic = serial <= LAST_CLASSIC_SERIAL or field(frame, "i", 192) & 1
    periods = field(frame, "i", 52)
    if not 0 <= periods < MOST_PERIODS:
        raise ValueError("has a frame without a window of range")
    return (1 if is_fine else 2) * (CLASSIC_PERIOD_S if is_classic else EXTENDED_PERIOD_S) * periods


def time_s(frame):
    """Seconds since 1970, by the clock of the computer that recorded."""
    *date, hour, minute, second, hundredths = struct.unpack_from("<7i", frame, 20)
    try:
        days = (datetime.date(*date) - datetime.date(1970, 1, 1)).days
    except (ValueError, OverflowError):
        raise ValueError("has a frame without a date") from None
    return ((days * 24 + hour) * 60 + minute) * 60 + second + 0.01 * hundredths
