"""Things of houses, yards and boats. A function a kind: draws to parts; sizes are usual ones."""
import math

from .solids import ball, box, lathe, moved, part, resting, rod, sheet, tube, turned, walk, warped


def lying(draw, share=0.75):
    """Roll, pitch and yaw of a thing that was made upright: most lie on their side."""
    return (0, 90, draw(0, 360)) if draw(0, 1) < share else (0, 0, draw(0, 360))


def bottle(draw):
    """Of glass: a straight body, a shoulder and a neck with a lip."""
    r, high = draw(0.029, 0.045), draw(0.2, 0.33)
    neck, body = r * draw(0.32, 0.45), high * draw(0.5, 0.68)
    profile = [(r * 0.6, 0.012), (r, 0.0), (r, body)] + [
        (neck + (r - neck) * (0.5 + 0.5 * math.cos(math.pi * k / 5)), body + (high * 0.9 - body) * k / 7)
        for k in range(1, 6)] + [(neck, high * 0.93), (neck * 1.2, high * 0.94), (neck * 1.2, high)]
    return resting([part("glass", "glass_bottle", lathe(profile, 28))], lying(draw))


def plastic_bottle(draw):
    """Of PET, ribbed and crumpled, with a cap."""
    r, high = draw(0.031, 0.046), draw(0.2, 0.34)
    waves, depth = draw.whole(4, 9), r * draw(0.02, 0.08)
    rows = 26
    profile = [(0.7 * r, 0.0)] + [
        (r - depth * (0.5 - 0.5 * math.cos(2 * math.pi * waves * k / rows)), 0.72 * high * k / rows + 0.01)
        for k in range(rows + 1)] + [(0.8 * r, 0.82 * high), (0.45 * r, 0.9 * high), (0.42 * r, 0.93 * high)]
    cap = moved(lathe([(0.5 * r, 0), (0.5 * r, 0.06 * high)], 16), 0, 0, 0.935 * high)
    return resting([part("body", "plastic_bottle", lathe(profile, 24)), part("cap", "polyethylene", cap)],
                   lying(draw), draw(0.0, 0.008), draw.whole(1, 9999))


def shampoo_bottle(draw):
    """Elliptic, of polyethylene, with a flat cap or a pump."""
    r, high = draw(0.03, 0.048), draw(0.15, 0.26)
    squash = draw(0.5, 0.75)
    body = lathe([(0.9 * r, 0.0), (r, 0.01), (r * 1.03, 0.4 * high), (0.93 * r, 0.7 * high),
                  (0.5 * r, 0.8 * high)], 28, squash)
    cap = lathe([(0.42 * r, 0.8 * high), (0.42 * r, high)], 16)
    solids = [cap]
    if draw(0, 1) < 0.4:
        solids.append(rod((0, 0, high), (0.05, 0, 1.05 * high), 0.006))
    return resting([part("body", "plastic_bottle", body), part("cap", "polyethylene", *solids)], lying(draw),
                   draw(0, 0.002), draw.whole(1, 9999))


def can(draw):
    """A drinks can or a food tin, more or less crushed."""
    r, high = draw.one_of([(0.033, 0.115), (0.026, 0.135), (0.033, 0.165), (0.037, 0.11), (0.05, 0.12), (0.043, 0.058)])
    rows = 10
    body = [(r + 0.0006 * (k % 2), 0.006 + (high - 0.012) * k / rows) for k in range(rows + 1)]
    profile = [(0.7 * r, 0.006), (0.85 * r, 0.0), *body, (0.86 * r, high), (0.82 * r, high - 0.004)]
    return resting([part("can", "can", lathe(profile, 28))], lying(draw), draw(0, 0.1) ** 2, draw.whole(1, 9999))


def carton(draw):
    """A drinks carton with a gable or a flat top, bulged."""
    w, d, high = draw(0.06, 0.1), draw(0.055, 0.09), draw(0.12, 0.24)
    top, faces = draw.one_of([0.0, 0.045]), 8

    def bulge(x, y, z):
        gable = max(0.0, z - high) / max(top, 1e-9)
        swell = 1 + 0.06 * math.sin(math.pi * min(1.0, z / high))
        return (x * swell, y * swell * (1 - 0.95 * gable), z)
    levels = [high * k / faces for k in range(faces + 1)] + ([high + top] if top else [])
    corners = lathe([(math.sqrt(0.5), z) for z in levels], 4)
    body = warped(turned(corners, yaw=45), lambda x, y, z: bulge(x * w, y * d, z))
    pieces = [part("carton", "carton", body)]
    if draw(0, 1) < 0.5:
        pieces.append(part("cap", "polyethylene", moved(lathe([(0.014, 0), (0.014, 0.018)], 12), 0.2 * w, 0, high)))
    return resting(pieces, lying(draw), draw(0, 0.006), draw.whole(1, 9999))


def bucket(draw):
    """With a wall, a rim and a handle that lies over."""
    r, high, wall = draw(0.11, 0.17), draw(0.2, 0.33), 0.004
    foot = r * draw(0.7, 0.85)
    shell = lathe([(0, 0), (foot, 0), (r, high), (r + 0.012, high), (r + 0.012, high - 0.015), (r + 0.014, high + 0.003),
                   (r - wall, high), (foot - wall, wall), (0, wall)], 28)
    lean = draw(20, 160)
    handle = [(r * math.cos(a), -r * math.sin(a) * math.cos(math.radians(lean)),
               high - 0.02 + r * math.sin(a) * math.sin(math.radians(lean))) for a in (math.pi * k / 14 for k in range(15))]
    return resting([part("shell", draw.one_of(["polyethylene", "steel"]), shell),
                    part("handle", "steel", tube(handle, 0.004, 6))], lying(draw, 0.6), draw(0, 0.01), draw.whole(1, 9999))


def crate(draw):
    """For bottles or fish: slats, a bottom and compartments."""
    x, y, z, wall = draw(0.35, 0.6), draw(0.28, 0.4), draw(0.2, 0.32), 0.008
    solids, rows = [box((x, y, wall))], draw.whole(2, 4)
    for k in range(rows):
        middle, slat = z * (k + 0.5) / rows, 0.6 * z / rows
        for s in (-1, 1):
            solids += [box((x, wall, slat), (0, s * (y - wall) / 2, middle)),
                       box((wall, y, slat), (s * (x - wall) / 2, 0, middle))]
    solids += [box((0.03, 0.03, z), (s * (x / 2 - 0.02), t * (y / 2 - 0.02), z / 2)) for s in (-1, 1) for t in (-1, 1)]
    if draw(0, 1) < 0.5:
        solids += [box((wall, y - 0.02, 0.5 * z), (x * k / 4, 0, 0.25 * z + wall)) for k in (-1, 0, 1)]
        solids += [box((x - 0.02, wall, 0.5 * z), (0, y * k / 6, 0.25 * z + wall)) for k in (-1, 1)]
    return resting([part("crate", draw.one_of(["polyethylene", "wood"]), *solids)], (0, 0, draw(0, 360)))


def pallet(draw):
    x, y, board = draw(0.8, 1.2), draw(0.8, 1.0), draw(0.018, 0.024)
    solids = [box((x, 0.1, 0.08), (0, k * (y / 2 - 0.05), 0.07)) for k in (-1, 0, 1)]
    count = draw.whole(5, 8)
    for k in range(count):
        if draw(0, 1) < 0.9:
            solids.append(turned(box((0.1, y, board), (x * ((k + 0.5) / count - 0.5), 0, 0.12)), yaw=draw(-1, 1)))
    solids += [box((0.1, y, board), (k * (x / 2 - 0.05), 0, 0.02)) for k in (-1, 0, 1)]
    return resting([part("boards", "wood", *solids)], (0, 0, draw(0, 360)))


def plank(draw):
    """One to three, across each other."""
    solids, z = [], 0.0
    for _ in range(draw.whole(1, 3)):
        x, y, thick = draw(0.4, 2.5), draw(0.07, 0.25), draw(0.015, 0.05)
        bow = draw(-0.03, 0.03)
        one = sheet(12, 2, lambda u, v, x=x, y=y, bow=bow, t=thick: (
            x * (u - 0.5), y * (v - 0.5), t + bow * x * math.sin(math.pi * u)), thick)
        solids.append(moved(turned(one, draw(-4, 4), 0, draw(-60, 60)), 0, 0, z))
        z += thick
    return resting([part("planks", "wood", *solids)], (0, 0, draw(0, 360)), 0.003, draw.whole(1, 9999))


def panel(draw):
    """Corrugated or plain, bent; some lean on a stone."""
    x, y = draw(0.3, 1.4), draw(0.25, 0.9)
    waves, depth, bow = draw.one_of([0, 0, 6, 10]), draw(0.006, 0.015), draw(-0.08, 0.08)
    solid = sheet(48 if waves else 14, 8, lambda u, v: (
        x * (u - 0.5), y * (v - 0.5), depth * math.sin(2 * math.pi * waves * u) + bow * math.sin(math.pi * v)), 0.004)
    material = draw.one_of(["rusty_steel", "aluminium", "pvc", "wood"])
    if draw(0, 1) < 0.5:
        return resting([part("panel", material, solid)], (0, 0, draw(0, 360)), 0.01, draw.whole(1, 9999))
    lean = draw(15, 50)
    stone = moved(ball((0.1, 0.12, 0.5 * y * math.sin(math.radians(lean))), ((0.8, 0.3),), draw.whole(1, 999)), 0, 0.2 * y)
    return resting([part("panel", material, turned(solid, lean)), part("stone", "rock", stone)], (0, 0, draw(0, 360)))


def frame(draw):
    """Of tubes: a rectangle, some with uprights, braces and a top."""
    x, y, z, r = draw(0.3, 1.2), draw(0.3, 0.9), draw(0.2, 0.8), draw(0.008, 0.022)
    at = [(s * x / 2, t * y / 2) for s, t in ((-1, -1), (1, -1), (1, 1), (-1, 1))]
    solids = []
    for high in [0.0] + draw.one_of([[], [z], [z, z / 2]]):
        solids += [rod((*a, high), (*b, high), r) for a, b in zip(at, at[1:] + at[:1])]
    if len(solids) > 4:
        solids += [rod((*a, 0), (*a, z), r) for a in at]
    solids.append(rod((*at[0], 0), (*at[2], 0), 0.8 * r))
    return resting([part("frame", draw.one_of(["steel", "aluminium", "rusty_steel"]), *solids)],
                   (draw(-8, 8), draw(-8, 8), draw(0, 360)))


def ladder(draw):
    long, wide, r = draw(1.2, 3.0), draw(0.3, 0.45), draw(0.012, 0.02)
    steps = int(long / draw(0.25, 0.32))
    rails = [box((long, 0.06, 0.025), (0, s * wide / 2, 0)) for s in (-1, 1)]
    rungs = [rod((long * ((k + 0.5) / steps - 0.5), -wide / 2, 0), (long * ((k + 0.5) / steps - 0.5), wide / 2, 0), r)
             for k in range(steps) if draw(0, 1) < 0.95]
    material = draw.one_of(["aluminium", "wood"])
    return resting([part("rails", material, *rails), part("rungs", material, *rungs)], (draw(-6, 6), draw(-4, 4), draw(0, 360)))


def brick(draw):
    """Bricks, or a block with two holes."""
    if draw(0, 1) < 0.5:
        x, y, z, w = 0.4, draw(0.15, 0.2), 0.2, 0.03
        solids = [box((x, w, z), (0, s * (y - w) / 2, 0)) for s in (-1, 1)]
        solids += [box((w, y - 2 * w, z), (s * (x - w) / 2, 0, 0)) for s in (-1, 0, 1)]
        return resting([part("block", "concrete", *solids)], draw.one_of([(0, 0, 0), (90, 0, 0), (90, 12, 0)]))
    solids = [moved(turned(box((draw(0.12, 0.25), 0.115, 0.065)), 0, 0, draw(0, 360)), draw(-0.25, 0.25) * (k > 0),
                    draw(-0.2, 0.2) * (k > 0), 0.033) for k in range(draw.whole(1, 4))]
    return resting([part("bricks", "brick", *solids)], (0, 0, 0), 0.004, draw.whole(1, 999))


def tarpaulin(draw):
    """Cloth in folds, a bag or a sheet."""
    x, y, fold = draw(0.4, 1.6), draw(0.3, 1.2), draw(0.03, 0.12)
    seed = draw.whole(1, 9999)
    solid = sheet(26, 22, lambda u, v: (x * (u - 0.5), y * (v - 0.5), 0.0), 0.006)
    return resting([part("cloth", "cloth", solid)], (0, 0, draw(0, 360)), fold, seed)


def person(draw):
    """Head, trunk and limbs in a drawn posture; some are divers with a cylinder."""
    size = draw(0.85, 1.1)
    lean = draw.one_of([0, 0, draw(0, 60), 90])  # 90: sits or stands

    def limb(start, lengths, radii, aim, bend):
        """Two segments from `start`; aim and bend are (azimuth, elevation) in degrees."""
        points, a, e = [start], *aim
        for length in lengths:
            ca, sa, ce, se = (f(math.radians(x)) for x in (a, e) for f in (math.cos, math.sin))
            points.append(tuple(p + size * length * c for p, c in zip(points[-1], (ca * ce, sa * ce, se))))
            a, e = a + bend[0], e + bend[1]
        return tube(points, [size * r for r in radii], 10), points[-1]
    ce, se = math.cos(math.radians(lean)), math.sin(math.radians(lean))
    at = lambda t, y, up=0.0: (size * (t * ce - up * se), size * y, size * (t * se + up * ce))
    trunk = tube([at(t, 0) for t in (0, 0.12, 0.3, 0.48, 0.56)], [size * r for r in (0.13, 0.16, 0.15, 0.17, 0.07)], 14, flat=0.65)
    solids = [trunk, moved(ball([size * r for r in (0.1, 0.08, 0.11)]), *at(0.69, 0, draw(-0.03, 0.06))),
              rod(at(0.54, 0), at(0.64, 0), 0.055 * size)]
    for side in (-1, 1):
        arm, _ = limb(at(0.47, 0.19 * side), (0.3, 0.29), (0.055, 0.045, 0.03),
                      (side * draw(20, 170), draw(-15, 35)), (draw(-70, 70), draw(-40, 20)))
        leg, foot = limb(at(0.0, 0.09 * side), (0.43, 0.43), (0.09, 0.065, 0.04),
                         (180 - side * draw(0, 45) if lean < 90 else side * draw(0, 40), draw(-10, 30) if lean < 90 else draw(-15, 35)),
                         (side * draw(-30, 60), draw(-60, 10)))
        solids += [arm, leg, moved(ball((0.13 * size, 0.045 * size, 0.045 * size)), *foot)]
    pieces = [part("body", "flesh", *solids)]
    if draw(0, 1) < 0.4:
        tank = moved(turned(lathe([(0.06, 0), (0.09, 0.04), (0.09, 0.5), (0.03, 0.58)], 18), 0, 90 - lean), *at(0.0, 0, 0.2))
        pieces.append(part("cylinder", "aluminium", tank))
    return resting(pieces, (draw.one_of([0, 0, 90, 180]) if lean < 90 else 0, 0, draw(0, 360)), 0.012, draw.whole(1, 9999))


def rope(draw):
    """A rope with bends, or a coil."""
    r = draw(0.005, 0.016)
    if draw(0, 1) < 0.4:
        coil = draw(0.12, 0.3)
        points = [((coil + 0.03 * math.sin(2.3 * a)) * math.cos(a), coil * math.sin(a), 0.25 * r * a)
                  for a in (2 * math.pi * k / 22 for k in range(22 * draw.whole(2, 5)))]
        return resting([part("rope", "rope", tube(points, r, 6))])
    way = walk(draw, draw.whole(30, 110), 0.04, 16, 6)
    points = [(x, y, 0.4 * r * math.sin(0.9 * k) + 0.0001 * k) for k, (x, y, _) in enumerate(way)]
    return resting([part("rope", "rope", tube(points, r, 6))])


def cable(draw):
    """Stiffer, thicker and longer than a rope."""
    way = walk(draw, draw.whole(40, 90), 0.09, 4, 3)
    r = draw(0.008, 0.03)
    points = [(x, y, draw(0, 0.3) * r + 0.0001 * k) for k, (x, y, _) in enumerate(way)]
    return resting([part("cable", "rubber", tube(points, r, 8))])


KINDS = [bottle, brick, bucket, cable, can, carton, crate, frame, ladder, pallet, panel, person,
         plank, plastic_bottle, rope, shampoo_bottle, tarpaulin]
