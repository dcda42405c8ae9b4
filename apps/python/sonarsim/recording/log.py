"""What one file of an instrument holds, and what the readers of formats have in common.

A reader raises ValueError with a sentence that lacks its subject, the file. struct.error means that the file is cut off.
"""
import dataclasses
import struct

import numpy as np

from .recording import MOST_VALUES, Law

FASTEST_SOUND_M_S = 1e4     # headers with a faster sound are damaged


@dataclasses.dataclass
class Log:
    """The pings of a file; all have the same ranges. 0 and None: not known."""

    kind: str
    values: np.ndarray | None = None    # float32 [ping, range, beam], the nearest range first
    times_s: np.ndarray | None = None   # since 1970
    first_range: float = 0.0            # middle of the first sample; seconds (two-way), or metres
    range_step: float = 0.0
    is_in_metres: bool = False
    sound_speed_m_s: float = 0.0
    frequency_hz: float = 0.0
    altitude_m: float = 0.0
    bearing_rad: np.ndarray | None = None   # of the beams, positive to port
    head_rad: np.ndarray | None = None      # of a scanning sonar in each ping
    law: Law | None = None                  # where the format defines it
    full_value: float = 0.0                 # the largest value that samples can hold; 0 for floats
    soundings: list | None = None           # of each ping (two-way seconds, radians, intensities)
    sounding_speeds_m_s: list | None = None     # the speed of sound in each of them


def field(data, layout, at):
    """The number at an offset, little-endian. struct.error beyond the end."""
    return struct.unpack_from("<" + layout, data, at)[0]


def stacked(pings):
    """Arrays of pings of one shape as float32 [ping, ...]. ValueError if the shape changes, or if they are too many."""
    if any(ping.shape != pings[0].shape for ping in pings):
        raise ValueError("changes its range; split the file there")
    if len(pings) * pings[0].size > MOST_VALUES:
        raise ValueError(f"has more than {MOST_VALUES} values; take fewer pings")
    return np.array(pings, np.float32)


def frames(data, at, length, most_pings):
    """The frames of one length behind the header of a file, as views."""
    whole, rest = divmod(max(len(data) - at, 0), length)
    if rest and whole < most_pings:
        raise ValueError("is cut off within a frame")
    if not whole:
        raise ValueError("has no frames")
    view = memoryview(data)
    return [view[at + k * length:at + (k + 1) * length] for k in range(min(whole, most_pings))]


def require_one_range(ranges):
    """ValueError unless the frames have one range, each a tuple of numbers."""
    if len(set(ranges)) != 1:
        raise ValueError("changes its range; split the file there")
