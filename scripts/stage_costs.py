#!/usr/bin/python3
"""scripts/stage_costs.py [--sonarsim PROGRAM] [--rounds N] [--mission NAME]

The time of each stage of the calibrated model alone.

Renders configs/tank_calibrated.yaml and rows of configs/seafloor_sidescan_calibrated.yaml on
one thread, without files of pings, without and with one stage, one after the other. The processor time of a run of a
few pings is taken off each. Prints the median of the ratios of such pairs as rows of a table of Markdown, with the
least and the greatest: other work on the machine makes them differ.
"""
import argparse
import os
import pathlib
import statistics
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
# Each mission: its sensor, the shard of its pings that is rendered, and the settings of each stage.
TANK = ("tank_calibrated", "fls", "1/1", {
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
})
SIDE = ("seafloor_sidescan_calibrated", "sss", "1/3", {
    "water column": ["water.content=coastal"],
    "100 fish": [POINTS % (100, "[0, 0, 4]")],
    "10,000 fish": [POINTS % (10000, "[0, 0, 4]")],
    "surface of the water": ["scene.water_surface={height_m: 12, scatters: true}"],
    "two samples": ["sss.instrument.receiver.samples=2"],
    "ringing": ["sss.instrument.receiver.ring_down_db=140"],
    "tail below the bottom": ["sss.instrument.below_bottom=true"],
    "motion within a ping": ["sss.moves_in_ping=true"],
    "second bottom echo": ["scene.water_surface={height_m: 12}", "sss.multipath.method=cluster"],
    "sound-speed profile": ["scene.water_surface={height_m: 12}", "water.profile={named: summer}"],
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
    for mission, sensor, share, stages in (TANK, SIDE):
        if options.mission not in ("", mission):
            continue
        off = settings_of(sensor, [f"{sensor}.instrument.receiver.samples=1",
                                   f"{sensor}.instrument.receiver.ring_down_db=0", *QUIET])
        if sensor == "fls":
            off.append(f"sensors.{ERRORS_OFF}")
        for stage, keys in {"none of them": [], **stages}.items():
            runs = [off, off + settings_of(sensor, keys)]
            start = [min(seconds(options.sonarsim, mission, "1/60", run) for _ in range(2)) for run in runs]
            ratios = []
            for _ in range(options.rounds):
                without, with_it = (seconds(options.sonarsim, mission, share, run) - begin
                                    for run, begin in zip(runs, start))
                ratios.append(with_it / without)
            print(f"| {stage} | {mission} | {statistics.median(ratios):.2f} | {min(ratios):.2f} to {max(ratios):.2f} |",
                  flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
