"""A sea floor: fractal relief about z = 0 with sand ripples, silt in the hollows, boulders."""
import math

from .noise import Draws, Relief, noise3
from .shapes import add_grid, add_sphere, made


def boulders(count, half_size, radius_min, radius_max, height, seed):
    """`count` deformed spheres of rock, most of them small, sunk into z = height(x, y), |x|, |y| below `half_size`."""
    draw, parts = Draws(seed), []
    for k in range(count):
        radius = radius_min + (radius_max - radius_min) * draw(0, 1) ** 2
        x, y = (draw(-1, 1) * (half_size - 2 * radius_max) for _ in range(2))
        radii = [radius * draw(0.7, 1.0), radius * draw(0.7, 1.0), radius * draw(0.6, 0.9)]
        parts.append(made(f"boulder_{k + 1:03}", "rock", (
            add_sphere, (x, y, height(x, y) + 0.4 * radii[2]), radii, 3 if radius > 0.6 else 2,
            lambda p, own=seed + 1 + k: 1 + 0.25 * noise3(p, 0.8, own) + 0.08 * noise3(p, 0.3, own))))
    return parts


def build(cells, area_m):
    """cells x cells x 2 triangles over area_m x area_m metres, and a hundred boulders (fewer on less than 1 ha)."""
    half, relief = area_m / 2, Relief(40.0, 0.28, 6, 1)
    ripple_strength = Relief(25.0, 0.03, 2, 50)

    def height(x, y):
        strength, bend = ripple_strength(x, y), 0.6 * math.sin(0.11 * y)
        ripple = strength * math.sin(2 * math.pi * (x + bend) / 1.1) if strength > 0 else 0.0
        return relief(x, y) + ripple

    axis = [area_m * k / cells - half for k in range(cells + 1)]
    floor = made("floor", "sand", (add_grid, axis, axis, height, lambda x, y, z: "silt" if z < -0.12 else "sand"))
    radius_max = min(1.5, area_m / 20)
    count = min(100, math.ceil(area_m * area_m / 100))
    return [floor] + boulders(count, half, min(0.3, radius_max), radius_max, height, 100)
