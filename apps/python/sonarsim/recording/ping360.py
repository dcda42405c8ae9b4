"""Blue Robotics Ping360: messages 2300 and 2301 of the Ping Protocol among any other bytes, 8 bits.

A message is "BR", the length of its payload, its number, two devices, the payload, and the sum of all bytes before."""
import collections

import numpy as np

from .bytes_of_pings import field, law_of, pings_among, timed_recording

MARK, HEADER = b"BR", 8
SAMPLES_AT = {2300: 14, 2301: 20}   # in the payload, by the message's number
PERIOD_S = 25e-9
MAX_ODD = 0.1              # share of the pings


def read(data, max_pings, own):
    def length_of(at):
        return HEADER + field(data, "H", at + 2) + 2 if field(data, "H", at + 4) in SAMPLES_AT else 0
    found = pings_among(data, MARK, HEADER, max_pings, length_of, pings_of)
    if not found:
        raise ValueError("has no pings of a Ping360, and is not a .raw of an EK60, a .ddf or an .aris")
    shapes = collections.Counter((periods, len(samples)) for periods, samples in found)
    usual, odd = shapes.most_common(1)[0][0], len(found) - shapes.most_common(1)[0][1]
    if odd <= MAX_ODD * len(found):    # the sonar sends one with another length where its settings change
        found = [ping for ping in found if (ping[0], len(ping[1])) == usual]
    recording = timed_recording("scanning", [samples[:, None] for _, samples in found], own,
                                [(0.5 * PERIOD_S * periods, PERIOD_S * periods) for periods, _ in found], law=law_of(own))
    if len(shapes) > 1:
        recording.notes.append(f"{odd} of {odd + len(found)} pings have another length and are left out")
    return recording


def pings_of(message):
    """The (periods of a sample, samples) of a message in a list, empty if it has none; None if its sum is wrong."""
    if sum(message[:-2]) & 0xFFFF != field(message, "H", len(message) - 2):
        return None
    payload, samples_at = message[HEADER:-2], SAMPLES_AT[field(message, "H", 4)]
    count = field(payload, "H", samples_at - 2)
    if count > len(payload) - samples_at:
        raise ValueError("has a ping with more samples than their message")
    return [(field(payload, "H", 6), np.frombuffer(payload, np.uint8, count, samples_at))] if count else []
