"""A drawn side-scan mosaic as a survey delivers it: a GeoTIFF of decibels, 55 x 50 m in pixels of 20 cm, over
the ground of bathymetry.tif. Mud, rippled sand and gravel; four survey lines from west to east, each with a
gap of unknown pixels below its track and a gain of its own, so that seams lie between lines; speckle of eight
looks."""
import math

from .bathymetry import NO_DATA
from .noise import Relief, lattice

PIXEL_M, COLUMNS, ROWS = 0.2, 275, 250
LINES_M = (5.0, 18.0, 31.0, 44.0)  # y of the tracks
GAP_M = 0.9                        # to both sides of a track
GAINS_DB = (0.0, 1.2, -0.8, 0.6)
LOOKS = 8
MUD, SAND, GRAVEL = -6.0, 0.0, 5.0


def sediment_db(x, y, border, grain):
    """The strength of the bed at x m east and y m north of the south-west corner."""
    place = 0.12 * (x - 27) + 0.08 * (y - 25) + border(x, y)
    if place < -1.2:
        return MUD + 0.5 * grain(x, y)
    if place > 1.4:
        return GRAVEL + grain(x, y)
    ripples = 1.5 * math.sin(2 * math.pi * (0.9 * x + 0.44 * y + 0.6 * border(x, y)) / 1.6)
    return SAND + ripples + 0.5 * grain(x, y)


def speckle_db(row, column):
    """The mean of `LOOKS` draws of power from an exponential distribution, in decibels."""
    power = 0.0
    for look in range(LOOKS):
        power -= math.log(1 - (lattice(column, row, look, 71) + 1) / 2 + 1e-9)
    return 10 * math.log10(power / LOOKS)


def decibels():
    """Decibels in whole tenths: rows from north to south, each from west to east."""
    border = Relief(16.0, 1.6, 4, 41)
    grain = Relief(1.0, 2.0, 2, 53)
    rows = []
    for row in range(ROWS):
        y = (ROWS - row - 0.5) * PIXEL_M
        line = min(range(len(LINES_M)), key=lambda k: abs(y - LINES_M[k]))
        if abs(y - LINES_M[line]) < GAP_M:
            rows.append([NO_DATA] * COLUMNS)
            continue
        rows.append([round(sediment_db((column + 0.5) * PIXEL_M, y, border, grain) + GAINS_DB[line] +
                           speckle_db(row, column), 1) for column in range(COLUMNS)])
    return rows
