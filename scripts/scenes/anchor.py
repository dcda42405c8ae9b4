"""A stockless anchor as tools for 3D printing write it: an OBJ in millimetres with z up, standing on its
crown. Its groups are shank, head and shackle."""
from .glb import Part
from .shapes import add_box, add_cylinder, add_torus, made


def build():
    head = Part("head", "steel")
    add_box(head, (0, 0, 0.1), (0.24, 0.66, 0.2))
    for side in (-1, 1):
        add_cylinder(head, (0.05, 0.3 * side, 0.12), (0.3, 0.34 * side, 0.72), 0.05, 12)
    return [made("shank", "steel", (add_box, (0, 0, 0.68), (0.1, 0.08, 1.0))), head,
            made("shackle", "steel", (add_torus, (0, 0, 1.22), 0.1, 0.025, 20, 8))]
