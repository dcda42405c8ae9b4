#!/usr/bin/python3
"""Measures what docs/scenes.md says of maps and heightmaps: tables in Markdown.

    ./scripts/map_figures.py errors [--sonarsim PROGRAM]
    ./scripts/map_figures.py heightmap [--cells 2048] [--sonarsim PROGRAM]
    ./scripts/map_figures.py starts [--sonarsim PROGRAM]

errors     lays backscatter maps over sand waves and compares images at the default goal with those at a goal
           of 0.5 %, and with the estimates of the program; a few minutes
heightmap  renders the same surface as a GeoTIFF and as a .glb: difference of the images, time and memory
starts     counts the shared objects that a command loads, by the list of the dynamic linker, and its time
"""
import argparse
import array
import json
import math
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import time

from scenes.bathymetry import write_geotiff
from scenes.noise import lattice

ROOT = pathlib.Path(__file__).resolve().parent.parent
MATERIALS = ROOT / "scenes/materials.csv"
PIXELS, PIXEL_M = 300, 0.1  # of the maps of errors
MISSION = """\
seed: 1
scene:
  materials: %(materials)s
  heightmap: {file: heights.tif, size_m: [30, 30], material: sand, keep: all}
  backscatter_map: {file: %(map)s.tif, size_m: [30, 30]}
trajectory:
  waypoints: [{position_m: [5.03, 14.9, -6.5]}, {position_m: [15.03, 14.7, -6.5]}]
  speed_m_s: 5
  rate_hz: 1
sensors:
  imaging: {kind: imaging, range_min_m: 2, range_max_m: 12, range_bins: 192, azimuth_bins: 64,
            mount: {rpy_deg: [0, 25, 0]}}
  side: {kind: sidescan, range_min_m: 2, range_max_m: 14, range_bins: 300}
output: {folder: out, labels: [clean]}
"""


def run(program, *arguments, folder):
    done = subprocess.run([program, *map(str, arguments)], cwd=folder, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, arguments))}: {done.stderr}")


def numbers(path):
    """The numbers of an .npy of floats, and the length of its rows."""
    data = path.read_bytes()
    size = struct.unpack("<H", data[8:10])[0]
    shape = data[10:10 + size].decode().split("(")[1].split(")")[0].split(",")
    values = array.array("f")
    values.frombytes(data[10 + size:])
    return values, int(shape[1])


def images(out, sensor, pings=3):
    """Noise-free images, one list for each ping."""
    if sensor == "side":
        values, row = numbers(out / "side/clean.npy")
        return [values[k * row:(k + 1) * row] for k in range(pings)]
    return [numbers(out / sensor / f"clean/{k:06d}.npy")[0] for k in range(pings)]


def estimates(out, sensor, pings=3):
    return [json.loads((out / sensor / f"meta/{k:06d}.json").read_text())["estimated_error"] for k in range(pings)]


def apart(image, truth):
    return sum(abs(a - b) for a, b in zip(image, truth, strict=True)) / sum(truth)


def surface(x, y):
    """Sand waves and ripples across them."""
    return (-10 + 0.15 * math.sin(2 * math.pi * (0.8 * x + 0.6 * y) / 1.7)
            + 0.05 * math.sin(2 * math.pi * (0.3 * x - 0.9 * y) / 0.9 + 1))


def smooth_waves():
    """40 waves of 1.3 m and more, whose sum deviates by 4.5 dB."""
    return [(5 * lattice(k, 0, 0, 5), 5 * lattice(k, 1, 0, 5), math.pi * lattice(k, 2, 0, 5)) for k in range(40)]


def maps():
    """Functions by name: the decibels at x, y, in the pixel at column, row."""
    waves = smooth_waves()
    return {
        "none": lambda x, y, column, row: 0.0,
        "chequered, fields of 1.4 m, 6 dB":
            lambda x, y, column, row: 3.0 if (math.floor(x / 1.4) + math.floor(y / 1.4)) % 2 else -3.0,
        "smooth texture of 4.5 dB":
            lambda x, y, column, row: sum(math.cos(a * x + b * y + c) for a, b, c in waves),
        "every pixel drawn from -6 to 6 dB": lambda x, y, column, row: 6 * lattice(column, row, 0, 9)}


def write_map(path, value):
    write_geotiff(path, [[value((column + 0.5) * PIXEL_M, (PIXELS - row - 0.5) * PIXEL_M, column, row)
                          for column in range(PIXELS)] for row in range(PIXELS)], PIXEL_M)


def errors(options, folder):
    write_map(folder / "heights.tif", lambda x, y, column, row: surface(x, y))
    print("| map | imaging: error | estimate | side-scan: error | estimate |\n|---|---|---|---|---|")
    for number, (name, value) in enumerate(maps().items()):
        write_map(folder / f"map{number}.tif", value)
        (folder / "mission.yaml").write_text(MISSION % {"materials": MATERIALS, "map": f"map{number}"})
        for out, goal in (("usual", 0.03), ("fine", 0.005)):
            run(options.sonarsim, "render", "mission.yaml", "--set", f"engine={options.engine}", "--set",
                f"accuracy.relative_l1={goal}", "--out", f"{out}{number}", folder=folder)
        cells = []
        for sensor in ("imaging", "side"):
            usual, fine = (images(folder / f"{out}{number}", sensor) for out in ("usual", "fine"))
            off = [apart(image, truth) for image, truth in zip(usual, fine, strict=True)]
            stated = estimates(folder / f"usual{number}", sensor)
            cells += [f"{100 * sum(x) / len(x):.1f} %" for x in (off, stated)]
        print(f"| {name} | {' | '.join(cells)} |", flush=True)


def write_glb(path, heights, cell_m):
    """Rows of heights from the north as one mesh in glTF's axes, with the triangles of a heightmap."""
    rows, columns = len(heights), len(heights[0])
    points = array.array("f")
    for row, line in enumerate(heights):
        south_m = -(rows - row - 0.5) * cell_m
        for column, z in enumerate(line):
            points.extend(((column + 0.5) * cell_m, z, south_m))
    # The two triangles of four heights share the edge from the north-west to the south-east.
    pattern = [k + offset for k in range(columns - 1)
               for offset in (0, columns, columns + 1, 0, columns + 1, 1)]
    indices = array.array("I")
    for row in range(rows - 1):
        indices.extend([k + row * columns for k in pattern])
    parts = points.tobytes(), indices.tobytes()
    document = json.dumps({
        "asset": {"version": "2.0"}, "nodes": [{"name": "bottom", "mesh": 0}], "materials": [{"name": "sand"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": rows * columns, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5125, "count": len(indices), "type": "SCALAR"}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(parts[0])},
                        {"buffer": 0, "byteOffset": len(parts[0]), "byteLength": len(parts[1])}],
        "buffers": [{"byteLength": len(parts[0]) + len(parts[1])}]}).encode()
    document += b" " * (-len(document) % 4)
    with path.open("wb") as file:
        whole = 28 + len(document) + len(parts[0]) + len(parts[1])
        file.write(struct.pack("<4s4I", b"glTF", 2, whole, len(document), 0x4E4F534A) + document)
        file.write(struct.pack("<2I", len(parts[0]) + len(parts[1]), 0x004E4942) + parts[0] + parts[1])


PAIR = """\
seed: 1
scene:
  materials: %s
  %s
trajectory: {waypoints: [{position_m: [%g, %g, 5]}, {position_m: [%g, %g, 5]}], speed_m_s: 1, rate_hz: %g}
sensors:
  imaging: {kind: imaging, range_min_m: 1, range_max_m: 40, range_bins: 512, azimuth_bins: 256, azimuth_deg: 90,
            mount: {rpy_deg: [0, 15, 0]}}
output: {folder: out, labels: [clean]}
"""


def measured(program, folder, *options):
    """(processor seconds, seconds by the clock, MiB) of a render."""
    begin = time.monotonic()
    pid = os.posix_spawn(program, [program, "render", *options, "-j1", "-q"], os.environ,
                         file_actions=[(os.POSIX_SPAWN_OPEN, 1, os.devnull, os.O_WRONLY, 0),
                                       (os.POSIX_SPAWN_OPEN, 2, os.devnull, os.O_WRONLY, 0)])
    _, status, usage = os.wait4(pid, 0)
    if status != 0:
        sys.exit(f"{folder}: the render failed")
    return usage.ru_utime + usage.ru_stime, time.monotonic() - begin, usage.ru_maxrss / 1024


def heightmap(options, folder):
    cell_m = 40.96 / options.cells
    across = [math.sin(0.9 * k * cell_m) * 0.3 + 0.02 * cell_m * lattice(k, 0, 0, 3) for k in range(options.cells)]
    along = [math.cos(1.3 * k * cell_m) * 0.2 + 0.02 * cell_m * lattice(k, 1, 0, 3) for k in range(options.cells)]
    # Heights as both files have them: floats.
    heights = [array.array("f", [a + b for a in across]).tolist() for b in along]
    write_geotiff(folder / "heights.tif", heights, cell_m)
    write_glb(folder / "heights.glb", heights, cell_m)
    middle = 0.5 * options.cells * cell_m
    size_m = f"[{options.cells * cell_m:g}, {options.cells * cell_m:g}]"
    scenes = {"heightmap": f"heightmap: {{file: heights.tif, size_m: {size_m}, material: sand, keep: all}}",
              "glb": "file: heights.glb"}
    print("| | s of processor time, start and two pings | ms per further ping | MiB |\n|---|---|---|---|")
    for name, scene in scenes.items():
        found = []
        for pings in (2, 6):
            mission = folder / f"{name}_{pings}.yaml"
            mission.write_text(PAIR % (MATERIALS, scene, 1, middle, 2, middle, pings - 1))
            found.append(measured(options.sonarsim, folder, str(mission), "--out", str(folder / f"{name}_{pings}")))
        print(f"| {name} | {found[0][0]:.1f} | {1e3 * (found[1][0] - found[0][0]) / 4:.0f} | "
              f"{found[1][2]:.0f} |", flush=True)
    pair = [images(folder / f"{name}_2", "imaging", 2) for name in scenes]
    print(f"\nimages apart: {max(map(apart, *pair)):.2g} of the sum, limit 1e-4")


def starts(options, folder):
    maps_mission = ROOT / "configs/sediment_maps.yaml"
    subprocess.run([sys.executable, ROOT / "scripts/make_scenes.py", "--for", maps_mission], check=True,
                   capture_output=True)
    print("| command | shared objects | ms, least of five |\n|---|---|---|")
    for arguments in (["--help"], ["validate", ROOT / "configs/tank_imaging.yaml"], ["validate", maps_mission]):
        command = [options.sonarsim, *map(str, arguments)]
        traced = folder / "objects"
        subprocess.run(command, env=os.environ | {"LD_DEBUG": "files", "LD_DEBUG_OUTPUT": str(traced)},
                       capture_output=True, check=True)
        counts = []  # of each process
        for path in sorted(folder.glob("objects.*")):
            counts.append(path.read_text(errors="replace").count("calling init:"))
            path.unlink()
        least = math.inf
        for _ in range(5):
            begin = time.monotonic()
            subprocess.run(command, capture_output=True, check=True)
            least = min(least, time.monotonic() - begin)
        names = " ".join(pathlib.Path(str(a)).name for a in arguments)
        print(f"| {names} | {' and '.join(map(str, counts))} | {1e3 * least:.0f} |", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("errors", "heightmap", "starts"))
    parser.add_argument("--sonarsim", default=str(ROOT / "build/sonarsim"))
    parser.add_argument("--engine", default="auto", help="of errors")
    parser.add_argument("--cells", type=int, default=2048, help="of heightmap, a side")
    options = parser.parse_args()
    options.sonarsim = str(pathlib.Path(options.sonarsim).resolve())
    with tempfile.TemporaryDirectory() as folder:
        {"errors": errors, "heightmap": heightmap, "starts": starts}[options.what](options, pathlib.Path(folder))


if __name__ == "__main__":
    main()
