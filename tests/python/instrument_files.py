"""A small file of each instrument's format, made here from its published layout."""
import struct


def placed(size, *fields):
    """Zeros with little-endian numbers at offsets: (offset, layout, value)."""
    out = bytearray(size)
    for at, layout, value in fields:
        struct.pack_into("<" + layout, out, at, value)
    return bytes(out)


def counted(count, first=0):
    return bytes((first + k) % 256 for k in range(count))


def oculus(version=1, size=0, image=counted(6)):
    """A message of 3 ranges and 2 beams."""
    fire, more, time, spare = (89, 24, 8, 16) if version == 2 else (53, 0, 4, 0)
    value = fire + 40 + more + time
    end = value + 13 + spare
    return placed(end + 16, (0, "H", 0x4F53), (6, "H", 0x23), (8, "H", version), (10, "I", end + len(image)),
                  (fire + 8, "d", 2.1e6), (fire + 32 + more, "d", 1490.0), (value, "B", size), (value + 1, "d", 0.25),
                  (value + 9, "H", 3), (value + 11, "H", 2), (end, "I", end + 16), (end + 4, "I", len(image)),
                  (end + 12, "h", -3000), (end + 14, "h", 1550)) + image


def xtf_header(sample_format=3):
    channels = [field for at, kind in ((256, 1), (384, 2)) for field in ((at, "B", kind), (at + 6, "H", 2),
                                                                        (at + 74, "B", sample_format))]
    return placed(1024, (0, "B", 0x7B), (166, "H", 2), *channels)


def xtf_record(kind, size, *fields):
    """Of the second of January 1970, three and a quarter seconds past midnight."""
    return placed(size, (0, "H", 0xFACE), (2, "B", kind), (10, "I", size), (14, "H", 1970), (16, "B", 1), (17, "B", 2),
                  (20, "B", 3), (21, "B", 25), *fields)


def xtf_ping(samples=(1, 2, 3, 4, 5, 6), layout="H", weight=0, range_m=30.0):
    side = len(samples) // 2
    length = 64 + side * struct.calcsize(layout)
    fields = [(4, "H", 2), (32, "f", 740.0), (196, "f", 4.5)]
    for number in (0, 1):
        at = 256 + number * length
        fields += [(at, "H", number), (at + 4, "f", range_m), (at + 26, "H", 400), (at + 42, "I", side), (at + 58, "h", weight)]
        fields += [(at + 64 + k * struct.calcsize(layout), layout, samples[number * side + k]) for k in range(side)]
    return xtf_record(0, 256 + 2 * length, *fields)


def didson(version=4, frames=2, samples=5, start=4):
    mark = 0x00464444 + (version << 24)
    out = placed(512 if version == 3 else 1024, (0, "I", mark), (12, "I", 1), (16, "I", 48), (20, "f", 50000.0),
                 (24, "I", samples), (44, "I", 100))
    for k in range(frames):
        date = [(20 + 4 * d, "I", value) for d, value in enumerate((1970, 1, 2, 0, 0, k, 25))]
        out += placed(256 if version == 3 else 1024, (12, "I", mark), (52, "I", start), *date) + counted(48 * samples, k)
    return out


def aris(frames=2, samples=5, ordered=1):
    out = placed(1024, (0, "I", 0x05464444), (16, "I", 48), (24, "I", samples))
    for k in range(frames):
        out += placed(1024, (12, "I", 0x05464444), (20, "Q", 2000000 * (k + 1)), (440, "I", 1), (452, "I", 8), (464, "f", 1450.0),
                      (468, "I", samples), (476, "I", 1000), (484, "I", 2), (516, "I", ordered)) + counted(48 * samples, k)
    return out


def ping360(angle=100, samples=(9, 8, 7), is_auto=False):
    payload = struct.pack("<BBHHHH", 1, 0, angle, 11, 800, 750)
    payload += struct.pack("<HHBB", 0, 399, 1, 0) if is_auto else b""
    payload += struct.pack("<HH", len(samples), len(samples)) + bytes(samples)
    message = b"BR" + struct.pack("<HHH", len(payload), 2301 if is_auto else 2300, 0) + payload
    return message + struct.pack("<H", sum(message) & 0xFFFF)


def simrad(kind, content=b""):
    """A datagram of ten seconds past 1970."""
    inner = kind + struct.pack("<Q", (11644473600 + 10) * 10 ** 7) + content
    return struct.pack("<I", len(inner)) + inner + struct.pack("<I", len(inner))


def ek60(frequency=38000.0, steps=(-4000, -8000, -20000), mode=3):
    content = struct.pack("<HH9f", 1, mode, 0.0, frequency, 1000.0, 1e-3, 2425.0, 2e-4, 1480.0, 0.01, 0.0)
    content += bytes(64 - len(content)) + struct.pack("<ii", 2, len(steps))
    return simrad(b"RAW0", content + struct.pack(f"<{len(steps)}h", *steps) + bytes(2 * len(steps)))


GAMMA, BEARINGS = "law: {kind: gamma}\n", "bearing_first_deg: 14\nbearing_last_deg: -14\n"
# recording.yaml, a whole file, and the lengths to which it may be cut off and still be whole.
FORMATS = {"oculus": ("kind: imaging\noculus: FILE\nrate_hz: 5\n" + GAMMA, oculus() * 2, {len(oculus()), len(oculus()) + 1}),
    "xtf": ("kind: sidescan\nxtf: FILE\nlaw: {kind: power}\n", xtf_header() + xtf_ping() * 2, {1024 + len(xtf_ping())}),
    "didson": ("kind: imaging\nlogs: FILE\nsound_speed_m_s: 1480\n" + BEARINGS, didson(), {len(didson(frames=1))}),
    "aris": ("kind: imaging\nlogs: FILE\n" + GAMMA + BEARINGS, aris(), {len(aris(frames=1))}),
    "ping360": ("kind: scanning\nlogs: FILE\nsound_speed_m_s: 1500\nhead_first_deg: 90\n" + GAMMA,
                ping360(100) + ping360(104, is_auto=True), {len(ping360()), len(ping360()) + 1}),
    "ek60": ("kind: echosounder\nlogs: FILE\n", simrad(b"CON0") + ek60() * 2, {len(simrad(b"CON0") + ek60())})}
