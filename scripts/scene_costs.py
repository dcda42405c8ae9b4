#!/usr/bin/python3
"""Measures the cost of composed scenes: tables in Markdown, for docs/performance.md.

    ./scripts/scene_costs.py copies [--counts 1000 100000] [--sonarsim PROGRAM]
    ./scripts/scene_costs.py motion [--sonarsim PROGRAM]

The first scatters rings of 10,000 triangles over a plane, as many to the square metre in each case,
and renders them as shared meshes. The second renders a hundred rocks once at rest and once on their
way, with each kind of sonar and with rays, which alone see what moves.

All runs use one thread and write no files. Rounds take turns and the least time counts, which other
work on the machine disturbs least. The time before the first ping is the processor time of a run of two
pings. The time of a ping beside moving objects is the difference of processor time between a run of many
pings and one of few. With a hundred thousand copies that difference would be lost in the time before the
first ping, so pings there are timed by the clock. Clock and processor time are never subtracted from
each other, since they differ on a busy machine.
"""
import argparse
import json
import math
import os
import pathlib
import random
import sys
import tempfile

from scenes import minefield
from scenes.glb import Part, write_glb
from scenes.shapes import add_grid, add_torus

ROOT = pathlib.Path(__file__).resolve().parent.parent
MATERIALS = ROOT / "scenes/materials.csv"
FEW = 2  # pings
SONARS = {
    "imaging": "{kind: imaging, azimuth_deg: 70, elevation_deg: 18, range_max_m: 20, "
               "range_bins: 512, azimuth_bins: 256, mount: {rpy_deg: [0, 15, 0]}}",
    "profiling": "{kind: profiling, range_max_m: 20}",
    "sidescan": "{kind: sidescan, range_max_m: 20}",
    "echosounder": "{kind: echosounder, range_max_m: 20}",
}


def processor(program, mission, pings):
    """(seconds of the processor, seconds of the pings by the clock, peak MiB) of a run."""
    answer = tempfile.TemporaryFile()
    pid = os.posix_spawn(program, [program, "render", str(mission), "--no-files", "-j1", "--json",
                                   "--set", f"trajectory.rate_hz={pings - 1}"], os.environ,
                         file_actions=[(os.POSIX_SPAWN_DUP2, answer.fileno(), 1),
                                       (os.POSIX_SPAWN_OPEN, 2, os.devnull, os.O_WRONLY, 0)])
    _, status, usage = os.wait4(pid, 0)
    if status != 0:
        sys.exit(f"{mission}: the render failed")
    answer.seek(0)
    return (usage.ru_utime + usage.ru_stime, json.loads(answer.read())["seconds"],
            usage.ru_maxrss / 1024)


def ping_ms(program, missions, pings, rounds):
    """By mission: milliseconds of the processor for a ping."""
    least = {}
    for _ in range(rounds):
        for name, mission in missions.items():
            for count in (FEW, pings):
                seconds = processor(program, mission, count)[0]
                least[name, count] = min(seconds, least.get((name, count), seconds))
    return {name: 1e3 * (least[name, pings] - least[name, FEW]) / (pings - FEW)
            for name in missions}


def mission_of(path, scene, sonar, length_m=1.0):
    """Writes a mission of one sonar that moves on by `length_m` in a second, 3 m above the plane."""
    path.write_text(f"""\
seed: 1
engine: rays
scene:
{scene}
trajectory:
  speed_m_s: {length_m}
  waypoints: [{{position_m: [0, 0, 3]}}, {{position_m: [{length_m}, 0, 3]}}]
sensors:
  sonar: {sonar}
""")
    return path


def plane(path, half):
    part = Part("floor", "sand")
    axis = [half * (k / 20 - 1) for k in range(41)]
    add_grid(part, axis, axis, lambda x, y: 0.0)
    write_glb(path, [part])


def copies(options, folder):
    ring = Part("ring", "steel")
    add_torus(ring, (0, 0, 0), 0.4, 0.15, 100, 50)
    write_glb(folder / "ring.glb", [ring])
    missions = {}
    for count in options.counts:
        half = 1.25 * math.sqrt(count)
        plane(folder / f"plane_{count}.glb", half + 5)
        missions[count] = mission_of(folder / f"copies_{count}.yaml", f"""\
  file: {folder}/plane_{count}.glb
  materials: {MATERIALS}
  repeats: shared
  scatter:
    - {{name: ring, files: [{folder}/ring.glb], count: {count}, area_min_m: [{-half}, {-half}],
       area_max_m: [{half}, {half}]}}""", SONARS["imaging"])
    print("| copies | triangles | peak MiB | s before the first ping | ms per ping | pings/s |\n"
          "|---|---|---|---|---|---|")
    for count, mission in missions.items():
        few, runs = [], []
        for _ in range(options.rounds):
            few.append(processor(options.sonarsim, mission, FEW))
            runs.append(processor(options.sonarsim, mission, options.pings))
        before = min(seconds for seconds, _, _ in few)
        ms = 1e3 * min(clock for _, clock, _ in runs) / options.pings
        print(f"| {count:,} | {count * ring.triangles():,} | {max(run[2] for run in runs):.0f} | "
              f"{before:.1f} | {ms:.2f} | {1e3 / ms:.0f} |", flush=True)


def motion(options, folder):
    plane(folder / "plane.glb", 30)
    write_glb(folder / "rock.glb", minefield.rock())
    place = random.Random(1)
    lines = {"still": [], "moving": []}
    for k in range(100):
        x, y, z = place.uniform(-2, 18), place.uniform(-10, 10), place.uniform(0.4, 2.5)
        start = f"    - {{name: rock_{k}, file: {folder}/rock.glb, "
        lines["still"].append(f"{start}position_m: [{x:.3f}, {y:.3f}, {z:.3f}]}}")
        lines["moving"].append(
            f"{start}trajectory: {{speed_m_s: 0.3, waypoints: [{{position_m: [{x:.3f}, {y:.3f}, "
            f"{z:.3f}]}}, {{position_m: [{x:.3f}, {y + 0.3:.3f}, {z:.3f}]}}]}}}}")
    missions = {}
    for kind, sonar in SONARS.items():
        for state, objects in lines.items():
            missions[kind, state] = mission_of(
                folder / f"{kind}_{state}.yaml", f"  file: {folder}/plane.glb\n  materials: "
                f"{MATERIALS}\n  objects:\n" + "\n".join(objects), sonar)
    found = ping_ms(options.sonarsim, missions, options.pings, options.rounds)
    print("| sonar | ms per ping, still | moving | times |\n|---|---|---|---|")
    for kind in SONARS:
        still, moving = found[kind, "still"], found[kind, "moving"]
        print(f"| {kind} | {still:.3f} | {moving:.3f} | {moving / still:.2f} |")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("copies", "motion"))
    parser.add_argument("--sonarsim", default=str(ROOT / "build/sonarsim"))
    parser.add_argument("--counts", type=int, nargs="+", default=[1000, 100000])
    parser.add_argument("--pings", type=int, default=302)
    parser.add_argument("--rounds", type=int, default=3)
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        {"copies": copies, "motion": motion}[options.what](options, pathlib.Path(folder))


if __name__ == "__main__":
    main()
