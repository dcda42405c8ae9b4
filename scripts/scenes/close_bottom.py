"""A rough bottom half a metre below a high-frequency sonar, marine snow, and the water's surface."""
import math

from .glb import Part
from .noise import Draws, Relief
from .shapes import add_quad, add_sphere, made

CELL_M = 0.005
FLOCS = 28
FLOC_M = 0.0008


def step_at(y):
    """The oblique step of the bottom behind the pebbles, which makes the second arc."""
    return 1.42 - 0.35 * y


def material_at(x, y, ragged, draw):
    """A patch of pebbles on silt with a bare spot in it, mud before it, sand behind it, and rock
    beyond the step. Single stones make the bottom's echo spiky."""
    azimuth = math.degrees(math.atan2(y, max(x, 1e-6)))
    distance = math.hypot(x, y)
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
    """The sonar is at the origin and looks along x, 35 degrees down. The bottom reaches from under it
    to 2.4 m ahead."""
    swell = Relief(0.5, 0.03, 2, 7)
    stones = Relief(0.05, 0.0055, 2, 20)
    draw = Draws(40)
    ragged = Relief(0.05, 0.04, 2, 31)

    def height(x, y):
        rise = 0.025 / (1 + math.exp(-(x - step_at(y)) / 0.03))
        below = 0.035 * math.exp(-(x / 0.35) ** 2)
        return -0.53 + 0.06 * y * y - below + swell(x, y) + stones(x, y) + rise

    bottom = Part("bottom", "fitted_mud")
    columns, rows = range(-32, 481), range(-230, 231)
    numbers = {(i, j): bottom.add_vertex(CELL_M * i, CELL_M * j, height(CELL_M * i, CELL_M * j))
               for j in rows for i in columns}
    for j in rows[:-1]:
        for i in columns[:-1]:
            bottom.add_quad(numbers[i, j], numbers[i + 1, j], numbers[i + 1, j + 1],
                            numbers[i, j + 1], material_at(CELL_M * i, CELL_M * j, ragged, draw))
    return [bottom]


def flocs():
    """Marine snow in the main lobe between the sonar and the bottom."""
    draw = Draws(300)
    part = Part("flocs", "floc")
    for _ in range(FLOCS):
        distance = draw(0.1, 0.48)
        azimuth = math.radians(draw(-28, 28))
        depression = math.radians(35 + draw(-5, 5))
        centre = (distance * math.cos(azimuth) * math.cos(depression),
                  distance * math.sin(azimuth) * math.cos(depression),
                  -distance * math.sin(depression))
        add_sphere(part, centre, (FLOC_M, FLOC_M, FLOC_M), 1)
    return [part]


def surface():
    """The surface of the water, at height 0."""
    return [made("surface", "water_surface", (add_quad, (-3, -3, 0), (3, -3, 0), (3, 3, 0), (-3, 3, 0)))]


OBJECTS = {"close_bottom_flocs.glb": flocs, "close_bottom_surface.glb": surface}
