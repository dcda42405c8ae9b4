"""A lifeboat in close-up: a hull with rails, ropes and gear, all of one material."""
import math

from .glb import Part
from .shapes import add_box, add_cylinder, add_line, add_sides, add_sphere, add_torus, made

LENGTH, BEAM, DEPTH = 7.5, 2.6, 1.5


def half_breadth(u, v):
    """A point of the hull at u along it (-1 stern, 1 bow) and v up it (0 keel, 1 gunwale), in metres."""
    return BEAM / 2 * max(0.0, 1 - abs(u) ** 2.6) ** 0.75 * v ** 0.45


def hull_point(u, v, side):
    return LENGTH / 2 * u, side * half_breadth(u, v), DEPTH * v + 0.35 * u * u * v


def thwarts():
    """Benches across the boat, and the deck at bow and stern."""
    part = Part("thwarts", "steel")
    for k in range(5):
        u = -0.6 + 0.28 * k
        add_box(part, (LENGTH / 2 * u, 0.0, 0.75 * DEPTH), (0.22, 2 * half_breadth(u, 0.7), 0.03))
        for side in (-1, 1):
            add_cylinder(part, (LENGTH / 2 * u, 0.4 * side, 0.05), (LENGTH / 2 * u, 0.4 * side, 0.75 * DEPTH), 0.02, 6)
    return part


def rails():
    """Stanchions with two rails along both sides, and a roof of hoops."""
    part = Part("rails", "steel")
    posts = [-0.86 + 1.72 * k / 14 for k in range(15)]
    for side in (-1, 1):
        feet = [hull_point(u, 1.0, side) for u in posts]
        for x, y, z in feet:
            add_cylinder(part, (x, y, z), (x, y, z + 0.6), 0.012, 6)
        for a, b in zip(feet, feet[1:]):
            for up in (0.3, 0.6):
                add_cylinder(part, (*a[:2], a[2] + up), (*b[:2], b[2] + up), 0.01, 6)
    for u in (-0.4, -0.1, 0.2):
        x, y, z = hull_point(u, 1.0, 1)
        arc = [(x, y * math.cos(math.pi * k / 10), z + 0.9 * math.sin(math.pi * k / 10)) for k in range(11)]
        add_line(part, arc, 0.015, 6)
    return part


def ropes():
    """Grab lines that hang in bights along the hull, and a line from bow to stern."""
    part, steps = Part("ropes", "steel"), 4
    for side in (-1, 1):
        for k in range(10):
            points = []
            for i in range(steps + 1):
                u = -0.8 + 1.6 * (k + i / steps) / 10
                x, y, z = hull_point(u, 0.95, side)
                points.append((x, y + 0.02 * side, z - 0.18 * (1 - (2 * i / steps - 1) ** 2)))
            add_line(part, points, 0.006, 4)
    bow, stern = hull_point(0.97, 1.0, 1), hull_point(-0.97, 1.0, 1)
    add_cylinder(part, (bow[0], 0.0, bow[2]), (0.4, 0.0, 3.1), 0.005, 4)
    add_cylinder(part, (0.4, 0.0, 3.1), (stern[0], 0.0, stern[2]), 0.005, 4)
    add_cylinder(part, (0.4, 0.0, 0.05), (0.4, 0.0, 3.1), 0.03, 10)
    return part


def gear():
    """Engine, propeller, barrels, life buoys and fenders."""
    part = Part("gear", "steel")
    add_box(part, (-2.6, 0.0, 0.6), (0.9, 0.6, 0.7))
    add_cylinder(part, (-3.0, 0.0, 0.2), (-3.9, 0.0, 0.1), 0.03, 10)
    for k in range(4):
        angle = math.radians(90 * k)
        add_box(part, (-3.9, 0.14 * math.cos(angle), 0.1 + 0.14 * math.sin(angle)), (0.02, 0.12, 0.2), 20.0)
    for x, y in ((1.6, 0.4), (1.6, -0.4), (2.1, 0.0)):
        add_cylinder(part, (x, y, 0.15), (x, y, 0.85), 0.2, 20)
    for x in (-1.2, 0.9):
        add_torus(part, (x, 0.0, 1.25), 0.3, 0.05, 20, 8)
    for side in (-1, 1):
        for u in (-0.5, 0.0, 0.5):
            x, y, z = hull_point(u, 0.75, side)
            add_sphere(part, (x, y + 0.12 * side, z), (0.12, 0.12, 0.25), 1)
    return part


def build():
    return [made("hull", "steel", (add_sides, 46, 11, hull_point)), thwarts(), rails(), ropes(), gear()]
