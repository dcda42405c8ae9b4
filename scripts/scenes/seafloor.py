"""A sea floor: fractal relief about z = 0 with sand ripples, silt in the hollows, boulders."""
import math

from .boulders import boulders
from .noise import Relief
from .shapes import add_grid, made


def build(cells, area_m):
    """cells x cells x 2 triangles over area_m x area_m metres, and a hundred boulders (fewer on
    less than 1 ha)."""
    half = area_m / 2
    relief = Relief(40.0, 0.28, 6, 1)
    ripple_strength = Relief(25.0, 0.03, 2, 50)

    def height(x, y):
        strength = ripple_strength(x, y)
        bend = 0.6 * math.sin(0.11 * y)
        ripple = strength * math.sin(2 * math.pi * (x + bend) / 1.1) if strength > 0 else 0.0
        return relief(x, y) + ripple

    axis = [area_m * k / cells - half for k in range(cells + 1)]
    floor = made("floor", "sand", (add_grid, axis, axis, height, lambda z: "silt" if z < -0.12 else "sand"))
    radius_max = min(1.5, area_m / 20)
    count = min(100, math.ceil(area_m * area_m / 100))
    return [floor] + boulders(count, half, min(0.3, radius_max), radius_max, height, 100)
