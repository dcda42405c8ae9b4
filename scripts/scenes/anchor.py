"""A stockless anchor as tools for 3D printing write it: an OBJ in millimetres with z up, standing on its
crown. Its groups are shank, head and shackle."""
from .glb import Part
from .shapes import add_box, add_cylinder, add_torus


def build():
    shank = Part("shank", "steel")
    add_box(shank, (0, 0, 0.68), (0.1, 0.08, 1.0))
    head = Part("head", "steel")
    add_box(head, (0, 0, 0.1), (0.24, 0.66, 0.2))
    for side in (-1, 1):
        add_cylinder(head, (0.05, 0.3 * side, 0.12), (0.3, 0.34 * side, 0.72), 0.05, 12)
    shackle = Part("shackle", "steel")
    add_torus(shackle, (0, 0, 1.22), 0.1, 0.025, 20, 8)
    return [shank, head, shackle]
