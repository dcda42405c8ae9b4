#!/usr/bin/env python3
"""Renders the small missions of this folder and compares what they make with goldens.txt.

    tests/golden/goldens.py PROGRAM [--write] [--keep FOLDER]

Each mission is rendered with one and with two threads. A line of goldens.txt is a dataset (with all variants), a sensor (or
`-`), a kind of file, the number of such files, and the hash of their contents: arrays, decoded pixels, parsed JSON without
what names a build, a version or a sum. --write writes goldens.txt again; say in the commit why its lines changed.
"""
import argparse
import concurrent.futures
import contextlib
import hashlib
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import numpy as np
from PIL import Image

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parent.parent
sys.path.append(str(ROOT / "tests/cli"))
from sandbox import box_mesh, gltf, height_of

GOLDENS = HERE / "goldens.txt"
PREVIEWED = ("imaging_strips", "records")
# Files about the making of a dataset, and the keys of JSON files that name a build, a version or a sum of a file.
NOT_HASHED = ("SHA256SUMS", "journal.txt", "mission.resolved.yaml")
NOT_COMPARED = {"build", "program_version", "format_version", "mission_hash", "inputs_hash", "sha256"}


def make_scenes(folder):
    """Missions, instruments and scenes as the missions name them."""
    shutil.copytree(HERE / "missions", folder / "missions")
    shutil.copytree(ROOT / "configs", folder / "configs")
    (folder / "scenes").mkdir()
    for file in (ROOT / "scenes/tank.glb", ROOT / "scenes/materials.csv"):
        shutil.copy(file, folder / "scenes")
    (folder / "scenes/crate.gltf").write_text(gltf([{"name": "crate", "mesh": 0}], [box_mesh((0.4, 0.4, 0.4))], ("steel",)))
    heights = np.array([[height_of(row, column) for column in range(60)] for row in range(40)], np.uint16)
    Image.fromarray(heights).save(folder / "scenes/heights.png")


def without_builds(value):
    if isinstance(value, dict):
        return {key: without_builds(one) for key, one in value.items() if key not in NOT_COMPARED}
    return [without_builds(one) for one in value] if isinstance(value, list) else value


def json_bytes(value):
    return json.dumps(without_builds(value), sort_keys=True).encode()


def array_bytes(array):
    return f"{array.dtype.str} {array.shape} ".encode() + np.ascontiguousarray(array).tobytes()


def pixel_bytes(path):
    """The pixels, and the colours of a table. Versions of Pillow differ in the type of 16-bit grey pixels."""
    with Image.open(path) as image:
        pixels = np.asarray(image)
        colours = np.asarray(image.convert("RGB")).tobytes() if image.mode == "P" else b""
    return array_bytes(pixels.astype(np.int32) if pixels.dtype.kind in "iu" else pixels) + colours


def contents(path):
    """Pairs of a kind and bytes. A description of a dataset has one for each sensor."""
    if path.name == "dataset.json":
        description = json.loads(path.read_text())
        sensors, labels = description.pop("sensors"), description.pop("labels", None)
        yield "-", path.name, json_bytes(description)
        yield "-", f"{path.name}#labels", json_bytes(labels)
        for sensor in sensors:
            yield sensor["name"], f"{path.name}#sensor", json_bytes(sensor)
    elif path.suffix == ".json":
        yield None, None, json_bytes(json.loads(path.read_text()))
    elif path.suffix == ".npy":
        yield None, None, array_bytes(np.load(path))
    elif path.suffix in (".png", ".tif"):
        yield None, None, pixel_bytes(path)
    else:
        yield None, None, path.read_bytes()


def lines_of(name, folder):
    """The lines of one dataset."""
    found = {}
    for path in sorted(folder.rglob("*")):
        if path.is_dir() or path.name in NOT_HASHED:
            continue
        relative = re.sub(r"^variant_\d+/", "", path.relative_to(folder).as_posix())
        sensor, _, rest = relative.rpartition("/") if "/" not in relative else relative.partition("/")
        for own_sensor, own_kind, data in contents(path):
            key = (own_sensor or sensor or "-", own_kind or re.sub(r"(^|/|_)\d{4,6}\.", r"\1*.", rest))
            count, whole = found.setdefault(key, [0, hashlib.sha256()])
            found[key][0] = count + 1
            whole.update(hashlib.sha256(data).digest())
    return [f"{name} {sensor} {kind} {count} {whole.hexdigest()[:32]}" for (sensor, kind), (count, whole) in sorted(found.items())]


class Renderer:
    def __init__(self, program, folder):
        self.program, self.folder = str(pathlib.Path(program).resolve()), folder

    def run(self, *words):
        command = [self.program, *map(str, words)]
        result = subprocess.run(command, cwd=self.folder, capture_output=True, text=True, check=False)
        if result.returncode:
            raise SystemExit(f"{' '.join(command)}: exit code {result.returncode}\n{result.stderr}")

    def with_threads(self, name, threads):
        out = self.folder / f"out/{name}_{threads}"
        self.run("render", f"missions/{name}.yaml", "--quiet", "--out", out, "--threads", threads)
        if not all((dataset / "SHA256SUMS").is_file() for dataset in sorted(out.glob("variant_*")) or [out]):
            raise SystemExit(f"{out}: the dataset is not complete")
        return lines_of(name, out)

    def previews(self):
        """The pictures of sonarsim preview, of a fan, and of a side-scan sonar, an echosounder and a scanning sonar."""
        lines = []
        for name in PREVIEWED:
            out = self.folder / f"out/{name}_preview.png"
            self.run("preview", f"missions/{name}.yaml", "--ping", "3", "--quiet", "--out", out)
            lines.append(f"preview - {name}.png 1 {hashlib.sha256(pixel_bytes(out)).hexdigest()[:32]}")
        return lines


def all_runs(renderer):
    """Name, number of threads, and lines of every run, two at a time."""
    names = sorted(path.stem for path in (HERE / "missions").glob("*.yaml"))
    jobs = [(name, threads, renderer.with_threads, (name, threads)) for threads in (1, 2) for name in names]
    jobs.append(("preview", 1, renderer.previews, ()))
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        futures = [(name, threads, pool.submit(run, *arguments)) for name, threads, run, arguments in jobs]
        return [(name, threads, future.result()) for name, threads, future in futures]


def differences(expected, found):
    """One line for each line that differs, by dataset, sensor and kind."""
    expected, found = ({tuple(line.split()[:3]): line for line in lines} for lines in (expected, found))
    for kind in sorted(expected.keys() | found.keys()):
        if expected.get(kind) != found.get(kind):
            state = "new" if kind not in expected else "gone" if kind not in found else "differs"
            yield f"{' '.join(kind)}: {state}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("program", metavar="PROGRAM")
    parser.add_argument("--write", action="store_true", help="write goldens.txt instead of comparing with it")
    parser.add_argument("--keep", type=pathlib.Path, metavar="FOLDER", help="render into this new folder and keep it")
    options = parser.parse_args()
    with contextlib.ExitStack() as stack:
        folder = pathlib.Path(options.keep or stack.enter_context(tempfile.TemporaryDirectory(prefix="goldens-"))).resolve()
        make_scenes(folder)
        runs = all_runs(Renderer(options.program, folder))
    whole = {name: lines for name, threads, lines in runs if threads == 1}
    faults = [f"{line} ({threads} threads, compared with 1)" for name, threads, lines in runs
              for line in differences(whole[name], lines)]
    lines = [line for name in sorted(whole) for line in whole[name]]
    if options.write and not faults:
        GOLDENS.write_text("\n".join(lines) + "\n")
    else:
        faults += differences(GOLDENS.read_text().splitlines() if GOLDENS.exists() else [], lines)
    print("\n".join([*faults, f"{len(lines)} kinds of files in {len(whole)} datasets; {len(faults)} differences"]))
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
