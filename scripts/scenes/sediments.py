"""Maps of the ground of bathymetry.tif: its materials as a picture of colours, and decibels that are added to
their strengths as a GeoTIFF in pixels of 20 cm. The same decibels of the floor of scenes/basin.obj in pixels of 1 cm."""
import math
import struct
import zlib

from .bathymetry import COLUMNS, PIXEL_M, ROWS, pixels
from .noise import Draws, Relief, noise2

SAND, MUD, GRAVEL, ROCK = (0xC8, 0xB4, 0x78), (0x6E, 0x5A, 0x46), (0x96, 0x96, 0x8C), (0x50, 0x50, 0x5A)
MOSAIC_PIXEL_M = 0.2
# Strokes of a letter F, as boxes of x and y: no mirrored or turned map looks like it.
LETTER = ((10, 11.5, 6, 17), (10, 17, 15.5, 17), (10, 15, 11, 12.5))
LONG_M, WIDE_M, BASIN_PIXEL_M = 4.0, 3.0, 0.01
OCTAVES = ((0.6, 6.0), (0.12, 4.5), (0.03, 3.5))  # spacing in m and amplitude in dB
SCRATCHES = 120


def colours():
    """The pixels. Mud lies in the channel, rock on the mound."""
    border = Relief(6.0, 1.5, 3, 23)

    def colour(x, y):
        off = border(x, y)
        if math.hypot(x - 18, y - 36) < 2.5 + 0.5 * off:
            return ROCK
        if abs(x - 38 - 4 * math.sin(0.1 * y)) < 4 + off:
            return MUD
        return GRAVEL if math.hypot(x - 26, y - 12) < 6 + 2 * off else SAND
    return pixels(ROWS, COLUMNS, PIXEL_M, colour)


def decibels():
    """The pixels: a texture, the marks of a trawl and a letter."""
    texture = Relief(3.0, 3.0, 3, 31)

    def decibel(x, y):
        value = texture(x, y) - (6 if abs(y - 14 - 0.25 * x) < 0.5 else 0)
        return value + (10 if any(west < x < east and south < y < north for west, east, south, north in LETTER) else 0)
    return pixels(round(50 / MOSAIC_PIXEL_M), round(55 / MOSAIC_PIXEL_M), MOSAIC_PIXEL_M, decibel)


def scratches():
    """The decibels of the pixels on scratches of the basin, by row and column from the north-west: bent lines of 0.1 to 0.9 m."""
    draw, marks = Draws(57), {}
    for _ in range(SCRATCHES):
        x, y, heading = draw(0, LONG_M), draw(0, WIDE_M), draw(0, 2 * math.pi)
        strength, bend = draw(2, 7), draw(-0.02, 0.02)
        for _ in range(int(draw(10, 90))):
            x, y, heading = x + BASIN_PIXEL_M * math.cos(heading), y + BASIN_PIXEL_M * math.sin(heading), heading + bend
            at = math.floor((WIDE_M - y) / BASIN_PIXEL_M), math.floor(x / BASIN_PIXEL_M)
            marks[at] = marks.get(at, 0.0) + strength
    return marks


def basin_decibels():
    """The pixels of scenes/basin.obj: paint, dirt, grain and scratches, by eye after fans of a painted concrete floor."""
    def grain(x, y):
        return sum(amplitude * noise2(x, y, spacing, 61 + k) for k, (spacing, amplitude) in enumerate(OCTAVES))
    rows = pixels(round(WIDE_M / BASIN_PIXEL_M), round(LONG_M / BASIN_PIXEL_M), BASIN_PIXEL_M, grain)
    for (row, column), strength in scratches().items():
        if 0 <= row < len(rows) and 0 <= column < len(rows[0]):
            rows[row][column] += strength
    return [[max(-12.0, min(12.0, value)) for value in row] for row in rows]


def write_png(path, rows):
    """8 bits of red, green and blue."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    lines = b"".join(b"\0" + bytes(value for colour in row for value in colour) for row in rows)
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 2, 0, 0, 0)
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(lines, 9)) +
                     chunk(b"IEND", b""))
