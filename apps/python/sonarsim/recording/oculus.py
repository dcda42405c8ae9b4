"""Blueprint Subsea Oculus: simple ping results, versions 1 and 2, among any other bytes.

The messages of the Oculus SDK as the sonar sends them, one after the other, or the log of a program that stores them
unpacked. A header of 16 bytes: 0x4f53, two devices, the kind of message, its version, the length of what follows."""
import numpy as np

from .bytes_of_pings import field, law_of, pings_among, stacked
from .recording import Recording

MARK, HEADER, PING_RESULT = b"SO", 16, 0x23
FLAGS_AT, SENDS_GAIN = 20, 4
# The offsets of speed of sound, step of range, size of a value, ranges, beams, image, its bytes, and bearings.
FIRST = (85, 98, 97, 106, 108, 110, 114, 122)
SECOND = (145, 162, 161, 170, 172, 190, 194, 202)
LAYOUTS = "ddBHHII"
TYPES = {0: "<u1", 1: "<u2", 3: "<u4"}


def read(data, max_pings, own):
    def length_of(at):
        return HEADER + field(data, "I", at + 10) if field(data, "H", at + 6) == PING_RESULT else 0
    pings = pings_among(data, MARK, HEADER, max_pings, length_of, lambda message: [ping_of(message)])
    if not pings:
        raise ValueError("has no ping result of an Oculus")
    speed, step, image, bearings = pings[0]
    if any(abs(ping[1] - step) > 1e-4 * step for ping in pings):
        raise ValueError("changes its range; split the file there")
    return Recording("imaging", law_of(own, float(np.iinfo(image.dtype).max)), sound_speed_m_s=own.sound_speed_m_s or speed,
                     first_range_m=0.5 * step, range_step_m=step, bearing_rad=bearings,
                     values=stacked([ping[2] for ping in pings]))


def ping_of(message):
    """(speed of sound, step of range, image [range, beam], bearings) of a whole message."""
    at = SECOND if field(message, "H", 8) == 2 else FIRST
    if field(message, "B", FLAGS_AT) & SENDS_GAIN:
        raise ValueError("has pings with a gain for each range, which are not read; record without `send gain`")
    speed, step, size, ranges, beams, image_at, image_bytes = map(
        lambda layout, offset: field(message, layout, offset), LAYOUTS, at)
    if size not in TYPES:
        raise ValueError("has values of 24 bits or of no known size")
    dtype, bearings_at = np.dtype(TYPES[size]), at[-1]
    if not (ranges * beams and 0.0 < step < 1e3 and image_bytes == ranges * beams * dtype.itemsize
            and image_at + image_bytes <= len(message) and bearings_at + 2 * beams <= len(message)):
        raise ValueError("has a ping whose image does not fit its message")
    image = np.frombuffer(message, dtype, ranges * beams, image_at).reshape(ranges, beams)
    # The message's bearings are hundredths of a degree, negative to the left.
    return speed, step, image, -np.radians(0.01 * np.frombuffer(message, "<i2", beams, bearings_at))
