"""A bed as a survey delivers it: a GeoTIFF in UTM coordinates (zone 32 north), 55 x 50 m in pixels of 25 cm, heights
in metres as floats. Sand waves, a channel, the scar of a trawl, a mound and a hole that nobody surveyed."""
import math
import struct

from .noise import Relief

COLUMNS, ROWS, PIXEL_M = 220, 200, 0.25
WEST_M, NORTH_M = 505000.0, 5987050.0
NO_DATA = -9999.0


def height(x, y, relief):
    """The height at x m east and y m north of the south-west corner. Diagonal waves tell it from a mirrored map."""
    along = 0.8 * x + 0.6 * y
    z = -21.0 + 0.02 * x + relief(x, y)
    z += 0.25 * math.sin(2 * math.pi * along / 7.0 + 0.4 * math.sin(0.15 * (0.6 * x - 0.8 * y)))
    z -= 1.6 * math.exp(-((x - 38 - 4 * math.sin(0.1 * y)) / 4.0) ** 2)  # a channel from south to north
    z += 1.2 * math.exp(-((x - 18) ** 2 + (y - 36) ** 2) / 6.0)  # a mound in the north-west
    z -= 0.3 * math.exp(-((y - 14 - 0.25 * x) / 0.5) ** 2)  # a scar from west to east-north-east
    return z


def pixels(rows, columns, size_m, value):
    """value(x, y) at the middle of each pixel: rows from north to south, each from west to east."""
    return [[value((column + 0.5) * size_m, (rows - row - 0.5) * size_m) for column in range(columns)] for row in range(rows)]


def build():
    """The heights, with a hole that nobody surveyed."""
    relief = Relief(9.0, 0.25, 5, 11)
    return pixels(ROWS, COLUMNS, PIXEL_M, lambda x, y: NO_DATA if (x - 50) ** 2 + (y - 45) ** 2 < 9 else height(x, y, relief))


def write_geotiff(path, rows, pixel_m):
    """Little-endian, not compressed, so that the bytes depend on no library."""
    scale = struct.pack("<3d", pixel_m, pixel_m, 0)
    tie_point = struct.pack("<6d", 0, 0, 0, WEST_M, NORTH_M, 0)
    # GeoTIFF keys: projected coordinates, a pixel is an area, EPSG:32632.
    keys = struct.pack("<16H", 1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 32632)
    no_data = b"-9999\0"
    pixels = b"".join(struct.pack(f"<{len(row)}f", *row) for row in rows)
    # (tag, type, count, value); a value of more than 4 bytes follows the tags.
    tags = [(256, 4, 1, len(rows[0])), (257, 4, 1, len(rows)), (258, 3, 1, 32), (259, 3, 1, 1), (262, 3, 1, 1),
            (273, 4, 1, None), (277, 3, 1, 1), (278, 4, 1, len(rows)), (279, 4, 1, len(pixels)), (339, 3, 1, 3),
            (33550, 12, 3, scale), (33922, 12, 6, tie_point), (34735, 3, 16, keys), (42113, 2, 6, no_data)]
    behind_at = 8 + 2 + 12 * len(tags) + 4
    pixels_at = behind_at + sum(len(value) for _, _, _, value in tags if isinstance(value, bytes))
    listed, behind = struct.pack("<H", len(tags)), b""
    for tag, kind, count, value in tags:
        if isinstance(value, bytes):
            value, behind = behind_at + len(behind), behind + value
        listed += struct.pack("<HHII", tag, kind, count, pixels_at if value is None else value)
    path.write_bytes(struct.pack("<2sHI", b"II", 42, 8) + listed + bytes(4) + behind + pixels)
