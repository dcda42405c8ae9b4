#!/usr/bin/python3
"""Measures the cost of writing: tables in Markdown, for docs/performance.md.

    ./scripts/writing_costs.py [--sonarsim PROGRAM] [--out FOLDER]              per output, the tank
    ./scripts/writing_costs.py --labels [...]                                   per label, likewise
    ./scripts/writing_costs.py --pings 100000 [...]                             many small pings

The first renders the tank with one output at a time, on one thread, and compares processor time with
a run that writes nothing; rounds take turns and the least of each counts, which other work on the
machine disturbs least. The second does so with labels: without any file, beside the metadata alone and
beside the default files, each over the same without labels. The third renders that many pings of 32 x 16 bins, and a
tenth of them: memory that grows with the number of pings would show.
"""
import argparse
import json
import os
import pathlib
import shutil
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
OUTPUTS = ("polar", "image", "fan", "meta")
TANK = [str(ROOT / "configs/tank_imaging.yaml"), "--set", "trajectory.rate_hz=40"]
LAP = [*TANK[:-1], "trajectory.rate_hz=10"]  # there are many labels
SMALL = """\
seed: 1
scene: {{file: {root}/scenes/tank.glb, materials: {root}/scenes/materials.csv}}
trajectory:
  rate_hz: {pings}
  waypoints: [{{position_m: [-1, 0, 1.5], rpy_deg: [0, 15, 0]}}, {{position_m: [-0.000001, 0, 1.5], rpy_deg: [0, 15, 0]}}]
sensors:
  fls: {{kind: imaging, azimuth_deg: 60, elevation_deg: 12, range_bins: 32, azimuth_bins: 16,
        noise: {{add_sigma: 0.08, mult_sigma: 0.15}}}}
"""


def run(program, out, arguments):
    """(what `render --json` prints, processor seconds, peak MiB, files, bytes)."""
    shutil.rmtree(out, ignore_errors=True)
    answer = tempfile.TemporaryFile()
    pid = os.posix_spawn(program, [program, "render", *arguments, "--out", str(out), "--json",
                                   "--log-level", "warning"],
                         os.environ, file_actions=[(os.POSIX_SPAWN_DUP2, answer.fileno(), 1)])
    _, status, usage = os.wait4(pid, 0)
    if status != 0:
        sys.exit("the render failed")
    answer.seek(0)
    sizes = [(pathlib.Path(folder) / name).stat().st_size
             for folder, _, names in os.walk(out) for name in names]
    shutil.rmtree(out, ignore_errors=True)
    return (json.loads(answer.read()), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024,
            len(sizes), sum(sizes))


def per_output(program, out, rounds):
    def only(*names):
        return [part for name in OUTPUTS
                for part in ("--set", f"output.{name}={'true' if name in names else 'false'}")]

    cases = {"nothing": ["--no-files"], **{f"`{name}` alone": only(name) for name in OUTPUTS},
             "the default files": [], "all four": only(*OUTPUTS)}
    least = {}
    for _ in range(rounds):
        for name, arguments in cases.items():
            reported, seconds, _, _, size = run(program, out, [*TANK, "-j1", *arguments])
            ms = 1e3 * seconds / reported["pings"]
            if name not in least or ms < least[name][0]:
                least[name] = (ms, size / reported["pings"])
    base = least["nothing"][0]
    print("| written | ms per ping | times the ping | kB per ping |\n|---|---|---|---|")
    for name, (ms, size) in least.items():
        print(f"| {name} | {ms:.2f} | {ms / base:.2f} | {size / 1e3:.0f} |")


LABELS = {
    "`instance`": "instance",
    "`instance`, `fan`": "instance,fan",
    "`objects`": "objects",
    "`clean`": "clean",
    "`instance`, `share`, `second`, `class`, `material`": "instance,share,second,class,material",
    "`height`, with `scene.bottom: [floor]`": "height",
    "`height`, all of the tank as the bottom": "height",
    "`shadow`": "shadow",
    "`elevation`": "elevation",
    "`instance`, `class`, `share`, `shadow`, `clean`, `objects`":
        "instance,class,share,shadow,clean,objects",
    "all": None,
}


def per_label(program, out, rounds):
    beside = {
        "without files": ["--no-files"],
        "beside the metadata alone": ["--set", "output.polar=false", "--set", "output.fan=false"],
        "beside the default files": [],
    }
    cases = {"no labels": []}
    for name, labels in LABELS.items():
        cases[name] = ["--set", f"output.labels={f'[{labels}]' if labels else 'true'}"]
        if "scene.bottom" in name:
            cases[name] += ["--set", "scene.bottom=[floor]"]
    least = {}
    for _ in range(rounds):
        for name, arguments in cases.items():
            for place, other in beside.items():
                # These labels belong to pictures, which are not written here.
                if "metadata" in place and "`fan`" in name:
                    continue
                reported, seconds, _, _, _ = run(program, out, [*LAP, "-j1", *arguments, *other])
                ms = 1e3 * seconds / reported["pings"]
                least[name, place] = min(least.get((name, place), ms), ms)
    print("| labels | " + " | ".join(
        f"{place} ({least['no labels', place]:.2f} ms)" for place in beside) + " |")
    print("|---|" + "---|" * len(beside))
    for name in LABELS:
        print(f"| {name} | " + " | ".join(
            f"{least[name, place] / least['no labels', place]:.2f}" if (name, place) in least else ""
            for place in beside) + " |")


def many(program, out, pings):
    print("| pings | files | pings/s | files/s | MB/s | share of encode and write | peak MiB |")
    print("|---|---|---|---|---|---|---|")
    with tempfile.TemporaryDirectory() as folder:
        for count in (pings // 10, pings):
            mission = pathlib.Path(folder, "small.yaml")
            mission.write_text(SMALL.format(root=ROOT, pings=count))
            reported, _, peak, files, size = run(program, out, [str(mission)])
            spent = reported["thread_seconds"]
            share = (spent["encode"] + spent["write"]) / sum(spent.values())
            seconds = reported["seconds"]
            print(f"| {reported['pings']} | {files} | {reported['pings_per_s']:.0f} | {files / seconds:.0f} | "
                  f"{size / seconds / 1e6:.1f} | {100 * share:.0f} % | {peak:.0f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--sonarsim", default=str(ROOT / "build/sonarsim"))
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "out/writing_costs")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--labels", action="store_true")
    parser.add_argument("--pings", type=int)
    options = parser.parse_args()
    if options.pings:
        many(options.sonarsim, options.out, options.pings)
    elif options.labels:
        per_label(options.sonarsim, options.out, options.rounds)
    else:
        per_output(options.sonarsim, options.out, options.rounds)


if __name__ == "__main__":
    main()
