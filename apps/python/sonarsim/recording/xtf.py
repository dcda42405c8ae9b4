"""XTF (Triton Imaging, "eXtended Triton Format (XTF) Rev. 40"): side-scans.

Of each ping the first port channel and the first starboard channel are read. Samples are unsigned 8, 16 or 32 bits or
IEEE floats, times 2 to the power of minus the channel's weight."""
import numpy as np

from .bytes_of_pings import field, law_of, stacked
from .recording import Recording

FILE_HEADER, CHANNEL_INFO, PING_HEADER, CHANNEL_HEADER = 1024, 128, 256, 64
SIDE_SCAN = 0
PORT, STARBOARD = 1, 2
MAX_CHANNELS, LONGEST_RANGE_M = 64, 1e5
# By the field SampleFormat, or in older files, where it is 0, by minus the number of bytes.
SAMPLES = {8: "<u1", 3: "<u2", 2: "<u4", 5: "<f4", -1: "<u1", -2: "<u2", -4: "<u4"}


def read(data, max_pings, own):
    """The side-scan pings; those that lack a side are left out."""
    channels, pings = channels_of(data), []
    first = full_value = 0.0
    for record in side_scans(data, len(channels)):
        sides = sides_of(record, channels)
        if len(sides) < 2:
            continue
        first = first or sides[PORT]
        for samples, range_m, largest in sides.values():
            full_value = max(full_value, largest)
            if len(samples) != len(first[0]) or abs(range_m - first[1]) > 0.01 * first[1]:
                raise ValueError(f"ping {len(pings)} has {len(samples)} samples over {range_m:g} m, the first ping "
                                 f"{len(first[0])} over {first[1]:g} m; split the file where the range changes")
        pings.append(np.stack([sides[PORT][0][::-1], sides[STARBOARD][0]], axis=1))     # port ends at nadir
        if len(pings) == max_pings:
            break
    if not pings:
        raise ValueError("has no side-scan pings")
    step = first[1] / len(first[0])
    # Ranges do not need the speed of sound.
    return Recording("sidescan", law_of(own, full_value), sound_speed_m_s=own.sound_speed_m_s or 1500.0,
                     first_range_m=0.5 * step, range_step_m=step, values=stacked(pings))


def channels_of(data):
    """(type, samples) of each channel: type 1 is port, 2 starboard."""
    if field(data, "B", 0) != 0x7B:
        raise ValueError("is not an XTF file")
    count = field(data, "H", 166) + field(data, "H", 168)
    if not 0 < count <= MAX_CHANNELS:
        raise ValueError("has no channels of a sonar, or too many")
    channels = []
    for at in range(256, 256 + count * CHANNEL_INFO, CHANNEL_INFO):
        kind, form = field(data, "B", at), field(data, "B", at + 74) or -field(data, "H", at + 6)
        if kind in (PORT, STARBOARD) and form not in SAMPLES:
            raise ValueError(f"has samples of the format {form}; those of 8, 16 and 32 bits and IEEE floats are read")
        channels.append((kind, np.dtype(SAMPLES.get(form, "<u2"))))
    return channels


def side_scans(data, channels):
    """Yields the records of side-scans. Six channels fit into the first 1,024 bytes, eight into each further 1,024."""
    view = memoryview(data)
    at = FILE_HEADER * (1 + -(-max(0, channels - 6) // 8))
    while at < len(data):
        if field(data, "H", at) != 0xFACE:
            raise ValueError("has no record where one should begin")
        length = field(data, "I", at + 10)
        if not 14 <= length <= len(data) - at:
            raise ValueError("is cut off within a record")
        if field(data, "B", at + 2) == SIDE_SCAN:
            yield view[at:at + length]
        at += length


def sides_of(record, channels):
    """(samples, range in metres, largest value that samples can hold) of either side that a ping has."""
    sides, at = {}, PING_HEADER
    for _ in range(field(record, "H", 4)):
        number = field(record, "H", at)
        if number >= len(channels):
            raise ValueError("has a ping of a channel that its header lacks")
        kind, dtype = channels[number]
        range_m, count, weight = field(record, "f", at + 4), field(record, "I", at + 42), field(record, "h", at + 58)
        begin, at = at + CHANNEL_HEADER, at + CHANNEL_HEADER + count * dtype.itemsize
        if at > len(record):
            raise ValueError("has more samples than their record")
        if kind in (PORT, STARBOARD) and kind not in sides and count and 0.0 < range_m < LONGEST_RANGE_M:
            factor = 2.0 ** -max(-64, min(64, weight))
            samples = np.float32(factor) * np.frombuffer(record, dtype, count, begin).astype(np.float32)
            sides[kind] = samples, range_m, factor * np.iinfo(dtype).max if dtype.kind == "u" else 0.0
    return sides
