"""A rough bottom half a metre below a high-frequency sonar, with some particles in the water."""
import math

from .glb import Part
from .noise import Draws, Relief
from .shapes import add_grid, add_sphere

CELL_M = 0.008


def build():
    """The sonar is at the origin and looks along x, 35 degrees down. The bottom reaches from under it
    to 2.4 m ahead."""
    swell = Relief(0.5, 0.04, 2, 7)
    stones = Relief(0.05, 0.006, 2, 20)

    def height(x, y):
        # A step up behind 1.3 m makes the second arc.
        rise = 0.10 / (1 + math.exp(-(x - 1.36 - 0.3 * y * y) / 0.03))
        return -0.5 - 0.22 * y * y + swell(x, y) + stones(x, y) + rise

    bottom = Part("bottom", "gravel")
    xs = [CELL_M * k for k in range(-20, 301)]
    ys = [CELL_M * k for k in range(-170, 171)]
    add_grid(bottom, xs, ys, height)

    draw = Draws(300)
    particles = Part("particles", "sand")
    for _ in range(16):
        radius = draw(0.0003, 0.0006)
        distance = draw(0.12, 0.48)
        azimuth = math.radians(draw(-28, 28))
        depression = math.radians(35 + draw(-6, 6))
        centre = (distance * math.cos(azimuth) * math.cos(depression),
                  distance * math.sin(azimuth) * math.cos(depression),
                  -distance * math.sin(depression))
        add_sphere(particles, centre, (radius, radius, radius), 1)
    return [bottom, particles]
