#!/usr/bin/python3
"""Measures the page of a large dataset: its size, the time to make it, to open it and to step.

    scripts/gallery_costs.py PROGRAM [--pings 10000]

renders a small sonar in the tank, with a fan and its boxes for every ping, writes the gallery and opens it in
a headless Chromium (Debian's chromium and chromium-driver). The times depend on the machine's load.
"""
import argparse
import pathlib
import resource
import statistics
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests/cli"))
import browser  # noqa: E402

MISSION = """\
name: large
scene: {file: ROOT/scenes/tank.glb, materials: ROOT/scenes/materials.csv}
trajectory:
  waypoints:
    - {position_m: [-3, -1, 1.5], rpy_deg: [0, 15, 20]}
    - {position_m: [1, 1, 1.5], rpy_deg: [0, 15, 50]}
  speed_m_s: 0.01
  rate_hz: RATE
sensors:
  fls: {kind: imaging, azimuth_deg: 60, elevation_deg: 12, range_bins: 96, azimuth_bins: 48}
output: {folder: out, polar: false, labels: [coco], fan_width_px: 96}
"""

# Steps through pings one after the other and notes how long each takes until its picture is there.
STEPS = """
window.steps = [];
const poses = %s;
const step = () => {
  if (!poses.length) { window.finished = true; return; }
  const begin = performance.now();
  go(poses.shift());
  const image = image_of(url_of(view(), state.ping));
  const note = () => { window.steps.push(performance.now() - begin); setTimeout(step, %d); };
  image.done ? note() : image.addEventListener('load', note);
};
window.finished = false;
step();
"""


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("--pings", type=int, default=10000)
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        way_m = (4**2 + 2**2)**0.5
        rate = (arguments.pings - 1) / (way_m / 0.01)
        mission = MISSION.replace("ROOT", str(ROOT)).replace("RATE", repr(rate))
        (folder / "mission.yaml").write_text(mission)
        program = arguments.program.resolve()
        subprocess.run([program, "render", "mission.yaml", "-q"], cwd=folder, check=True)
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        subprocess.run([program, "gallery", "out", "-q"], cwd=folder, check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        cpu_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
        page = folder / "out/index.html"
        with browser.Browser() as window:
            begin = time.monotonic()
            window.open(page)
            window.wait_for("return image_of(url_of(view(), state.ping)).naturalWidth")
            opened_s = time.monotonic() - begin
            pings = window.run("return sensor().pings")
            print(f"{pings} pings: a page of {page.stat().st_size / 1e6:.2f} MB, made in {cpu_s:.2f} s of "
                  f"processor time, opens in {opened_s:.2f} s")
            # The page loads neighbouring pings ahead; after a jump nothing is loaded yet.
            jumps = [(k * 7919) % pings for k in range(1, 101)]
            for what, poses, pause_ms in (("to the next ping", list(range(1, 101)), 60),
                                          ("to any other", jumps, 0)):
                window.run(STEPS % (poses, pause_ms))
                window.wait_for("return window.finished")
                steps = window.run("return window.steps")
                print(f"a step {what}: {statistics.median(steps):.1f} ms in the median, "
                      f"{max(steps):.0f} at most")


if __name__ == "__main__":
    main()
