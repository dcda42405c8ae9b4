"""What the readers of instruments' files have in common.

A reader takes the bytes of a file, the number of pings to read and the recording.yaml, and returns a Recording. It raises
ValueError with a sentence that lacks its subject, the file. struct.error means that the file is cut off."""
import dataclasses
import struct

import numpy as np

from .recording import MAX_VALUES, Law, Recording

FASTEST_SOUND_M_S = 1e4     # headers with a faster sound are damaged


def field(data, layout, at):
    """The number at an offset, little-endian. struct.error beyond the end."""
    return struct.unpack_from("<" + layout, data, at)[0]


def frames(data, at, length, max_pings):
    """The frames of one length behind the header of a file, as views."""
    whole, rest = divmod(max(len(data) - at, 0), length)
    if rest and whole < max_pings:
        raise ValueError("is cut off within a frame")
    if not whole:
        raise ValueError("has no frames")
    return [memoryview(data)[at + k * length:at + (k + 1) * length] for k in range(min(whole, max_pings))]


def pings_among(data, mark, header, max_pings, length_of, pings_of):
    """The pings of the messages that begin with a mark, among any other bytes. `length_of(at)` is the length of the one at
    an offset, 0 if it is not read; `pings_of` gives a list of its pings, None if its sum is wrong."""
    found, at, is_cut_off = [], data.find(mark), False
    while at >= 0 and len(found) < max_pings and at + header <= len(data):
        length = length_of(at)
        is_inside = at + length <= len(data)
        pings = pings_of(memoryview(data)[at:at + length]) if length and is_inside else None
        is_cut_off = pings is None and (is_cut_off or not is_inside)
        found += pings or []
        at = data.find(mark, at + (1 if pings is None else length))
    if (is_cut_off or at >= 0) and len(found) < max_pings:
        raise ValueError("is cut off within a message")
    return found


def stacked(pings):
    """Arrays of pings of one shape as float32 [ping, ...]. ValueError if they differ or are too many."""
    if len({ping.shape for ping in pings}) > 1:
        raise ValueError("changes its range; split the file there")
    if len(pings) * pings[0].size > MAX_VALUES:
        raise ValueError(f"has more than {MAX_VALUES} values; take fewer pings")
    return np.array(pings, np.float32)


def timed_recording(kind, pings, own, ranges_s, speed_m_s=0.0, **more):
    """The Recording of pings whose first sample and step are two-way travel times, a tuple for each ping."""
    if len(set(ranges_s)) > 1:
        raise ValueError("changes its range; split the file there")
    (first_s, step_s), speed = ranges_s[0], own.sound_speed_m_s or speed_m_s
    if not step_s > 0.0:
        raise ValueError("has a ping without a step of range")
    if not speed:
        raise ValueError("has no speed of sound; add `sound_speed_m_s` to recording.yaml")
    return Recording(kind, sound_speed_m_s=speed, first_range_m=0.5 * speed * first_s, range_step_m=0.5 * speed * step_s,
                     values=stacked(pings), **more)


def law_of(own, full_value=0.0):
    """The law of recording.yaml; `full_value` is the largest value that samples can hold, 0 for floats."""
    if own.law is None:
        raise ValueError("has a format that does not say what a value means; add `law` to recording.yaml")
    is_known = own.full_value_is_auto and full_value
    return dataclasses.replace(own.law, full_value=full_value if is_known else own.law.full_value)


def decibel_law(own, range_db, full_value):
    """The law of a format whose values are decibels."""
    if own.law:
        raise ValueError("has values in decibels by its format; leave `law` out of recording.yaml")
    return Law("decibel", range_db=range_db, full_value=full_value)
