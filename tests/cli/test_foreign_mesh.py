"""Renders meshes that nobody here made, from Debian's openfoam-examples, converted by assimp: the hull of
the Duisburg Test Case, a container ship at model scale, and the motorbike of configs/, which
scripts/render.sh makes in a clone without it. Skipped (exit code 77) where the packages are neither
installed nor to be had."""
import ast
import gzip
import json
import math
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile

import clean_clone

SONARSIM = os.environ["SONARSIM"]
HULL = pathlib.Path(
    "/usr/share/doc/openfoam-examples/examples/resources/geometry/DTC-scaled.stl.gz")
SKIPPED = 77

# assimp hands the hull on as it stands in the STL, z up, and glTF is y up: in the world the ship
# lies on her side, with x from -0.11 m (stern) to 6.16 m (bow), y from -0.57 m (deck) to 0 (keel)
# and z from -0.43 m to 0.43 m. The sonar passes 4 m from the keel and looks at it square on.
MISSION = """\
name: hull
scene: {file: hull.glb, materials: materials.csv}
trajectory:
  waypoints:
    - {position_m: [2, 4, 0], rpy_deg: [0, 0, -90]}
    - {position_m: [4, 4, 0], rpy_deg: [0, 0, -90]}
  speed_m_s: 1
  rate_hz: 2
sensors:
  fls: {kind: imaging, azimuth_deg: 90, elevation_deg: 20, range_min_m: 0.5, range_max_m: 8,
        range_bins: 375, azimuth_bins: 180}
output: {folder: out}
"""
RANGE_MIN, BIN, BEAMS = 0.5, 0.02, 180


def fetch():
    """Installs what is missing; says why it cannot, or nothing."""
    if HULL.exists() and shutil.which("assimp"):
        return None
    as_root = [] if os.getuid() == 0 else ["sudo", "-n"]
    environment = {**os.environ, "DEBIAN_FRONTEND": "noninteractive"}
    install = [*as_root, "apt-get", "install", "-y", "-qq", "--no-install-recommends",
               "openfoam-examples", "assimp-utils"]
    for command in ([*as_root, "apt-get", "update", "-qq"], install):
        try:
            done = subprocess.run(command, env=environment, capture_output=True, text=True,
                                  stdin=subprocess.DEVNULL, timeout=240, check=False)
        except (OSError, subprocess.TimeoutExpired) as error:
            return str(error)
        if done.returncode != 0:
            return (done.stderr.strip().splitlines() or [f"{command} failed"])[-1]
    return None if HULL.exists() else f"{HULL} is not in the package"


def read_npy(path):
    """Rows of a float32 array [range, beam]."""
    data = path.read_bytes()
    start = 10 + int.from_bytes(data[8:10], "little")
    rows, columns = ast.literal_eval(data[10:start].decode())["shape"]
    values = struct.unpack(f"<{rows * columns}f", data[start:])
    return [values[i * columns:(i + 1) * columns] for i in range(rows)]


def check_ping(image, x):
    """The hull as the sonar at (x, 4, 0) must see it."""
    assert all(math.isfinite(v) and 0.0 <= v <= 1.0 for row in image for v in row)
    first = next(i for i, row in enumerate(image) if any(row))
    nearest = RANGE_MIN + first * BIN
    # The flat bottom lies at y = 0, 4 m away; nothing stands before it.
    assert 3.9 < nearest <= 4.0, nearest
    lit = [j for j in range(BEAMS) if any(row[j] for row in image)]
    # Seen from there the bow (x = 6.16) lies at atan((6.16 - x) / 4) to port and the stern at
    # atan((x + 0.11) / 4) to starboard, each at the keel's depth or deeper (up to 4.57 m).
    for beam, reach in ((lit[-1] + 1, 6.16 - x), (BEAMS - lit[0], x + 0.11)):
        azimuth = (beam - BEAMS / 2) * 90 / BEAMS
        low = math.degrees(math.atan(reach / 4.57)) - 3
        high = math.degrees(math.atan(reach / 4.0)) + 1
        assert min(low, 42) < azimuth <= min(high, 45), (x, azimuth, low, high)
    assert len(lit) == lit[-1] - lit[0] + 1, "a hole in the hull"


def motorbike(clone):
    """configs/motorbike_imaging.yaml by its one command; a few pings."""
    if not clean_clone.clone_to(clone):
        print("this is no checkout of git: the motorbike is left out")
        return
    result = clean_clone.render(clone, "configs/motorbike_imaging.yaml", "--shard", "1/60", "--json")
    assert result.returncode == 0, result.stderr
    assert json.loads(result.stdout)["pings"] > 0, result.stdout
    print("the motorbike, from a clone")


def main(folder):
    problem = fetch()
    if problem:
        print(f"skipped: the hull cannot be fetched: {problem}")
        return SKIPPED
    (folder / "hull.stl").write_bytes(gzip.decompress(HULL.read_bytes()))
    subprocess.run(["assimp", "export", "hull.stl", "hull.glb"], cwd=folder, check=True,
                   stdout=subprocess.DEVNULL)
    (folder / "mission.yaml").write_text(MISSION)
    (folder / "materials.csv").write_text(
        "material,density_kg_m3,sound_speed_m_s\nDefaultMaterial,7850,5900\n")
    subprocess.run([SONARSIM, "render", "mission.yaml"], cwd=folder, check=True)
    dataset = json.loads((folder / "out/dataset.json").read_text())
    assert dataset["complete"] is True
    pings = sorted((folder / "out/fls/polar").iterdir())
    assert len(pings) == 5, pings  # 2 m at 1 m/s and 2 Hz, both ends included
    for i, path in enumerate(pings):
        check_ping(read_npy(path), 2 + 0.5 * i)
    # The STL itself gives the same bytes as the glTF that assimp makes of it.
    subprocess.run([SONARSIM, "render", "mission.yaml", "--set", "scene.file=hull.stl", "--set",
                    "scene.material_default=DefaultMaterial", "--out", "direct"], cwd=folder, check=True)
    for path in pings:
        assert path.read_bytes() == (folder / "direct/fls/polar" / path.name).read_bytes(), path
    print(f"{len(pings)} pings of the hull")
    motorbike(folder / "clone")
    return 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory(prefix="sonarsim-") as temporary:
        sys.exit(main(pathlib.Path(temporary)))
