#!/usr/bin/env python3
"""scripts/stage_costs.py [--sonarsim PROGRAM] [--rounds N] [--mission NAME]

The time of each stage of the calibrated model alone.

Renders configs/tank_calibrated.yaml and rows of configs/seafloor_sidescan_calibrated.yaml on
one thread, without files of pings, without and with one stage. The processes alternate, and the least processor time
of each counts, which other work on the machine disturbs least; that of a run of a few pings is taken off. Prints
the ratios of the time per ping as rows of a table of Markdown.
"""
import argparse
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
ERRORS = "instrument.beam.elements={gain_error_db: 0.5, phase_error_deg: 3}"
ERRORS_OFF = "fls.instrument.beam.elements={gain_error_db: 0, phase_error_deg: 0}"
POINTS = ("scene.particles=[{name: p, kind: fish, length_m: [0.1, 0.3], count: %d, region: ellipsoid, "
          "position_m: %s, size_m: [6, 4, 2]}]")
QUIET = ["water.content=none", "output.labels=[]", *(f"output.{file}=false" for file in ("polar", "image", "fan", "meta",
                                                                                         "waterfall"))]
# By mission: its sensor and the stages.
TANK = ("tank_calibrated", "fls", {
    "water column": ["water.content=coastal"],
    "errors of elements": ["fls." + ERRORS],
    "100 fish": [POINTS % (100, "[0, 0, 1.5]")],
    "10,000 fish": [POINTS % (10000, "[0, 0, 1.5]")],
    "surface of the water": ["scene.water_surface={height_m: 3.2, scatters: true}"],
    "two samples": ["fls.instrument.receiver.samples=2"],
    "ringing": ["fls.instrument.receiver.ring_down_db=140"],
    "motion within a ping": ["fls.moves_in_ping=true"],
    "4 groups of beams": ["fls.moves_in_ping=true", "fls.shutter.groups=4"],
    "multipath": ["fls.multipath.method=cluster"],
    "multipath, retraced 4 times": ["fls.multipath.method=cluster", "fls.multipath.retraced=4"],
})
SIDE = ("seafloor_sidescan_calibrated", "sss", {
    "water column": ["water.content=coastal"],
    "100 fish": [POINTS % (100, "[0, 0, 4]")],
    "10,000 fish": [POINTS % (10000, "[0, 0, 4]")],
    "surface of the water": ["scene.water_surface={height_m: 12, scatters: true}"],
    "two samples": ["sss.instrument.receiver.samples=2"],
    "tail below the bottom": ["sss.instrument.below_bottom=true"],
    "motion within a ping": ["sss.moves_in_ping=true"],
    "second bottom echo": ["scene.water_surface={height_m: 12}", "sss.multipath.method=cluster"],
})


def settings_of(sensor: str, settings: list[str]) -> list[str]:
    return [f"sensors.{one}" if one.startswith(sensor + ".") else one for one in settings]


def seconds(program: str, mission: str, shard: str, settings: list[str]) -> float:
    with tempfile.TemporaryDirectory(prefix="sonarsim-", dir="/dev/shm") as folder:
        command = [program, "render", f"configs/{mission}.yaml", "--threads", "1", "--shard", shard, "--out",
                   f"{folder}/out"]
        for setting in settings:
            command += ["--set", setting]
        before = os.times()
        subprocess.run(command, cwd=ROOT, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        after = os.times()
    return after.children_user + after.children_system - before.children_user - before.children_system


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sonarsim", default=str(ROOT / "build" / "sonarsim"))
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--mission", default="", help="one of the two alone")
    options = parser.parse_args()
    for mission, sensor, stages in (TANK, SIDE):
        if options.mission not in ("", mission):
            continue
        off = settings_of(sensor, [f"{sensor}.instrument.receiver.samples=1",
                                   f"{sensor}.instrument.receiver.ring_down_db=0", *QUIET])
        if sensor == "fls":
            off.append(f"sensors.{ERRORS_OFF}")
        runs = {"": off} | {stage: off + settings_of(sensor, keys) for stage, keys in stages.items()}
        some, few = ({stage: [] for stage in runs} for _ in range(2))
        for _ in range(options.rounds):
            for stage, settings in runs.items():
                some[stage].append(seconds(options.sonarsim, mission, "1/3", settings))
                few[stage].append(seconds(options.sonarsim, mission, "1/60", settings))
        cost = {stage: min(some[stage]) - min(few[stage]) for stage in runs}
        for stage in stages:
            print(f"| {stage} | {mission} | {cost[stage] / cost['']:.2f} |", flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
