"""A concrete test tank with a few objects of other materials in its far half (x > 0)."""
from .glb import Part
from .noise import noise3
from .shapes import add_box, add_cylinder, add_sphere, add_torus, made

HALF_X, HALF_Y, DEPTH = 4.0, 3.0, 3.0  # of the water: 8 x 6 x 3 m, floor at z = 0, open top


def shell():
    x, y, z = HALF_X, HALF_Y, DEPTH
    walls = {
        "floor": ((-x, -y, 0), (x, -y, 0), (x, y, 0), (-x, y, 0)),
        "wall_east": ((x, -y, 0), (x, -y, z), (x, y, z), (x, y, 0)),
        "wall_north": ((x, y, 0), (x, y, z), (-x, y, z), (-x, y, 0)),
        "wall_west": ((-x, y, 0), (-x, y, z), (-x, -y, z), (-x, -y, 0)),
        "wall_south": ((-x, -y, 0), (-x, -y, z), (x, -y, z), (x, -y, 0))}
    return [made(name, "concrete", (Part.add, corners, [range(4)])) for name, corners in walls.items()]


def ladder():
    """Made of pipe, 10 cm in front of the far wall."""
    x = HALF_X - 0.1
    return made("ladder", "pvc", *((add_cylinder, (x, y, 0), (x, y, DEPTH), 0.025, 16) for y in (1.6, 2.0)),
                *((add_cylinder, (x, 1.6, 0.3 + 0.3 * step), (x, 2.0, 0.3 + 0.3 * step), 0.0175, 12) for step in range(9)))


def build():
    return shell() + [
        made("pole", "steel", (add_cylinder, (1.8, 1.3, 0), (1.8, 1.3, DEPTH), 0.06, 48)),
        made("box", "aluminium", (add_box, (2.4, -0.9, 0.25), (0.5, 0.5, 0.5), 25)),
        made("tyre", "rubber", (add_torus, (1.2, -0.2, 0.1), 0.22, 0.1, 48, 20)),
        made("crate", "wood", (add_box, (3.3, -2.2, 0.2), (0.6, 0.4, 0.4), -15)),
        # 30 cm across, hanging on a wire from the surface.
        made("sphere", "steel", (add_sphere, (2.7, 0.4, 1.4), (0.15, 0.15, 0.15), 3),
             (add_cylinder, (2.7, 0.4, 1.55), (2.7, 0.4, DEPTH), 0.004, 6)), ladder(),
        # A tray of sand with a stone on it.
        made("sand_bed", "sand", (add_box, (1.6, -2.1, 0.05), (1.2, 1.0, 0.1))),
        made("stone", "rock", (add_sphere, (1.7, -2.1, 0.2), (0.2, 0.16, 0.14), 2, lambda p: 1 + 0.3 * noise3(p, 0.8, 7)))]
