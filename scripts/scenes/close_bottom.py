"""A rough bottom half a metre below a high-frequency sonar, with some particles in the water."""
import math

from .glb import Part
from .noise import Draws, Relief
from .shapes import add_sphere

CELL_M = 0.008
PARTICLES = 20


def material_at(x, y):
    """A patch of gravel on mud, silt and a stripe of sand behind it, and rock farther on."""
    azimuth = math.degrees(math.atan2(y, max(x, 1e-6)))
    distance = math.hypot(x, y)
    if distance > 1.55:
        return "rock"
    if 1.36 < distance < 1.42:
        return "sand"
    bend = (azimuth / 30) ** 2
    if 0.45 + 0.305 * bend < distance < 1.03 - 0.06 * bend:
        return "gravel"
    return "mud" if distance < 0.7 else "silt"


def build():
    """The sonar is at the origin and looks along x, 35 degrees down. The bottom reaches from under it
    to 2.4 m ahead."""
    swell = Relief(0.5, 0.03, 2, 7)
    stones = Relief(0.05, 0.006, 2, 20)

    def height(x, y):
        # A step up behind 1.3 m makes the second arc.
        rise = 0.05 / (1 + math.exp(-(x - 1.36) / 0.03))
        return -0.53 + 0.06 * y * y + swell(x, y) + stones(x, y) + rise

    bottom = Part("bottom", "mud")
    columns, rows = range(-20, 301), range(-170, 171)
    numbers = {(i, j): bottom.add_vertex(CELL_M * i, CELL_M * j, height(CELL_M * i, CELL_M * j))
               for j in rows for i in columns}
    for j in rows[:-1]:
        for i in columns[:-1]:
            bottom.add_quad(numbers[i, j], numbers[i + 1, j], numbers[i + 1, j + 1],
                            numbers[i, j + 1], material_at(CELL_M * i, CELL_M * j))

    draw = Draws(300)
    particles = Part("particles", "sand")
    for _ in range(PARTICLES):
        distance = draw(0.15, 0.45)
        azimuth = math.radians(draw(-24, 24))
        depression = math.radians(35 + draw(-5, 5))
        centre = (distance * math.cos(azimuth) * math.cos(depression),
                  distance * math.sin(azimuth) * math.cos(depression),
                  -distance * math.sin(depression))
        add_sphere(particles, centre, (0.0002, 0.0002, 0.0002), 1)
    return [bottom, particles]
