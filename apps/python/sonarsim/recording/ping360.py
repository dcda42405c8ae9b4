"""Blue Robotics Ping360: messages 2300 and 2301 of the Ping Protocol among any other bytes, 8 bits.

A message is "BR", the length of its payload, its number, two devices, the payload, and the sum of all bytes before."""
import numpy as np

from .bytes_of_pings import field, law_of, timed_recording

MARK = b"BR"
HEADER = 8
SAMPLES_AT = {2300: 14, 2301: 20}   # in the payload, by the message's number
PERIOD_S = 25e-9
GRADIAN = np.pi / 200.0


def read(data, most_pings, own):
    pings = []      # gradians, period, kHz, samples
    at, is_cut_off = data.find(MARK), False
    while at >= 0 and len(pings) < most_pings and at + HEADER <= len(data):
        end, number = at + HEADER + field(data, "H", at + 2), field(data, "H", at + 4)
        is_ours, is_inside = number in SAMPLES_AT, end + 2 <= len(data)
        is_whole = is_ours and is_inside and sum(data[at:end]) & 0xFFFF == field(data, "H", end)
        if is_whole:
            pings += ping_of(data[at + HEADER:end], SAMPLES_AT[number])
        is_cut_off = not is_whole and (is_cut_off or is_ours and not is_inside)
        at = data.find(MARK, end + 2 if is_whole else at + len(MARK))
    if (is_cut_off or at >= 0) and len(pings) < most_pings:
        raise ValueError("is cut off within a message of a Ping360")
    if not pings:
        raise ValueError("is no .raw of an EK60, no .ddf and no .aris, and has no pings of a Ping360")
    # Heads turn clockwise from above.
    return timed_recording("scanning", [ping[3][:, None] for ping in pings], own,
                           [(0.5 * PERIOD_S * ping[1], PERIOD_S * ping[1]) for ping in pings], law=law_of(own),
                           frequency_hz=1e3 * pings[0][2], head_rad=np.array([-GRADIAN * ping[0] for ping in pings]))


def ping_of(payload, samples_at):
    """The ping of a message in a list, which is empty if it has no samples."""
    count = field(payload, "H", samples_at - 2)
    if count > len(payload) - samples_at:
        raise ValueError("has a ping with more samples than their message")
    return [(*(field(payload, "H", at) for at in (2, 6, 8)), np.frombuffer(payload, np.uint8, count, samples_at))
            ] if count else []
