"""A sandy bottom and the things that lie on it, each a file of its own with its origin in its
middle: a mission places them (configs/minefield_variants.yaml, configs/detection.yaml)."""
import math

from .boulders import boulders
from .glb import Part
from .noise import Relief, noise3
from .shapes import add_box, add_cylinder, add_grid, add_sphere, add_torus, circle

HALF = 20.0  # half of the side of the bottom


def bottom():
    """Fractal relief with ripples, and rocks."""
    relief = Relief(14.0, 0.12, 4, 21)

    def height(x, y):
        bend = 0.5 * math.sin(0.17 * x)
        return relief(x, y) + 0.02 * math.sin(2 * math.pi * (y + bend) / 0.6)

    floor = Part("floor", "sand")
    cells = 240
    axis = [2 * HALF * k / cells - HALF for k in range(cells + 1)]
    add_grid(floor, axis, axis, height)
    return [floor] + boulders(12, HALF, 0.15, 0.5, height, 700)


def add_turned(part, profile, sides):
    """The surface of revolution about z of (radius, height) pairs, from the lowest up; it is closed
    where the first and the last radius are 0."""
    rings = [[part.add_vertex(r * c, r * s, z) for c, s in circle(sides)] if r > 0
             else [part.add_vertex(0, 0, z)] * sides for r, z in profile]
    for low, high in zip(rings, rings[1:]):
        for k in range(sides):
            n = (k + 1) % sides
            if low[k] != low[n]:
                part.add_triangle(low[k], low[n], high[n])
            if high[k] != high[n]:
                part.add_triangle(low[k], high[n], high[k])


def cylinder_mine():
    """2 m long, lying along x, with a rounded nose."""
    part = Part("cylinder_mine", "steel")
    nose = [(0.27 * math.sin(a), 0.75 + 0.25 * math.cos(a))
            for a in (math.pi / 2 * k / 6 for k in range(5, -1, -1))]
    upright = Part("upright", "steel")
    add_turned(upright, [(0, -1.0), (0.27, -1.0), (0.27, 0.75), *nose[:-1], (0, 1.0)], 32)
    for k in range(0, len(upright.vertices), 3):
        # Stored as (x, z, -y); upright z becomes x.
        x, z, y = upright.vertices[k], upright.vertices[k + 1], -upright.vertices[k + 2]
        part.add_vertex(z, y, -x)
    part.indices = upright.indices
    return [part]


def cone_mine():
    """A truncated cone, 1 m across and 0.45 m high."""
    part = Part("cone_mine", "polyethylene")
    add_turned(part, [(0, -0.2), (0.5, -0.2), (0.5, -0.14), (0.27, 0.2), (0.2, 0.25), (0, 0.25)], 40)
    return [part]


def tyre():
    part = Part("tyre", "hard_rubber")
    add_torus(part, (0, 0, 0), 0.27, 0.11, 36, 14)
    return [part]


def drum():
    """An oil drum, lying along x."""
    part = Part("drum", "steel")
    add_cylinder(part, (-0.44, 0, 0), (0.44, 0, 0), 0.29, 32)
    for x in (-0.15, 0.15):
        add_cylinder(part, (x - 0.02, 0, 0), (x + 0.02, 0, 0), 0.305, 32)
    return [part]


def block():
    """A mooring block with its eye."""
    part = Part("block", "concrete")
    add_box(part, (0, 0, 0), (0.8, 0.8, 0.5))
    eye = Part("eye", "steel")
    add_cylinder(eye, (-0.12, 0, 0.25), (-0.12, 0, 0.42), 0.025, 10)
    add_cylinder(eye, (0.12, 0, 0.25), (0.12, 0, 0.42), 0.025, 10)
    add_cylinder(eye, (-0.145, 0, 0.42), (0.145, 0, 0.42), 0.025, 10)
    return [part, eye]


def rock():
    part = Part("rock", "rock")
    add_sphere(part, (0, 0, 0), (0.5, 0.4, 0.3), 3,
               lambda p: 1 + 0.3 * noise3(p, 0.8, 91) + 0.1 * noise3(p, 0.3, 91))
    return [part]


OBJECTS = {"cylinder_mine": cylinder_mine, "cone_mine": cone_mine, "tyre": tyre, "drum": drum,
           "block": block, "rock": rock}
