"""Sound Metrics ARIS (.aris), version 5 of the DIDSON format: 8 bits in the order of the beams.

A header of 1,024 bytes, then frames, each a header of 1,024 bytes and its samples [sample, beam]."""
import numpy as np

from .bytes_of_pings import FASTEST_SOUND_M_S, field, frames, law_of, timed_recording

MARK = b"DDF\x05"
HEADER = 1024
BEAMS = (48, 64, 96, 128)
MOST_SAMPLES = 65536


def read(data, most_pings, own):
    beams, samples = field(data, "I", 16), field(data, "I", 24)
    if beams not in BEAMS or not 0 < samples <= MOST_SAMPLES:
        raise ValueError(f"has {beams} beams and {samples} samples, which no ARIS has")
    found = frames(data, HEADER, HEADER + beams * samples, most_pings)
    for frame in found:
        if bytes(frame[12:16]) != MARK:
            raise ValueError("has a frame of another version")
        if field(frame, "I", 468) != samples:
            raise ValueError("changes its number of samples; split the file there")
        if field(frame, "I", 516) != 1:
            raise ValueError("has samples that are not in the order of the beams; save it again with ARIScope")
    speed = field(found[0], "f", 464)
    if not 0.0 < speed < FASTEST_SOUND_M_S:
        raise ValueError("has a frame without a speed of sound")
    times = [(1e-6 * field(frame, "I", 476), 1e-6 * field(frame, "I", 452)) for frame in found]     # delay, period
    return timed_recording(
        "imaging", [np.frombuffer(frame, np.uint8, offset=HEADER).reshape(samples, beams) for frame in found], own,
        [(delay + 0.5 * period, period) for delay, period in times], speed, law=law_of(own),
        times_s=np.array([1e-6 * field(frame, "Q", 20) for frame in found]))
