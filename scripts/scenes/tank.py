"""A concrete test tank with a few objects of other materials in its far half (x > 0)."""
from .glb import Part
from .noise import noise3
from .shapes import add_box, add_cylinder, add_quad, add_sphere, add_torus

HALF_X, HALF_Y, DEPTH = 4.0, 3.0, 3.0  # of the water: 8 x 6 x 3 m, floor at z = 0, open top


def shell():
    x, y, z = HALF_X, HALF_Y, DEPTH
    walls = {
        "floor": ((-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0)),
        "wall_east": ((x, -y, 0), (x, -y, z), (x, y, z), (x, y, 0)),
        "wall_north": ((x, y, 0), (x, y, z), (-x, y, z), (-x, y, 0)),
        "wall_west": ((-x, y, 0), (-x, y, z), (-x, -y, z), (-x, -y, 0)),
        "wall_south": ((-x, -y, 0), (-x, -y, z), (x, -y, z), (x, -y, 0)),
    }
    parts = []
    for name, corners in walls.items():
        part = Part(name, "concrete")
        add_quad(part, *corners)
        parts.append(part)
    return parts


def pole():
    part = Part("pole", "steel")
    add_cylinder(part, (1.8, 1.3, 0), (1.8, 1.3, DEPTH), 0.06, 48)
    return part


def box():
    part = Part("box", "aluminium")
    add_box(part, (2.4, -0.9, 0.25), (0.5, 0.5, 0.5), 25)
    return part


def tyre():
    part = Part("tyre", "rubber")
    add_torus(part, (1.2, -0.2, 0.1), 0.22, 0.1, 48, 20)
    return part


def crate():
    part = Part("crate", "wood")
    add_box(part, (3.3, -2.2, 0.2), (0.6, 0.4, 0.4), -15)
    return part


def sphere():
    """30 cm across, hanging on a wire from the surface."""
    part = Part("sphere", "steel")
    add_sphere(part, (2.7, 0.4, 1.4), (0.15, 0.15, 0.15), 3)
    add_cylinder(part, (2.7, 0.4, 1.55), (2.7, 0.4, DEPTH), 0.004, 6)
    return part


def ladder():
    """Made of pipe, 10 cm in front of the far wall."""
    part = Part("ladder", "pvc")
    x = HALF_X - 0.1
    for y in (1.6, 2.0):
        add_cylinder(part, (x, y, 0), (x, y, DEPTH), 0.025, 16)
    for step in range(9):
        z = 0.3 + 0.3 * step
        add_cylinder(part, (x, 1.6, z), (x, 2.0, z), 0.0175, 12)
    return part


def bed():
    """A tray of sand with a stone on it."""
    sand = Part("sand_bed", "sand")
    add_box(sand, (1.6, -2.1, 0.05), (1.2, 1.0, 0.1))
    stone = Part("stone", "rock")
    add_sphere(stone, (1.7, -2.1, 0.2), (0.2, 0.16, 0.14), 2,
               lambda p: 1 + 0.3 * noise3(p, 0.8, 7))
    return [sand, stone]


def build():
    return shell() + [pole(), box(), tyre(), crate(), sphere(), ladder()] + bed()
