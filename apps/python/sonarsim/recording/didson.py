"""Sound Metrics DIDSON (.ddf, versions 3 and 4: 8 bits over 90 dB) and ARIS (.aris, version 5: 8 bits).

A header of the file, then frames, each a header and its samples [sample, beam] in the order of the beams. Ranges of a
DIDSON follow Echoview's formula ("DIDSON data files"): the begin of the window counts periods. The distortion of the lens
is not taken out."""
import numpy as np

from .bytes_of_pings import FASTEST_SOUND_M_S, decibel_law, field, frames, law_of, timed_recording

ARIS = b"DDF\x05"
HEADERS = {b"DDF\x03": (512, 256), b"DDF\x04": (1024, 1024), ARIS: (1024, 1024)}    # of the file and of a frame
MAX_SAMPLES = 65536
CLASSIC_PERIOD_S, EXTENDED_PERIOD_S = 0.000512, 0.000572
LAST_CLASSIC_SERIAL, MAX_PERIODS = 18, 1000
FREQUENCIES_HZ = {0: (1.1e6, 1.8e6), 1: (1.8e6, 3e6), 2: (7e5, 1.2e6)}    # of an ARIS 1800, 3000 and 1200: low, high


def read(data, max_pings, own):
    mark = bytes(data[:4])
    if mark not in HEADERS:
        raise ValueError("is a DIDSON file of another version than 3, 4 and 5, which are read")
    file_header, frame_header = HEADERS[mark]
    beams, samples = field(data, "I", 16), field(data, "I", 24)
    name, facts_of = ("ARIS", facts_of_aris) if mark == ARIS else ("DIDSON", facts_of_didson)
    if beams not in ((48, 64, 96, 128) if mark == ARIS else (48, 96)) or not 0 < samples <= MAX_SAMPLES:
        raise ValueError(f"has {beams} beams and {samples} samples, which no {name} has")
    found = frames(data, file_header, frame_header + beams * samples, max_pings)
    if any(bytes(frame[12:16]) != mark for frame in found):
        raise ValueError("has a frame of another version")
    values = [np.frombuffer(frame, np.uint8, offset=frame_header).reshape(samples, beams) for frame in found]
    return timed_recording("imaging", values, own, **facts_of(data, found, own))


def facts_of_aris(data, found, own):
    """Ranges, speed of sound and law of frames."""
    if any(field(frame, "I", 468) != field(data, "I", 24) for frame in found):
        raise ValueError("changes its number of samples; split the file there")
    if any(field(frame, "I", 516) != 1 for frame in found):
        raise ValueError("has samples that are not in the order of the beams; save it again with ARIScope")
    speed = field(found[0], "f", 464)
    if not 0.0 < speed < FASTEST_SOUND_M_S:
        raise ValueError("has a frame without a speed of sound")
    times = [(1e-6 * field(frame, "I", 476), 1e-6 * field(frame, "I", 452)) for frame in found]     # delay, period
    return {"ranges_s": [(delay + 0.5 * period, period) for delay, period in times], "speed_m_s": speed,
            "law": law_of(own), "frequency_hz": FREQUENCIES_HZ.get(field(found[0], "I", 484), (0.0, 0.0))[
                field(found[0], "I", 440) & 1]}


def facts_of_didson(data, found, own):
    """The same; the speed of sound is that of recording.yaml."""
    is_fine, rate_hz, serial = field(data, "i", 12), field(data, "f", 20), field(data, "i", 44)
    if not 0.0 < rate_hz < 1e9:
        raise ValueError("has no rate of samples")
    ranges_s = []
    for frame in found:
        is_classic, periods = serial <= LAST_CLASSIC_SERIAL or field(frame, "i", 192) & 1, field(frame, "i", 52)
        if not 0 <= periods < MAX_PERIODS:
            raise ValueError("has a frame without a window of range")
        window = (1 if is_fine else 2) * (CLASSIC_PERIOD_S if is_classic else EXTENDED_PERIOD_S) * periods
        ranges_s.append((window + 0.5 / rate_hz, 1.0 / rate_hz))
    return {"ranges_s": ranges_s, "law": decibel_law(own, 90.0, 255.0)}
