"""Blue Robotics Ping360: messages 2300 and 2301 of the Ping Protocol among any other bytes, 8 bits.

A message is "BR", the length of its payload, its number, two devices, the payload, and the sum of all bytes before."""
import numpy as np

from .log import Log, field, require_one_range, stacked

MARK = b"BR"
HEADER = 8
SAMPLES_AT = {2300: 14, 2301: 20}   # in the payload, by the message's number
PERIOD_S = 25e-9
GRADIAN = np.pi / 200.0


def read(data, most_pings, _frequency_hz=None):
    pings = []      # period, kHz, gradians, samples
    at, is_cut_off = data.find(MARK), False
    while at >= 0 and len(pings) < most_pings and at + HEADER <= len(data):
        end = at + HEADER + field(data, "H", at + 2)
        number = field(data, "H", at + 4)
        is_whole = end + 2 <= len(data) and sum(data[at:end]) & 0xFFFF == field(data, "H", end)
        if is_whole and number in SAMPLES_AT:
            add_ping(data[at + HEADER:end], SAMPLES_AT[number], pings)
        is_cut_off = not is_whole and (is_cut_off or (end + 2 > len(data) and number in SAMPLES_AT))
        at = data.find(MARK, end + 2 if is_whole else at + len(MARK))
    if is_cut_off and len(pings) < most_pings:
        raise ValueError("is cut off within a message of a Ping360")
    if not pings:
        raise ValueError("is no .raw of an EK60, no .ddf and no .aris, and has no pings of a Ping360")
    require_one_range([ping[0] for ping in pings])
    period, frequency_khz = pings[0][:2]
    step_s = PERIOD_S * period
    if not step_s:
        raise ValueError("has a ping without a step of range")
    # Heads turn clockwise from above.
    return Log("scanning", stacked([samples[:, None] for *_, samples in pings]), None, 0.5 * step_s, step_s,
               frequency_hz=1e3 * frequency_khz, head_rad=np.array([-GRADIAN * ping[2] for ping in pings]))


def add_ping(payload, samples_at, pings):
    """Adds the ping of a message, unless it has no samples."""
    count = field(payload, "H", samples_at - 2)
    if count > len(payload) - samples_at:
        raise ValueError("has a ping with more samples than their message")
    if count:
        pings.append((field(payload, "H", 6), field(payload, "H", 8), field(payload, "H", 2),
                      np.frombuffer(payload, np.uint8, count, samples_at)))
