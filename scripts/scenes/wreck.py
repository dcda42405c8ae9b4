"""A broken steel hull with ribs, lying over on a rippled bottom."""
import math

from .glb import Part
from .noise import Relief, noise3
from .seafloor import boulders
from .shapes import add_cylinder, add_grid, add_line, add_sides, made

HALF = 30.0                             # half of the side of the bottom
LENGTH, BEAM, DEPTH = 34.0, 8.0, 4.5    # the hull
LIST = math.radians(18)                 # to port
SUNK = 0.8                              # depth of the keel below z = 0


def half_breadth(u, v):
    """A point of the hull at u along it (-1 stern, 1 bow) and v up it (0 keel, 1 deck), in metres."""
    return BEAM / 2 * max(0.0, 1 - abs(u) ** (3.5 if u < 0 else 2.2)) * min(1.0, v) ** (0.35 + 0.35 * abs(u))


def hull_point(u, v, side, inset=0.0):
    """The point in the world; the hull has a list to port."""
    y, z = side * max(0.0, half_breadth(u, v) - inset), DEPTH * v + 1.2 * v * max(0.0, u) ** 3
    return (LENGTH / 2 * u, y * math.cos(LIST) - z * math.sin(LIST), y * math.sin(LIST) + z * math.cos(LIST) - SUNK)


def plating():
    """Both sides, with holes where rust has gone through."""
    along, up = 160, 28

    def is_there(side, i, j):
        rust = noise3((i / 14, j / 7, 5.0 * side), 1.0, 31)
        return not (rust - 0.25 * (j / up) > 0.28 or abs(i / along - 0.36) < 0.025)
    return made("hull", "steel", (add_sides, along, up, hull_point, is_there))


def ribs():
    part = Part("ribs", "steel")
    for k in range(1, 24):
        u = 2 * k / 24 - 1
        for side in (-1, 1):
            add_line(part, [hull_point(u, (j + 0.2) / 10.2, side, 0.08) for j in range(11)], 0.07, 6)
        if k % 3:
            add_cylinder(part, hull_point(u, 0.96, -1, 0.08), hull_point(u, 0.96, 1, 0.08), 0.08, 8)
    return part


def build():
    relief = Relief(18.0, 0.2, 4, 11)

    def height(x, y):
        return relief(x, y) + 0.05 * math.sin(2 * math.pi * (y + 0.8 * math.sin(0.2 * x)) / 0.9)
    axis = [2 * HALF * k / 260 - HALF for k in range(261)]
    return ([made("floor", "sand", (add_grid, axis, axis, height)), plating(), ribs(),
             made("keel", "steel", (add_cylinder, hull_point(-0.98, 0, 1), hull_point(0.98, 0, 1), 0.15, 12)),
             made("boiler", "steel", (add_cylinder, (-6.0, -1.6, 1.2), (-2.2, -1.4, 1.3), 1.2, 40)),
             made("mast", "wood", (add_cylinder, (5.0, -4.5, 1.5), (12.0, -15.0, 0.2), 0.18, 16))]
            + boulders(30, HALF, 0.2, 1.0, height, 300))
