"""Simrad EK60, ES60, ES70 (.raw): the power in dB re 1 W, 200 dB from the value 0 to 200, without a TVG.

A datagram is its length, a type of four letters, the time in 100 ns since 1601, its content, and its length again
("ER60 file format"). Offsets count from the type on."""
import math

import numpy as np

from .bytes_of_pings import FASTEST_SOUND_M_S, decibel_law, field, timed_recording

DATA_AT, DB_PER_STEP, RANGE_DB = 84, 10.0 * math.log10(2.0) / 256.0, 200.0


def read(data, max_pings, own):
    pings = [ping for datagram in datagrams(data) if datagram[:4] == b"RAW0" for ping in power_of(datagram)]
    if not pings:
        raise ValueError("has no power of an EK60 (RAW0 datagrams)")
    all_hz = sorted({ping["frequency_hz"] for ping in pings})
    near = [one for one in all_hz if abs(one - (own.frequency_hz or one)) < 1e-3 * one]
    if not near or len(near) > 1 and not own.frequency_hz:
        raise ValueError(f"has channels of {', '.join(f'{one:.0f}' for one in all_hz)} Hz; choose one of them with "
                         "`frequency_hz`")
    pings = [ping for ping in pings if ping["frequency_hz"] == near[0]][:max_pings]
    recording = timed_recording("echosounder", [ping["steps"][:, None] for ping in pings], own,
        [(ping["offset"] * ping["sample_s"], ping["sample_s"]) for ping in pings], pings[0]["sound_speed_m_s"],
        law=decibel_law(own, RANGE_DB, RANGE_DB), frequency_hz=near[0])
    recording.values = np.maximum(np.float32(DB_PER_STEP) * recording.values + np.float32(RANGE_DB), np.float32(0.0))
    return recording


def datagrams(data):
    """Yields each datagram from its type on, as a view."""
    view, at = memoryview(data), 0
    while at < len(data):
        length = field(data, "I", at)
        if not 12 <= length <= len(data) - at - 4:
            raise ValueError("has no datagram where one should begin, or is cut off")
        if field(data, "I", at + 4 + length) != length:
            raise ValueError("has a datagram whose two lengths differ")
        yield view[at + 4:at + 4 + length]
        at += length + 8


def power_of(datagram):
    """The ping of a RAW0 datagram in a list, which is empty if it holds only angles."""
    frequency, sample_s, speed = (field(datagram, "f", at) for at in (20, 36, 40))
    offset, count = field(datagram, "i", 76), field(datagram, "i", 80)
    if not (0.0 < sample_s < 1.0 and 0.0 < speed < FASTEST_SOUND_M_S and math.isfinite(frequency)
            and offset >= 0 and count >= 0):
        raise ValueError("has a ping with impossible numbers")
    if not field(datagram, "h", 14) & 1 or not count:
        return []
    if count > (len(datagram) - DATA_AT) // 2:
        raise ValueError("has more samples than their datagram")
    return [{"frequency_hz": frequency, "sample_s": sample_s, "sound_speed_m_s": speed, "offset": offset,
             "steps": np.frombuffer(datagram, "<i2", count, DATA_AT)}]
