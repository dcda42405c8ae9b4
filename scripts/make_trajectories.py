#!/usr/bin/python3
"""Writes the pose files of the example missions: python3 scripts/make_trajectories.py [folder].

World: z up, metres. Vehicle: x forward, y left, z up; positive pitch turns the bow down. Numbers
are rounded to 6 decimals, far coarser than the differences between the sines of C libraries.
"""
import math
import pathlib
import sys

HEADER = "t_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg"


def tank_loop():
    """One round in the near half of the test tank, with the sonar pointing at the objects in the far half.

    The tank is 8 x 6 x 3 m, its floor centred at the origin. The vehicle goes round (-1.5, 0) at
    radii of 1 to 1.5 m, 1.5 m above the floor, and keeps its bow on the point (2.5, 0).
    """
    count, rate_hz = 90, 10
    for k in range(count):
        angle = 2 * math.pi * k / count
        radius = 1.25 + 0.25 * math.cos(2 * angle)
        x = -1.5 + radius * math.cos(angle)
        y = radius * math.sin(angle)
        pitch = 15 + 5 * math.sin(angle)
        yaw = math.degrees(math.atan2(-y, 2.5 - x))
        yield k / rate_hz, x, y, 1.5, 0, pitch, yaw


def seafloor_pass():
    """A straight pass over the middle of the seafloor: 8 m up, 2 m/s, the bow 15 degrees down."""
    count, rate_hz, speed = 120, 5, 2
    for k in range(count):
        x = (k - (count - 1) / 2) * speed / rate_hz
        yield k / rate_hz, x, 0, 8, 0, 15, 0


def wreck_pass():
    """A pass along the wreck, 16 m off its keel and 7 m up: sideways, the bow 15 degrees down."""
    count, rate_hz, speed = 80, 5, 2
    for k in range(count):
        x = (k - (count - 1) / 2) * speed / rate_hz
        yield k / rate_hz, x, -16, 7, 0, 15, 90


def orbit(radius, middle, rise):
    """Seven eighths of a circle around an object at the origin, with the bow on its middle, x = y = 0,
    z = `middle`. Twice on its way the vehicle is `rise` above that height, and twice below."""
    count, rate_hz = 80, 5
    for k in range(count):
        angle = 7 / 4 * math.pi * k / (count - 1)
        up = rise * math.sin(2 * angle)
        yield (k / rate_hz, radius * math.cos(angle), radius * math.sin(angle), middle + up, 0,
               math.degrees(math.atan2(up, radius)), math.degrees(angle) - 180)


def lifeboat_orbit():
    return orbit(7, 1, 2)


def motorbike_orbit():
    return orbit(5, 1.2, 1.5)


def text(value):
    """At most 6 decimals, and no more zeros than needed ("-0" is 0)."""
    return f"{round(value, 6) + 0.0:.6f}".rstrip("0").rstrip(".")


def main():
    root = pathlib.Path(__file__).resolve().parent.parent
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) > 1 else root / "trajectories"
    folder.mkdir(parents=True, exist_ok=True)
    for poses in (tank_loop, seafloor_pass, wreck_pass, lifeboat_orbit, motorbike_orbit):
        lines = [HEADER] + [",".join(map(text, pose)) for pose in poses()]
        (folder / f"{poses.__name__}.csv").write_text("\n".join(lines) + "\n", newline="\n")


if __name__ == "__main__":
    main()
