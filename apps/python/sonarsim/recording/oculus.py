"""Blueprint Subsea Oculus: simple ping results, versions 1 and 2, among any other bytes.

The messages of the Oculus SDK as the sonar sends them, one after the other, or the log of a program that stores them
unpacked. A header of 16 bytes: 0x4f53, two devices, the kind of message, its version, the length of what follows."""
import numpy as np

from .log import Log, field, stacked

MARK = b"SO"
HEADER = 16
PING_RESULT = 0x23
FLAGS_AT, SENDS_GAIN = 20, 4
# Offsets of the fields in a message of each version.
FIRST = {"frequency": 61, "sound_speed": 85, "value_size": 97, "range_step": 98, "ranges": 106, "beams": 108,
         "image_at": 110, "image_bytes": 114, "bearings": 122}
SECOND = {"frequency": 97, "sound_speed": 145, "value_size": 161, "range_step": 162, "ranges": 170, "beams": 172,
          "image_at": 190, "image_bytes": 194, "bearings": 202}
TYPES = {0: "<u1", 1: "<u2", 3: "<u4"}


def read(data, most_pings, _frequency_hz=None):
    pings, at, is_cut_off = [], data.find(MARK), False
    while at >= 0 and len(pings) < most_pings and at + HEADER <= len(data):
        is_result = field(data, "H", at + 6) == PING_RESULT
        end = at + HEADER + field(data, "I", at + 10)
        is_whole = is_result and end <= len(data)
        if is_whole:
            pings.append(ping_of(memoryview(data)[at:end]))
        is_cut_off = not is_whole and (is_cut_off or is_result)
        at = data.find(MARK, end if is_whole else at + 1)
    if is_cut_off and len(pings) < most_pings:
        raise ValueError("is cut off within a message of an Oculus")
    if not pings:
        raise ValueError("has no ping result of an Oculus")
    first = pings[0]
    if any(abs(ping["range_step"] - first["range_step"]) > 1e-4 * first["range_step"] for ping in pings):
        raise ValueError("changes its range; split the file there")
    return Log("imaging", stacked([ping["image"] for ping in pings]), None, 0.5 * first["range_step"],
               first["range_step"], True, first["sound_speed"], first["frequency"],
               bearing_rad=first["bearing_rad"], full_value=float(np.iinfo(first["image"].dtype).max))


def ping_of(message):
    """The ping of a whole message."""
    at = SECOND if field(message, "H", 8) == 2 else FIRST
    if field(message, "B", FLAGS_AT) & SENDS_GAIN:
        raise ValueError("has pings with a gain for each range, which are not read; record without `send gain`")
    size = field(message, "B", at["value_size"])
    if size not in TYPES:
        raise ValueError("has values of 24 bits or of no known size")
    ping = {key: field(message, "d", at[key]) for key in ("frequency", "sound_speed", "range_step")}
    ranges, beams = field(message, "H", at["ranges"]), field(message, "H", at["beams"])
    image_at, image_bytes = field(message, "I", at["image_at"]), field(message, "I", at["image_bytes"])
    dtype = np.dtype(TYPES[size])
    values = ranges * beams
    if not (values and 0.0 < ping["range_step"] < 1e3 and image_bytes == values * dtype.itemsize
            and image_at + image_bytes <= len(message) and at["bearings"] + 2 * beams <= len(message)):
        raise ValueError("has a ping whose image does not fit its message")
    ping["image"] = np.frombuffer(message, dtype, values, image_at).reshape(ranges, beams)
    # The message's bearings are hundredths of a degree, negative to the left.
    ping["bearing_rad"] = -np.radians(0.01 * np.frombuffer(message, "<i2", beams, at["bearings"]))
    return ping
