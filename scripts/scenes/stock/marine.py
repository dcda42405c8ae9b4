"""Things of ships, harbours and wars, and what grows and lies on the bottom. A function a kind."""
import math

from .household import lying
from .solids import ball, box, lathe, moved, part, resting, ring, rod, sheet, tube, turned, walk, warped


def tyre_solids(draw, r, wide):
    """A hollow tyre with treads, its axis along z."""
    bead, wall, w = r * draw(0.56, 0.66), 0.03 * r + 0.004, wide / 2
    outer = [(bead, -0.75 * w), (0.82 * r, -w), (0.94 * r, -0.97 * w), (r, -0.7 * w), (r, -0.25 * w), (0.985 * r, -0.2 * w),
             (0.985 * r, 0.2 * w), (r, 0.25 * w), (r, 0.7 * w), (0.94 * r, 0.97 * w), (0.82 * r, w), (bead, 0.75 * w)]
    inner = [(bead, 0.75 * w - wall), (0.82 * r, w - wall), (0.95 * r - wall, 0.6 * w), (0.95 * r - wall, -0.6 * w),
             (0.82 * r, wall - w), (bead, wall - 0.75 * w)]
    sides, deep = 60, draw(0.01, 0.03)
    around = [0]

    def tread(x, y, z):
        around[0] += 1
        cut = deep if (around[0] - 1) % sides % 3 == 0 and math.hypot(x, y) > 0.96 * r else 0.0
        return x * (1 - cut), y * (1 - cut), z
    return [warped(lathe([*outer, *inner, outer[0]], sides), tread)], bead


def tyre(draw):
    """Of a kart, a motorbike, a car or a lorry, with treads and a hollow; most lie."""
    r, wide = draw.one_of([(0.13, 0.1), (0.28, 0.1), (0.3, 0.18), (0.33, 0.22), (0.5, 0.28)])
    solids, _ = tyre_solids(draw, r * draw(0.9, 1.1), wide * draw(0.9, 1.1))
    return resting([part("tyre", "tyre", *solids)],
                   draw.one_of([(draw(-4, 4), 0, 0), (draw(-20, 20), 0, 0), (80 + draw(0, 20), 0, draw(0, 360))]),
                   draw(0, 0.02), draw.whole(1, 9999))


def wheel(draw):
    """A tyre on its rim."""
    r, wide = draw(0.28, 0.36), draw(0.15, 0.24)
    solids, bead = tyre_solids(draw, r, wide)
    rim = [lathe([(bead * 0.98, -0.3 * wide), (bead, 0.3 * wide), (0.8 * bead, 0.3 * wide), (0.7 * bead, 0.12 * wide),
                  (0.25 * bead, 0.2 * wide), (0.25 * bead, 0.1 * wide), (0.8 * bead, -0.05 * wide), (0.98 * bead, -0.3 * wide)], 30)]
    rim.append(lathe([(0.26 * bead, 0.05 * wide), (0.2 * bead, 0.25 * wide)], 16))
    return resting([part("tyre", "tyre", *solids), part("rim", draw.one_of(["steel", "aluminium"]), *rim)],
                   (draw(-6, 6) if draw(0, 1) < 0.7 else 85, 0, draw(0, 360)))


def drum(draw):
    """An oil drum, of steel and dented or of plastic; some stand."""
    r, high = draw.one_of([(0.29, 0.88), (0.24, 0.7), (0.18, 0.5)])
    profile = [(r * 0.96, 0.015), (r * 0.97, 0.0), (r, 0.005)]
    for z in (1 / 3, 2 / 3):
        profile += [(r, high * z - 0.03), (r + 0.014, high * z), (r, high * z + 0.03)]
    profile += [(r, high - 0.005), (r * 0.97, high), (r * 0.96, high - 0.015)]
    bung = moved(lathe([(0.03, 0), (0.03, 0.012)], 10), 0.6 * r, 0, high - 0.015)
    return resting([part("drum", draw.one_of(["steel_drum", "plastic_drum", "rusty_steel"]), lathe(profile, 36), bung)],
                   lying(draw), draw(0, 0.06), draw.whole(1, 9999))


def gas_cylinder(draw):
    r, high = draw.one_of([(0.15, 0.55), (0.115, 1.3), (0.09, 0.6)])
    dome = [(r * math.cos(a), 0.82 * high + 0.5 * r * math.sin(a)) for a in (math.pi / 12 * k for k in range(6))]
    valve = [moved(lathe([(0.03, 0), (0.025, 0.05), (0.012, 0.09)], 12), 0, 0, 0.8 * high + 0.5 * r), ring(0.1, 0.008)]
    valve[1] = moved(valve[1], 0, 0, 0.8 * high + 0.5 * r + 0.08)
    return resting([part("cylinder", "steel", lathe([(r * 0.9, 0), (r, 0.05), *dome], 28)), part("valve", "steel", *valve)],
                   lying(draw, 0.85))


def chain(draw):
    """Links of one size along a way with bends; every other link stands."""
    wire = draw.one_of([draw(0.004, 0.008), draw(0.008, 0.02)])
    long, wide = 5.2 * wire, 1.8 * wire
    count = draw.whole(22, 48)
    link = tube([(math.copysign(long / 2 - wide, c) + wide * c, wide * s, 0) for c, s in
                 ((math.cos(a), math.sin(a)) for a in (math.pi * (k + 0.5) / 5 for k in range(10)))], wire / 2, 6, True)
    solids = [moved(turned(link, 45 if k % 2 else -45, draw(-6, 6), h), x, y, 0)
              for k, (x, y, h) in enumerate(walk(draw, count, long - 1.6 * wire, 12, 10))]
    return resting([part("links", draw.one_of(["steel", "rusty_steel"]), *solids)])


def hook(draw):
    """A crane's or a fishing hook with an eye, a block in some."""
    r, wire = draw(0.04, 0.12), draw(0.15, 0.3)
    arc = [(r * math.cos(a), 0.0, r * math.sin(a)) for a in (math.radians(110 - 18 * k) for k in range(17))]
    arc = [(-0.34 * r, 0, 3.1 * r), (-0.34 * r, 0, 2 * r), *arc]
    thick = [wire * r * w for w in [0.7, 0.8] + [1.0 + 0.35 * math.sin(math.pi * k / 16) - 0.6 * (k / 16) ** 3 for k in range(17)]]
    solids = [tube(arc, thick, 12), moved(turned(ring(0.5 * r, 0.55 * wire * r, 16), 90), -0.34 * r, 0, 3.5 * r)]
    if draw(0, 1) < 0.3:
        solids.append(moved(turned(lathe([(1.2 * r, -0.35 * r), (1.2 * r, 0.35 * r)], 24), 90), -0.34 * r, 0, 4.9 * r))
    return resting([part("hook", draw.one_of(["steel", "rusty_steel"]), *solids)], (90 + draw(-8, 8), 0, draw(0, 360)))


def anchor(draw):
    """Stockless, with a stock, or a grapnel."""
    size, kind = draw(0.35, 1.4), draw.whole(0, 2)
    t = 0.04 * size
    solids = [rod((0, 0, 0), (0, 0, size), t), moved(turned(ring(0.09 * size, 0.6 * t, 14), 90), 0, 0, 1.08 * size)]
    if kind == 0:
        solids.append(box((0.16 * size, 0.55 * size, 0.14 * size)))
        for s in (-1, 1):
            solids.append(tube([(0.02 * size, s * 0.24 * size, 0), (0.16 * size, s * 0.27 * size, 0.28 * size),
                                (0.24 * size, s * 0.28 * size, 0.5 * size)], [1.6 * t, 1.6 * t, 0.3 * t], 8, flat=0.5))
    else:
        for yaw in (0, 180) if kind == 1 else (0, 90, 180, 270):
            arm = tube([(0, 0, 0), (0.2 * size, 0, 0.03 * size), (0.33 * size, 0, 0.13 * size), (0.4 * size, 0, 0.27 * size)],
                       [t, t, 0.9 * t, 0.3 * t], 8)
            fluke = moved(turned(ball((0.09 * size, 0.07 * size, 0.015 * size)), 0, -60), 0.37 * size, 0, 0.2 * size)
            solids += [turned(arm, yaw=yaw), turned(fluke, yaw=yaw)]
        if kind == 1:
            solids += [rod((0, -0.36 * size, 0.9 * size), (0, 0.36 * size, 0.9 * size), 0.7 * t)]
    pieces = [part("anchor", draw.one_of(["steel", "rusty_steel"]), *solids)]
    return resting(pieces, (0, 90 + draw(-10, 10), draw(0, 360)))


def propeller(draw):
    """A hub and two to five twisted blades."""
    r, blades, pitch = draw(0.1, 0.4), draw.whole(2, 5), draw(0.6, 1.2)
    wide = draw(1.4, 2.1) * r / (blades + 1)

    def blade(u, v):
        along = 0.16 * r + 0.84 * r * u
        across = wide * (v - 0.5) * 2 * (0.35 + 0.65 * math.sin(math.pi * min(1.0, 0.12 + 0.85 * u))) * (1 - u ** 6)
        lean = math.atan(pitch * r / (2 * math.pi * max(along, 0.25 * r)) * 2)
        return along, across * math.cos(lean) + 0.12 * r * u * u, across * math.sin(lean)
    solids = [turned(sheet(12, 6, blade, 0.03 * r), yaw=360 * k / blades) for k in range(blades)]
    solids.append(lathe([(0.2 * r, -0.2 * r), (0.21 * r, 0.1 * r), (0.12 * r, 0.24 * r), (0.05 * r, 0.28 * r)], 20))
    return resting([part("propeller", draw.one_of(["aluminium", "copper", "steel"]), *solids)],
                   (draw(-25, 25), draw(-10, 10), draw(0, 360)))


def parts_of_valve(draw, r):
    flange = [(0.7 * r, -2.4 * r), (1.9 * r, -2.4 * r), (1.9 * r, -1.9 * r), (1.0 * r, -1.8 * r), (1.5 * r, -0.6 * r)]
    body = turned(lathe(flange + [(x, -z) for x, z in reversed(flange)], 24), 0, 90)
    bonnet = lathe([(1.0 * r, 0.5 * r), (1.0 * r, 1.9 * r), (0.4 * r, 2.1 * r), (0.25 * r, 3.6 * r)], 16)
    if draw(0, 1) < 0.65:
        wide, high = draw(1.3, 2.2) * r, 3.4 * r
        solids = [moved(ring(wide, 0.18 * r, 24), 0, 0, high)]
        solids += [rod((0, 0, high), (wide * math.cos(a), wide * math.sin(a), high), 0.13 * r, 6)
                   for a in (2 * math.pi * k / 5 for k in range(5))]
    else:
        solids = [box((5 * r, 0.6 * r, 0.2 * r), (2 * r, 0, 3.5 * r))]
    return [part("body", draw.one_of(["steel", "rusty_steel", "copper"]), body, bonnet), part("wheel", "steel", *solids)]


def pose_of_valve(draw):
    return draw.one_of([0, draw(60, 110), draw(-110, -60)]), 0, draw(0, 360)


def valve(draw):
    """A body with flanges, a bonnet and a handwheel or a lever."""
    return resting(parts_of_valve(draw, draw(0.03, 0.1)), pose_of_valve(draw))


def line_valve(draw):
    """A valve between two pieces of its pipe."""
    r = draw(0.03, 0.1)
    pipes = [rod((2.4 * side * r, 0, 0), ((2.4 + draw(1, 7)) * side * r, 0, 0), 0.7 * r, 20) for side in (-1, 1)]
    return resting([*parts_of_valve(draw, r), part("pipe", "steel", *pipes)], pose_of_valve(draw))


def pipe(draw):
    """A straight pipe with a wall and flanges, or an elbow."""
    r, long = draw(0.03, 0.15), draw(0.4, 2.5)
    wall, material = 0.1 * r, draw.one_of(["steel", "pvc", "concrete", "rusty_steel"])
    if draw(0, 1) < 0.3:
        bend = 3 * r
        arc = [(bend * math.cos(a), bend * math.sin(a), 0) for a in (math.pi / 2 * k / 10 for k in range(11))]
        arc = [(bend, -2 * r, 0), *arc, (-2 * r, bend, 0)]
        return resting([part("pipe", material, tube(arc, [1.25 * r] + [r] * (len(arc) - 2) + [1.25 * r], 16))],
                       (draw(-30, 30), 0, draw(0, 360)))
    ends = [(r, 0.0)] if draw(0, 1) < 0.5 else [(1.5 * r, 0.0), (1.5 * r, 0.2 * r), (r, 0.2 * r)]
    outer = ends + [(r, long * k / 8) for k in range(1, 8)] + [(x, long - z) for x, z in reversed(ends)]
    profile = outer + [(r - wall, long), (r - wall, 0.0), outer[0]]
    return resting([part("pipe", material, lathe(profile, 24))], (0, 90, draw(0, 360)))


def block(draw):
    """A mooring weight with an eye and a piece of chain or rope."""
    x, z = draw(0.3, 1.0), draw(0.2, 0.6)
    eye = moved(turned(ring(0.1, 0.014, 14), 90, 0, draw(0, 180)), 0, 0, z + 0.05)
    body = [warped(sheet(6, 6, lambda u, v: (x * (u - 0.5), x * (v - 0.5), z), z), lambda a, b, c: (
        a * (1.15 - 0.15 * c / z), b * (1.15 - 0.15 * c / z), c))]
    way = [(a, b) for a, b, _ in walk(draw, 26, 0.05, 14)]
    line = tube([(0, 0, z + 0.12)] + [(a + x * 0.8, b, 0.02) for a, b in way], 0.014, 6)
    pieces = [part("block", "concrete", *body), part("eye", "steel", eye)]
    return resting(pieces + ([part("line", "rope", line)] if draw(0, 1) < 0.5 else []), (draw(-6, 6), 0, draw(0, 360)),
                   0.015, draw.whole(1, 9999))


def buoy(draw):
    """A ball, a fender or a cone with an eye, a band and a line."""
    r = draw(0.1, 0.35)
    body = draw.one_of([ball((r, r, r), levels=3), lathe([(0.15 * r, -1.6 * r), (0.9 * r, -1.3 * r), (r, 0), (0.9 * r, 1.3 * r),
                                                          (0.15 * r, 1.6 * r)], 24),
                        lathe([(0.1 * r, -1.3 * r), (r, 0.3 * r), (r, 0.8 * r), (0.4 * r, 1.2 * r)], 24)])
    band = lathe([(0.9 * r, -0.06 * r), (1.04 * r, -0.06 * r), (1.04 * r, 0.06 * r), (0.9 * r, 0.06 * r), (0.9 * r, -0.06 * r)], 24)
    eye = moved(turned(ring(0.2 * r, 0.05 * r, 14), 90), 0, 0, min(p[2] for p in body[0]) - 0.1 * r)
    return resting([part("float", "polyethylene", body, band), part("eye", "steel", eye)],
                   (draw(40, 140), 0, draw(0, 360)), draw(0, 0.02), draw.whole(1, 9999))


def netting(draw, x, y, mesh, hill):
    """Threads of a net over low hills, and its height at u, v in 0..1."""
    waves = [(draw(1, 4), draw(1, 4), draw(0, 6)) for _ in range(3)]

    def at(u, v):
        z = sum(0.5 + 0.5 * math.sin(a * 3 * u + b * 3 * v + c) for a, b, c in waves) / 3
        return (x * (u - 0.5) + 0.2 * mesh * math.sin(9 * v), y * (v - 0.5) + 0.2 * mesh * math.sin(8 * u), hill * z ** 2)
    lines = []
    for wide, other, point in ((x, y, lambda a, b: at(a, b)), (y, x, lambda a, b: at(b, a))):
        count = min(16, max(4, int(wide / mesh)))
        for k in range(count + 1):
            if draw(0, 1) < 0.93:
                lines.append(tube([point(k / count, j / 14) for j in range(15)], 0.003, 3))
    return lines, at


def net(draw):
    lines, _ = netting(draw, draw(0.6, 2.2), draw(0.6, 1.8), draw(0.05, 0.13), draw(0.02, 0.25))
    return resting([part("net", "rope", *lines)], (0, 0, draw(0, 360)))


def ghost_gear(draw):
    """A lost net with its head rope, floats and weights."""
    x, y = draw(1.0, 2.4), draw(0.6, 1.6)
    lines, at = netting(draw, x, y, 0.12, draw(0.15, 0.5))
    head = tube([at(k / 24, 0.0) for k in range(25)], 0.011, 6)
    floats = [moved(ball((0.05, 0.035, 0.035)), *at(k / 7, 0.0)) for k in range(8) if draw(0, 1) < 0.8]
    leads = [moved(ball((0.03, 0.018, 0.018), levels=1), *at(k / 9, 1.0)) for k in range(10)]
    return resting([part("net", "rope", *lines, head), part("floats", "polyethylene", *floats), part("leads", "steel", *leads)],
                   (0, 0, draw(0, 360)))


def trap(draw):
    """A lobster pot or a crab trap: a frame with bars, a net and an entrance."""
    x, y, z, r = draw(0.45, 0.9), draw(0.35, 0.6), draw(0.25, 0.4), 0.007
    round_top = draw(0, 1) < 0.5

    def arch(place):
        if not round_top:
            return [(place, -y / 2, 0), (place, -y / 2, z), (place, y / 2, z), (place, y / 2, 0)]
        return [(place, y / 2 * math.cos(a), z * math.sin(a)) for a in (math.pi * k / 10 for k in range(11))]
    solids = [tube(arch(x * (k / 3 - 0.5)), r, 6) for k in range(4)]
    points = arch(0)
    for _, b, c in [p for k, p in enumerate(points) if k % 2 == 0 or not round_top]:
        solids.append(rod((-x / 2, b, c), (x / 2, b, c), 0.7 * r, 6))
    bars = [rod((x * (k / 10 - 0.5), -y / 2, 0), (x * (k / 10 - 0.5), y / 2, 0), 0.005, 4) for k in range(11)]
    bars += [tube(arch(x * ((k + 0.5) / 12 - 0.5)), 0.002, 3) for k in range(12)]
    funnel = moved(turned(lathe([(0.13, 0), (0.06, 0.12), (0.055, 0.12), (0.125, 0), (0.13, 0)], 14), 0, 90), -x / 2, 0, 0.5 * z)
    return resting([part("frame", "steel", *solids), part("bars", "rope", *bars), part("entrance", "polyethylene", funnel)],
                   (draw.one_of([0, 0, 90, 180]), 0, draw(0, 360)))


def mine(draw):
    """A cylinder, a truncated cone, a horned ball or a wedge."""
    kind = draw.whole(0, 3)
    if kind == 0:
        r, long = draw(0.22, 0.33), draw(1.2, 2.4)
        nose = [(r * math.sin(a), long - 0.25 + 0.25 * math.cos(a)) for a in (math.pi / 2 * k / 6 for k in range(6, 0, -1))]
        solid = lathe([(0.9 * r, 0), (r, 0.03), (r, 0.6 * long), (r + 0.012, 0.61 * long), (r + 0.012, 0.66 * long), (r, 0.67 * long),
                       *nose], 32)
        lug = [box((0.05, 0.08, 0.12), (r, 0, long * k)) for k in (0.3, 0.5)]
        return resting([part("mine", "steel", solid, *lug)], (0, 90, draw(0, 360)))
    if kind == 1:
        r = draw(0.4, 0.55)
        solid = lathe([(r, 0), (r, 0.07), (0.55 * r, 0.4), (0.4 * r, 0.46)], 40)
        return resting([part("mine", "polyethylene", solid, moved(lathe([(0.08, 0), (0.07, 0.04)], 16), 0, 0, 0.45))],
                       (draw(-5, 5), 0, 0))
    if kind == 2:
        r = draw(0.3, 0.5)
        horns = [turned(moved(lathe([(0.035, 0), (0.03, 0.1), (0.02, 0.13)], 10), 0, 0, 0.97 * r), 0, tilt, yaw)
                 for tilt, n in ((0, 1), (55, 5), (110, 5)) for yaw in (360 * k / n for k in range(n))]
        return resting([part("mine", "rusty_steel", ball((r, r, r), ((0.5, 0.02),), 3, 3), *horns)], (draw(0, 90), 0, draw(0, 360)), 0.01)
    r, z = draw(0.35, 0.5), draw(0.35, 0.5)
    solid = warped(lathe([(r, 0), (1.05 * r, 0.08), (0.75 * r, z), (0.6 * r, z + 0.02)], 32, 0.8),
                   lambda a, b, c: (a + 0.3 * c, b, c * (1 - 0.3 * a / r)))
    return resting([part("mine", "polyethylene", solid)], (0, 0, draw(0, 360)))


def torpedo(draw):
    """With a body in sections, fins and a propeller."""
    r, long = draw(0.16, 0.27), draw(2.2, 4.5)
    nose = [(r * math.sin(a), long - r + r * math.cos(a)) for a in (math.pi / 2 * k / 7 for k in range(7, 0, -1))]
    body = lathe([(0.25 * r, 0), (0.6 * r, 0.3), (r, 0.9), (r, 0.5 * long), (1.02 * r, 0.505 * long), (r, 0.51 * long), *nose], 28)
    fins = [turned(box((0.9 * r, 0.012, 0.3), (0.8 * r, 0, 0.3)), yaw=90 * k + 45) for k in range(4)]
    blades = [turned(moved(turned(box((0.7 * r, 0.25 * r, 0.01)), 35), 0.45 * r, 0, -0.03), yaw=90 * k) for k in range(4)]
    return resting([part("body", draw.one_of(["steel", "aluminium", "rusty_steel"]), body), part("fins", "steel", *fins, *blades)],
                   (0, 90, draw(0, 360)), 0.01, draw.whole(1, 999))


def wreckage(draw):
    """Bent plates with ribs and beams."""
    solids, ribs = [], []
    for k in range(draw.whole(1, 3)):
        x, y, bow, seed = draw(0.4, 1.6), draw(0.3, 1.1), draw(-0.4, 0.4), draw(0, 9)
        at = lambda u, v, x=x, y=y, bow=bow, s=seed: (
            x * (u - 0.5) * (1 - 0.3 * math.sin(5 * v + s)), y * (v - 0.5) * (1 - 0.25 * math.sin(7 * u + s)),
            bow * x * (u - 0.5) ** 2 * 2 + 0.05 * math.sin(6 * v + 3 * u + s))
        turn, where = (draw(-50, 50), draw(-15, 15), draw(0, 360)), (draw(-0.5, 0.5), draw(-0.5, 0.5), 0)
        solids.append(moved(turned(sheet(14, 10, at, 0.008), *turn), *where))
        for v in (0.2, 0.5, 0.8):
            rib = tube([tuple(c - 0.03 * (i == 2) for i, c in enumerate(at(j / 8, v))) for j in range(9)], 0.022, 4)
            ribs.append(moved(turned(rib, *turn), *where))
    for _ in range(draw.whole(0, 4)):
        a = [draw(-0.9, 0.9), draw(-0.9, 0.9), draw(-0.1, 0.1)]
        ribs.append(rod(a, [c + draw(-0.8, 0.8) * (1 if i < 2 else 0.3) for i, c in enumerate(a)], draw(0.01, 0.04), 6))
    return resting([part("plates", "rusty_steel", *solids), part("beams", "rusty_steel", *ribs)], (0, 0, 0), 0.05, draw.whole(1, 999))


def stone(draw):
    r = draw(0.05, 0.35)
    body = ball((r, r * draw(0.55, 1), r * draw(0.4, 0.9)), ((0.9, draw(0.4, 0.9)), (0.35, draw(0.05, 0.25)), (0.15, 0.05)),
                draw.whole(1, 9999), 3)
    return resting([part("stone", draw.one_of(["rock", "limestone"]), body)], (draw(-30, 30), draw(-30, 30), draw(0, 360)))


def boulder_pile(draw):
    """Boulders on and beside each other."""
    solids, spread = [], draw(0.25, 0.7)
    for k in range(draw.whole(4, 9)):
        r = draw(0.1, 0.4) * (1 - 0.05 * k)
        x, y = (draw(-1, 1) * spread for _ in range(2))
        lift = 0.25 * max(0.0, 1 - math.hypot(x, y) / spread)
        solids.append(moved(ball((r, r * draw(0.6, 1), r * draw(0.5, 0.8)), ((0.8, 0.6), (0.3, 0.15)), draw.whole(1, 9999)), x, y, lift + 0.4 * r))
    return resting([part("boulders", "rock", *solids)], (0, 0, draw(0, 360)))


def coral_head(draw):
    """A lump with knobs, or branches."""
    r, seed = draw(0.12, 0.5), draw.whole(1, 9999)
    solids = [ball((r, r * draw(0.7, 1), r * draw(0.5, 0.9)), ((0.6, draw(0.2, 0.7)), (0.22, draw(0.1, 0.3)), (0.1, 0.12)), seed, 3)]
    for _ in range(draw.one_of([0, 10, 18])):
        a, e = draw(0, 2 * math.pi), draw(0.3, 1.4)
        tip = [c * draw(1.2, 1.7) * r for c in (math.cos(a) * math.cos(e), math.sin(a) * math.cos(e), math.sin(e))]
        solids.append(tube([[0.5 * c for c in tip], tip], [0.13 * r, 0.04 * r], 6))
    return resting([part("coral", "limestone", *solids)])


def starfish(draw):
    arms, r = draw.one_of([5, 5, 5, 6, 9]), draw(0.06, 0.2)
    bend = [draw(-25, 25) for _ in range(arms)]
    solids = [ball((0.35 * r, 0.35 * r, 0.16 * r))]
    for k in range(arms):
        a, points = math.radians(360 * k / arms), [(0.0, 0.0, 0.0)]
        for j in range(6):
            points.append((points[-1][0] + r / 6 * math.cos(a), points[-1][1] + r / 6 * math.sin(a), 0.0))
            a += math.radians(bend[k] / 6)
        solids.append(tube(points, [r * w for w in (0.24, 0.22, 0.19, 0.16, 0.12, 0.08, 0.03)], 8, flat=0.5))
    return resting([part("starfish", "flesh", *solids)], (0, 0, draw(0, 360)), 0.06 * r, draw.whole(1, 999))


def fronds(draw, count, high, wide, sway, flat):
    """Stems that lean with the current."""
    a, solids = draw(0, 2 * math.pi), []
    for _ in range(count):
        x, y, top = draw(-wide, wide), draw(-wide, wide), high * draw(0.5, 1.0)
        lean, turn = sway * draw(0.5, 1.2), a + draw(-0.5, 0.5)
        points = [(x + lean * top * t * t * math.cos(turn), y + lean * top * t * t * math.sin(turn), top * t * (1 - 0.3 * lean * t))
                  for t in (k / 6 for k in range(7))]
        solids.append(tube(points, [0.012 * (1.2 - t) * (1 if flat == 1 else 2.5) for t in (k / 6 for k in range(7))], 5, flat=flat))
    return solids


def plant(draw):
    """A bush of stems."""
    return resting([part("plant", "weed", *fronds(draw, draw.whole(9, 26), draw(0.1, 0.45), draw(0.03, 0.15), draw(0.2, 1.2), 1))])


def weed(draw):
    """Kelp or a patch of sea grass."""
    return resting([part("weed", "weed", *fronds(draw, draw.whole(12, 40), draw(0.2, 0.9), draw(0.1, 0.5), draw(0.5, 1.6), 0.12))])


def drag_mark(draw):
    """Two low walls of sand beside the way of an anchor or a trawl door."""
    wide, high = draw(0.04, 0.15), draw(0.006, 0.03)
    way = walk(draw, draw.whole(14, 40), 0.09, 3, 2)
    solids = []
    for side in (-1, 1) if draw(0, 1) < 0.6 else (1,):
        points = [(x - side * wide * math.sin(math.radians(h)), y + side * wide * math.cos(math.radians(h)), 0) for x, y, h in way]
        last = len(points) - 1
        solids.append(tube(points, [high * (0.25 + min(1.0, k / 4, (last - k) / 4)) * draw(0.7, 1.2) for k in range(last + 1)], 8))
    return resting([part("ridge", "sand", *solids)])


KINDS = [anchor, block, boulder_pile, buoy, chain, coral_head, drag_mark, drum, gas_cylinder, ghost_gear, hook,
         line_valve, mine, net, pipe, plant, propeller, starfish, stone, torpedo, trap, tyre, valve, weed, wheel, wreckage]
