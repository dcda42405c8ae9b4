"""What is added to the strength of the floor of scenes/basin.obj, in decibels, in pixels of 1 cm: patches of paint and
dirt, grain, and scratches. Sizes and decibels are by eye, after fans of a painted concrete floor."""
import math

from .bathymetry import pixels
from .noise import Draws, noise2

LONG_M, WIDE_M, PIXEL_M = 4.0, 3.0, 0.01
OCTAVES = ((0.6, 6.0), (0.12, 4.5), (0.03, 3.5))  # spacing in m and amplitude in dB
SCRATCHES = 120


def scratches():
    """The decibels of the pixels on scratches, by row and column from the north-west: bent lines of 0.1 to 0.9 m."""
    draw, marks = Draws(57), {}
    for _ in range(SCRATCHES):
        x, y, heading = draw(0, LONG_M), draw(0, WIDE_M), draw(0, 2 * math.pi)
        strength, bend = draw(2, 7), draw(-0.02, 0.02)
        for _ in range(int(draw(10, 90))):
            x, y, heading = x + PIXEL_M * math.cos(heading), y + PIXEL_M * math.sin(heading), heading + bend
            at = math.floor((WIDE_M - y) / PIXEL_M), math.floor(x / PIXEL_M)
            marks[at] = marks.get(at, 0.0) + strength
    return marks


def decibels():
    """The pixels: rows from north to south."""
    def grain(x, y):
        return sum(amplitude * noise2(x, y, spacing, 61 + k) for k, (spacing, amplitude) in enumerate(OCTAVES))
    rows = pixels(round(WIDE_M / PIXEL_M), round(LONG_M / PIXEL_M), PIXEL_M, grain)
    for (row, column), strength in scratches().items():
        if 0 <= row < len(rows) and 0 <= column < len(rows[0]):
            rows[row][column] += strength
    return [[max(-12.0, min(12.0, value)) for value in row] for row in rows]
