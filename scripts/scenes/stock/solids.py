"""Closed solids as (vertices, triangles): each edge has two triangles. Metres, z up."""
import math

from ..glb import Part
from ..noise import Draws, noise3
from ..shapes import cells, circle, frame_along, icosphere, made


class Draw(Draws):
    """The draws of one example of a kind."""

    def one_of(self, choices):
        return choices[int(self(0, len(choices)))]

    def whole(self, low, high):
        return int(self(low, high + 1))


def bridged(vertices, rings, loop):
    """The solid of rings of vertex numbers, each joined to the next; a loop's last to its first."""
    sides, faces = len(rings[0]), []
    for low, high in zip(rings, rings[1:] + rings[:1] if loop else rings[1:]):
        for k in range(sides):
            n = (k + 1) % sides
            if low[k] != low[n]:
                faces.append((low[k], low[n], high[n]))
            if high[k] != high[n]:
                faces.append((low[k], high[n], high[k]))
    return vertices, faces


def lathe(profile, sides=24, squash=1.0):
    """A surface of revolution about z of (radius, height) pairs, with lids or closed to a ring; `squash`: elliptic."""
    loop = profile[0] == profile[-1]
    profile = profile[:-1] if loop else [(0, profile[0][1]), *profile, (0, profile[-1][1])]
    vertices, rings = [], []
    for r, z in profile:
        first = len(vertices)
        if r == 0:
            vertices.append((0.0, 0.0, z))
            rings.append([first] * sides)
        else:
            vertices += [(r * c, r * squash * s, z) for c, s in circle(sides)]
            rings.append(list(range(first, first + sides)))
    if not loop:  # a profile that starts or ends on the axis needs no lid
        if profile[1][0] == 0:
            rings = rings[1:]
        if profile[-2][0] == 0:
            rings = rings[:-1]
    return bridged(vertices, rings, loop)


def tube(points, radius, sides=8, loop=False, flat=1.0):
    """A tube along points. `radius` is a number, or one for each point; `flat` squeezes its section."""
    count = len(points)
    vertices, rings = [], []
    u = None
    for k, p in enumerate(points):
        before = points[k - 1] if loop or k else p
        after = points[(k + 1) % count] if loop or k < count - 1 else p
        along = [b - a for a, b in zip(before, after)]
        length = math.hypot(*along)
        along = [c / length for c in along]
        if u is None:
            u = frame_along(along)[0]
        lean = sum(a * b for a, b in zip(u, along))
        u = [a - lean * b for a, b in zip(u, along)]
        length = math.hypot(*u)
        u = [c / length for c in u]
        v = [along[1] * u[2] - along[2] * u[1], along[2] * u[0] - along[0] * u[2], along[0] * u[1] - along[1] * u[0]]
        r = radius[k] if isinstance(radius, list) else radius
        first = len(vertices)
        vertices += [tuple(p[i] + r * (c * u[i] + flat * s * v[i]) for i in range(3)) for c, s in circle(sides)]
        rings.append(list(range(first, first + sides)))
    if not loop:
        for place, point in ((0, points[0]), (len(rings), points[-1])):
            rings.insert(place if place == 0 else len(rings), [len(vertices)] * sides)
            vertices.append(tuple(point))
    return bridged(vertices, rings, loop)


def rod(start, end, radius, sides=8):
    return tube([start, end], radius, sides)


def ring(radius, wire, around=20, sides=6):
    return tube([(radius * c, radius * s, 0.0) for c, s in circle(around)], wire, sides, True)


def sheet(columns, rows, surface, thickness):
    """A sheet with a thickness along z; surface(u, v) for u, v in 0..1 gives its points."""
    top = [surface(i / columns, j / rows) for j in range(rows + 1) for i in range(columns + 1)]
    count, wide = len(top), columns + 1
    faces = [half for a, b, c, d in cells(columns, rows) for half in ((a, b, c), (a, c, d))]
    faces += [(c + count, b + count, a + count) for a, b, c in faces]
    rim = [i for i in range(columns)] + [j * wide + columns for j in range(rows)] \
        + [rows * wide + i for i in range(columns, 0, -1)] + [j * wide for j in range(rows, 0, -1)]
    for a, b in zip(rim, rim[1:] + rim[:1]):
        faces += [(b, a, a + count), (b, a + count, b + count)]
    return top + [(x, y, z - thickness) for x, y, z in top], faces


def box(size, centre=(0, 0, 0)):
    x, y, z = (s / 2 for s in size)
    return moved(sheet(1, 1, lambda u, v: ((2 * u - 1) * x, (2 * v - 1) * y, z), 2 * z), *centre)


def ball(radii, bumps=(), seed=1, levels=2):
    """An ellipsoid, or a stone: bumps are (size, share of the radius) of noise on the unit sphere."""
    points, faces = icosphere(levels)
    scales = [1 + sum(a * noise3(p, s, seed + k) for k, (s, a) in enumerate(bumps)) for p in points]
    return [tuple(r * f * c for r, c in zip(radii, p)) for p, f in zip(points, scales)], faces


def warped(solid, change):
    return [change(*p) for p in solid[0]], solid[1]


def moved(solid, x=0.0, y=0.0, z=0.0):
    return warped(solid, lambda a, b, c: (a + x, b + y, c + z))


def turned(solid, roll=0.0, pitch=0.0, yaw=0.0):
    """Turned about x, then y, then z, in degrees."""
    for axis, degrees in ((0, roll), (1, pitch), (2, yaw)):
        c, s = math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
        i, j = (axis + 1) % 3, (axis + 2) % 3

        def turn(*p, i=i, j=j, c=c, s=s):
            p = list(p)
            p[i], p[j] = c * p[i] - s * p[j], s * p[i] + c * p[j]
            return tuple(p)
        if degrees:
            solid = warped(solid, turn)
    return solid


def walk(draw, steps, step_m, wander_deg, bend_deg=0.0):
    """Points (x, y) with headings in degrees of a way that bends as it pleases."""
    x = y = 0.0
    heading, rate = draw(0, 360), draw(-1, 1) * bend_deg
    way = []
    for _ in range(steps):
        way.append((x, y, heading))
        rate = 0.8 * rate + draw(-1, 1) * wander_deg
        heading += rate
        x += step_m * math.cos(math.radians(heading))
        y += step_m * math.sin(math.radians(heading))
    return way


def part(name, material, *solids):
    """A part of a thing, for resting()."""
    return name, material, solids


def resting(pieces, turn=(0, 0, 0), dent=0.0, seed=1):
    """The Parts of a thing that is turned, rests on z = 0 around x = y = 0, and is dented by up to `dent` m."""
    pieces = [(name, material, [turned(s, *turn) for s in solids]) for name, material, solids in pieces]
    every = [p for _, _, solids in pieces for s in solids for p in s[0]]
    size = max(max(axis) - min(axis) for axis in zip(*every))

    def dented(x, y, z):
        p = (x, y, z)
        return tuple(c + dent * (0.7 * noise3(p, 0.25 * size, seed + k) + 0.3 * noise3(p, 0.08 * size, seed + 9 + k))
                     for k, c in enumerate(p))
    if dent:
        pieces = [(name, material, [warped(s, dented) for s in solids]) for name, material, solids in pieces]
        every = [p for _, _, solids in pieces for s in solids for p in s[0]]
    low, high = ([f(axis) for axis in zip(*every)] for f in (min, max))
    move = -(low[0] + high[0]) / 2, -(low[1] + high[1]) / 2, -low[2]
    return [made(name, material, *((Part.add, *moved(s, *move)) for s in solids)) for name, material, solids in pieces]
