"""Boulders on a sea floor."""
from .noise import Draws, noise3
from .shapes import add_sphere, made


def boulders(count, half_size, radius_min, radius_max, height, seed):
    """`count` deformed spheres of rock, sunk into the floor z = height(x, y), |x|, |y| below
    `half_size`. Small ones are more frequent."""
    draw = Draws(seed)
    parts = []
    for k in range(count):
        radius = radius_min + (radius_max - radius_min) * draw(0, 1) ** 2
        x, y = (draw(-1, 1) * (half_size - 2 * radius_max) for _ in range(2))
        radii = [radius * draw(0.7, 1.0), radius * draw(0.7, 1.0), radius * draw(0.6, 0.9)]
        parts.append(made(f"boulder_{k + 1:03}", "rock", (
            add_sphere, (x, y, height(x, y) + 0.4 * radii[2]), radii, 3 if radius > 0.6 else 2,
            lambda p, own=seed + 1 + k: 1 + 0.25 * noise3(p, 0.8, own) + 0.08 * noise3(p, 0.3, own))))
    return parts
