"""Shapes to add to a part. All coordinates are world coordinates in metres, z up."""
import math

from .glb import Part


def made(name, material, *shapes):
    """The part of some shapes, each (function, arguments)."""
    part = Part(name, material)
    for add, *arguments in shapes:
        add(part, *arguments)
    return part


def circle(n):
    """Cosine and sine at n equal steps around."""
    return [(math.cos(2 * math.pi * k / n), math.sin(2 * math.pi * k / n)) for k in range(n)]


def cells(columns, rows):
    """The quads of a grid of points that are numbered row after row."""
    wide = columns + 1
    return [(a, a + 1, a + 1 + wide, a + wide) for j in range(rows) for a in range(j * wide, j * wide + columns)]


def add_box(part, centre, size, yaw_deg=0.0):
    """A box of `size` around `centre`, turned about z."""
    cosine, sine = math.cos(math.radians(yaw_deg)), math.sin(math.radians(yaw_deg))
    corners = []
    for dz in (-0.5, 0.5):
        for dx, dy in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)):
            x, y = dx * size[0], dy * size[1]
            corners.append((centre[0] + cosine * x - sine * y, centre[1] + sine * x + cosine * y, centre[2] + dz * size[2]))
    part.add(corners, [(3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)])


def frame_along(axis):
    """Two unit vectors perpendicular to `axis` and to each other."""
    length = math.sqrt(sum(c * c for c in axis))
    z = [c / length for c in axis]
    helper = (1.0, 0.0, 0.0) if abs(z[0]) < 0.9 else (0.0, 1.0, 0.0)
    along = sum(h * c for h, c in zip(helper, z))
    x = [h - along * c for h, c in zip(helper, z)]
    length = math.sqrt(sum(c * c for c in x))
    x = [c / length for c in x]
    return x, [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]]


def add_cylinder(part, start, end, radius, sides):
    """A closed cylinder between two points."""
    u, v = frame_along([b - a for a, b in zip(start, end)])
    rings = [[foot[k] + radius * (c * u[k] + s * v[k]) for k in range(3)] for foot in (start, end) for c, s in circle(sides)]
    faces = []
    for k in range(sides):
        n = (k + 1) % sides
        faces += [(k, n, sides + n, sides + k), (2 * sides, n, k), (2 * sides + 1, sides + k, sides + n)]
    part.add([*rings, start, end], faces)


def add_line(part, points, radius, sides):
    """Cylinders from each point to the next."""
    for a, b in zip(points, points[1:]):
        if math.dist(a, b) > 0.01:
            add_cylinder(part, a, b, radius, sides)


def add_sides(part, along, up, hull_point, is_there=lambda side, i, j: True):
    """Both sides of a hull by hull_point(u, v, side), u from -1 to 1 and v from 0 to 1."""
    for side in (-1, 1):
        part.add([hull_point(2 * i / along - 1, j / up, side) for j in range(up + 1) for i in range(along + 1)],
                 [face for face in cells(along, up) if is_there(side, face[0] % (along + 1), face[0] // (along + 1))])


def add_torus(part, centre, ring_radius, tube_radius, around, across):
    """A torus that lies flat, its axis along z."""
    points = [(centre[0] + c * (ring_radius + tube_radius * p), centre[1] + s * (ring_radius + tube_radius * p),
               centre[2] + tube_radius * q) for c, s in circle(around) for p, q in circle(across)]
    rings = [range(k * across, (k + 1) * across) for k in range(around)]
    part.add(points, [(a[j], b[j], b[j + 1 - across], a[j + 1 - across]) for a, b in zip(rings, rings[1:] + rings[:1])
                      for j in range(across)])


def icosphere(levels):
    """Unit vectors and triangles of an icosahedron whose faces are quartered `levels` times."""
    t = (1 + math.sqrt(5)) / 2
    points = [(-1, t, 0), (1, t, 0), (-1, -t, 0), (1, -t, 0), (0, -1, t), (0, 1, t),
              (0, -1, -t), (0, 1, -t), (t, 0, -1), (t, 0, 1), (-t, 0, -1), (-t, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4),
             (11, 10, 2), (10, 7, 6), (7, 1, 8), (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8),
             (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    for _ in range(levels):
        middles = {}

        def middle(a, b):
            key = (min(a, b), max(a, b))
            if key not in middles:
                middles[key] = len(points)
                points.append(tuple((p + q) / 2 for p, q in zip(points[a], points[b])))
            return middles[key]

        quartered = []
        for a, b, c in faces:
            ab, bc, ca = middle(a, b), middle(b, c), middle(c, a)
            quartered += [(a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca)]
        faces = quartered
    lengths = [math.sqrt(sum(c * c for c in p)) for p in points]
    return [tuple(c / n for c in p) for p, n in zip(points, lengths)], faces


def add_sphere(part, centre, radii, levels, bumps=lambda direction: 1.0):
    """An ellipsoid; `bumps` scales its radius by direction."""
    points, faces = icosphere(levels)
    part.add([[at + radius * scale * c for at, radius, c in zip(centre, radii, p)]
              for p, scale in zip(points, map(bumps, points))], faces)


def add_grid(part, xs, ys, height, material_of=None):
    """The surface z = height(x, y) over a grid as a part of its own, with material_of(x, y, z) of a corner of each cell."""
    def material(face):
        row, column = divmod(face[0], len(xs))
        return material_of(xs[column], ys[row], part.vertices[3 * face[0] + 1])
    part.add([(x, y, height(x, y)) for y in ys for x in xs], cells(len(xs) - 1, len(ys) - 1), material_of and material)
