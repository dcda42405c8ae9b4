"""A rough bottom half a metre below a high-frequency sonar, marine snow, and the water's surface."""
import math

from .glb import Part
from .noise import Draws, Relief
from .shapes import add_grid, add_sphere, made

CELL_M, FLOCS, FLOC_M = 0.005, 28, 0.0008


def step_at(y):
    """The oblique step of the bottom behind the pebbles, which makes the second arc."""
    return 1.42 - 0.35 * y


def material_at(x, y, ragged, draw):
    """Mud, a patch of pebbles on silt with a bare spot, sand, and rock beyond the step. Stones make echoes spiky."""
    azimuth, distance = math.degrees(math.atan2(y, max(x, 1e-6))), math.hypot(x, y)
    bend = (azimuth / 30) ** 2
    if distance < 0.4 + 0.4 * bend:
        return "fitted_mud"
    if ((distance - 0.96) / 0.14) ** 2 + ((azimuth - 4) / 7) ** 2 < 1 + 15 * ragged(x, y):
        return "fitted_silt"
    stone = draw(0, 1)
    if distance < 1.07 - 0.08 * bend + ragged(x, y):
        return "fitted_pebble" if stone < 0.34 else "fitted_silt"
    if x > step_at(y) + 0.04:
        return "fitted_rock" if stone < 0.6 else "fitted_pebble"
    return "fitted_sand" if bend < 0.25 + 6 * ragged(x, y) else "fitted_silt"


def build():
    """The sonar is at the origin and looks along x, 35 degrees down. The bottom reaches from under it to 2.4 m ahead."""
    swell, stones = Relief(0.5, 0.03, 2, 7), Relief(0.05, 0.0055, 2, 20)
    draw, ragged = Draws(40), Relief(0.05, 0.04, 2, 31)

    def height(x, y):
        rise = 0.025 / (1 + math.exp(-(x - step_at(y)) / 0.03))
        below = 0.035 * math.exp(-(x / 0.35) ** 2)
        return -0.53 + 0.06 * y * y - below + swell(x, y) + stones(x, y) + rise

    columns, rows = ([CELL_M * k for k in range(*ends)] for ends in ((-32, 481), (-230, 231)))
    return [made("bottom", "fitted_mud", (add_grid, columns, rows, height, lambda x, y, _: material_at(x, y, ragged, draw)))]


def flocs():
    """Marine snow in the main lobe between the sonar and the bottom."""
    draw, part = Draws(300), Part("flocs", "floc")
    for _ in range(FLOCS):
        distance, azimuth = draw(0.1, 0.48), math.radians(draw(-28, 28))
        depression = math.radians(35 + draw(-5, 5))
        centre = (distance * math.cos(azimuth) * math.cos(depression),
                  distance * math.sin(azimuth) * math.cos(depression), -distance * math.sin(depression))
        add_sphere(part, centre, (FLOC_M, FLOC_M, FLOC_M), 1)
    return [part]


def surface():
    """The surface of the water, at height 0."""
    return [made("surface", "water_surface", (Part.add, [(-3, -3, 0), (3, -3, 0), (3, 3, 0), (-3, 3, 0)], [range(4)]))]


OBJECTS = {"close_bottom_flocs.glb": flocs, "close_bottom_surface.glb": surface}
