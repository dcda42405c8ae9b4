"""XTF (Triton Imaging, "eXtended Triton Format (XTF) Rev. 40"): side-scans, and the soundings of records of the type 28.

Of each ping the first port channel and the first starboard channel are read. Samples are unsigned 8, 16 or 32 bits or
IEEE floats, times 2 to the power of minus the channel's weight."""
import datetime
import math

import numpy as np

from .log import Log, field, stacked

FILE_HEADER, CHANNEL_INFO, PING_HEADER, CHANNEL_HEADER = 1024, 128, 256, 64
SIDE_SCAN, MULTIBEAM = 0, 28
MOST_CHANNELS = 64
LONGEST_RANGE_M = 1e5
# By the field SampleFormat, or in older files, where it is 0, by the number of bytes.
SAMPLES = {8: "<u1", 3: "<u2", 2: "<u4", 5: "<f4"}
OLDER_SAMPLES = {1: "<u1", 2: "<u2", 4: "<u4"}
SOUNDING = np.dtype({"names": ["intensity", "two_way_s", "angle_deg"], "formats": ["<f8"] * 3, "offsets": [4, 16, 32],
                     "itemsize": 64})


def read(data, most_pings, _frequency_hz=None):
    """The side-scan pings; those that lack a side are left out."""
    channels, pings = channels_of(data), []
    for record in records(data, len(channels), SIDE_SCAN):
        sides = sides_of(record, channels)
        if len(sides) == 2:
            pings.append((record, sides))
        if len(pings) == most_pings:
            break
    if not pings:
        raise ValueError("has no side-scan pings")
    record, first = pings[0]
    port = first[1]
    for k, (_, sides) in enumerate(pings):
        for side in sides.values():
            is_alike = len(side["samples"]) == len(port["samples"]) and (
                abs(side["range_m"] - port["range_m"]) < 0.01 * port["range_m"])
            if not is_alike:
                raise ValueError(f"ping {k} has {extent(side)}, the first ping {extent(port)}; "
                                 "split the file where the range changes")
    values = stacked([np.stack([sides[1]["samples"][::-1], sides[2]["samples"]], axis=1) for _, sides in pings])
    step = port["range_m"] / len(port["samples"])
    altitude = field(record, "f", 196)
    return Log("sidescan", values, np.array([time_s(own) for own, _ in pings]), 0.5 * step, step, True,
               sound_speed(record), port["frequency_hz"], altitude if 0.0 < altitude < math.inf else 0.0,
               full_value=max(side["full_value"] for _, sides in pings for side in sides.values()))


def read_soundings(data, most_pings, _frequency_hz=None):
    pings, times, speeds = [], [], []
    for record in records(data, len(channels_of(data)), MULTIBEAM):
        count = field(record, "H", 4)
        if PING_HEADER + count * SOUNDING.itemsize > len(record):
            raise ValueError("has more soundings than their record")
        beams = np.frombuffer(record, SOUNDING, count, PING_HEADER)
        beams = beams[beams["two_way_s"] > 0.0]
        if not ((beams["two_way_s"] < 100.0) & (np.abs(beams["angle_deg"]) <= 180.0) & (beams["intensity"] >= 0.0)
                & (beams["intensity"] < 1e30)).all():
            raise ValueError("has a sounding with impossible numbers")
        pings.append((beams["two_way_s"], np.radians(beams["angle_deg"]), beams["intensity"]))
        times.append(time_s(record))
        speeds.append(sound_speed(record))
        if len(pings) == most_pings:
            break
    return Log("soundings", times_s=np.array(times), soundings=pings, sounding_speeds_m_s=speeds)


def channels_of(data):
    """(type, samples) of each channel: type 1 is port, 2 starboard."""
    if field(data, "B", 0) != 0x7B:
        raise ValueError("is no XTF file")
    count = field(data, "H", 166) + field(data, "H", 168)
    if not 0 < count <= MOST_CHANNELS:
        raise ValueError("has no channels of a sonar, or too many")
    channels = []
    for at in range(256, 256 + count * CHANNEL_INFO, CHANNEL_INFO):
        kind, form, size = field(data, "B", at), field(data, "B", at + 74), field(data, "H", at + 6)
        samples = SAMPLES.get(form) if form else OLDER_SAMPLES.get(size)
        if kind in (1, 2) and samples is None:
            raise ValueError(f"has samples of the format {form}; those of 8, 16 and 32 bits and IEEE floats are read")
        channels.append((kind, samples))
    return channels


def records(data, channels, kind):
    """Yields the records of a type. Six channels fit into the first 1,024 bytes, eight into each further 1,024."""
    view = memoryview(data)
    at = FILE_HEADER * (1 + max(0, channels - 6 + 7) // 8)
    while at < len(data):
        if field(data, "H", at) != 0xFACE:
            raise ValueError("has no record where one should begin")
        length = field(data, "I", at + 10)
        if not 14 <= length <= len(data) - at:
            raise ValueError("is cut off within a record")
        if field(data, "B", at + 2) == kind:
            yield view[at:at + length]
        at += length


def sides_of(record, channels):
    """The sides of a ping by the type of their channel: 1 is port, its last sample at nadir, 2 starboard."""
    sides, at = {}, PING_HEADER
    for _ in range(field(record, "H", 4)):
        number = field(record, "H", at)
        if number >= len(channels):
            raise ValueError("has a ping of a channel that its header lacks")
        kind, samples = channels[number]
        range_m, weight = field(record, "f", at + 4), field(record, "h", at + 58)
        count = field(record, "I", at + 42)
        dtype = np.dtype(samples or "<u2")
        begin = at + CHANNEL_HEADER
        if begin + count * dtype.itemsize > len(record):
            raise ValueError("has more samples than their record")
        if kind in (1, 2) and kind not in sides and count and 0.0 < range_m < LONGEST_RANGE_M:
            factor = 2.0 ** -max(-64, min(64, weight))
            sides[kind] = {
                "samples": np.float32(factor) * np.frombuffer(record, dtype, count, begin).astype(np.float32),
                "range_m": range_m, "frequency_hz": 1e3 * field(record, "H", at + 26),
                "full_value": factor * np.iinfo(dtype).max if dtype.kind == "u" else 0.0}
        at = begin + count * dtype.itemsize
    return sides


def extent(side):
    return f"{len(side['samples'])} samples over {side['range_m']:g} m"


def time_s(record):
    """Seconds since 1970; of the day alone where there is no date."""
    year, month, day, hour, minute, second, hundredths = (
        field(record, "H", 14), *(field(record, "B", at) for at in range(16, 22)))
    try:
        days = (datetime.date(year, month, day) - datetime.date(1970, 1, 1)).days
    except ValueError:
        days = 0
    return 86400.0 * days + 3600.0 * hour + 60.0 * minute + second + 0.01 * hundredths


def sound_speed(record):
    """The computed speed of sound, or twice the field of the older layout; 0 if neither can be one."""
    computed, half = field(record, "f", 72), field(record, "f", 32)
    # Some programs write the whole speed into the field of the half.
    speed = computed if computed > 0.0 else half * (2.0 if half < 1000.0 else 1.0)
    return speed if 300.0 <= speed <= 1e4 else 0.0
