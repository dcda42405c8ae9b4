"""Folders with small, sound missions, and the binary under test. Each test spoils one thing."""
import array
import base64
import contextlib
import hashlib
import importlib.util
import json
import math
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zlib

SONARSIM = os.environ.get("SONARSIM", "")
SANITIZED = os.environ.get("SANITIZED") == "1"
ROOT = pathlib.Path(__file__).resolve().parents[2]
# A dataset waits for its disk at every checkpoint, and hundreds are made here: where there is one, a
# file system in memory holds them.
IN_MEMORY = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None

MISSION = """\
name: box
seed: 7
scene:
  file: box.gltf
  materials: materials.csv
trajectory:
  file: path.csv
sensors:
  fls:
    kind: imaging
    azimuth_deg: 60
    elevation_deg: 12
    range_max_m: 6
    range_bins: 48
    azimuth_bins: 32
    noise:
      add_sigma: 0.05
      mult_sigma: 0.1
      range_lambda_m: 0.02
output:
  folder: out
  image: true
"""


def mission_of(sensors, output, more="", scene="file: box.gltf"):
    """A mission with the lines of its sensors, keys of its output and scene, and other lines."""
    return (f"name: box\nseed: 7\nscene: {{{scene}, materials: materials.csv}}\ntrajectory: {{file: path.csv}}\n"
            f"sensors:\n{sensors}output: {{folder: out, {output}}}\n{more}")


# Each kind of file that a dataset has.
ALL_FILES = mission_of("""\
  fls: {kind: imaging, azimuth_deg: 60, range_max_m: 6, range_bins: 16, azimuth_bins: 8,
        noise: {add_sigma: 0.05}}
  mbes: {kind: profiling, range_max_m: 6, range_bins: 16, azimuth_bins: 8}
  sss: {kind: sidescan, range_max_m: 6, range_bins: 16}
  sounder: {kind: echosounder, range_max_m: 6, range_bins: 16}
""", "image: true")

# Variants, with a number that is drawn for each of them and one for each ping.
VARIED = """\
variants: 3
vary:
  - {key: sensors.fls.noise.add_sigma, uniform: [0.01, 0.1]}
  - {key: vehicle.turn_deg.0, uniform: [-3, 3], per: ping}
"""

MATERIALS = "material,density_kg_m3,sound_speed_m_s\nConcrete,2400,3200\nsteel,7850,5890\n"
# A make that runs the tests hands its own flags down; they are not those of a make that is tested.
ENVIRONMENT = {name: value for name, value in os.environ.items() if not name.startswith(("MAKE", "MFLAGS"))}


def gltf(nodes, meshes, materials=("Concrete",)):
    """Nodes as glTF has them over meshes of (points, indices, material)."""
    data, views, accessors, out = b"", [], [], []
    for points, indices, material in meshes:
        for part, kind, code, count in ((b"".join(struct.pack("<3f", *p) for p in points), "VEC3", 5126, len(points)),
                (struct.pack(f"<{len(indices)}I", *indices), "SCALAR", 5125, len(indices))):
            views.append({"buffer": 0, "byteOffset": len(data), "byteLength": len(part)})
            accessors.append({"bufferView": len(views) - 1, "componentType": code, "count": count, "type": kind})
            data += part
        out.append({"primitives": [{"attributes": {"POSITION": len(accessors) - 2},
                                    "indices": len(accessors) - 1, "material": material}]})
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    return json.dumps({"asset": {"version": "2.0"}, "nodes": nodes, "meshes": out, "materials": [{"name": name} for name in materials],
        "accessors": accessors, "bufferViews": views, "buffers": [{"byteLength": len(data), "uri": uri}]})


def box_mesh(half=(0.5, 0.5, 0.5)):
    """A closed box around the origin, half-extents in glTF axes."""
    points = [tuple((1 if i >> k & 1 else -1) * half[k] for k in range(3)) for i in range(8)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    return points, [i for a, b, c, d in quads for i in (a, b, c, a, c, d)], 0


def grid_mesh(points, columns):
    """Two triangles between four points of a grid, row by row. Where rows run along z and columns along x they face up."""
    corners = [k for k in range(len(points) - columns) if k % columns < columns - 1]
    return points, [k for a in corners for k in (a, a + columns, a + columns + 1, a, a + columns + 1, a + 1)], 0


def sheet_mesh(half=10.0, cells=8, height=lambda x, z: 0.0):
    """A floor of cells x cells x 2 triangles in glTF's axes (y up)."""
    axis = [half * (2 * k / cells - 1) for k in range(cells + 1)]
    return grid_mesh([(x, height(x, z), z) for z in axis for x in axis], cells + 1)


def height_of(row, column):
    """Whole numbers for a map: a slope, a ridge along a diagonal, nothing that a turned or mirrored map has, too."""
    return round(3000 + 12 * column - 5 * row + 150 * math.sin(0.31 * column + 0.17 * row))


def triangles_of(mesh):
    points, indices, _ = mesh
    return points, [tuple(indices[k:k + 3]) for k in range(0, len(indices), 3)]


def obj(points, faces, head=""):
    """A text of OBJ; faces count points from 0."""
    return (head + "".join("v %g %g %g\n" % tuple(p) for p in points)
            + "".join("f %d %d %d\n" % tuple(k + 1 for k in face) for face in faces))


def box_gltf(half=(2.0, 1.5, 2.0), material="Concrete"):
    return gltf([{"name": "walls", "mesh": 0}], [box_mesh(half)], (material,))


def csv_of(*poses):
    """A file of poses; each is a text of t, x, y, z, roll, pitch, yaw."""
    return "\n".join(["t_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg", *poses]) + "\n"


def path_csv(poses, place="0,0,0,0,0"):
    """`poses` poses that turn slowly on the spot, five a second."""
    return csv_of(*(f"{0.2 * i:.1f},{place},{3 * i}" for i in range(poses)))


def with_keys(*settings):
    """The options that set keys of a mission."""
    return [word for setting in settings for word in ("--set", setting)]


def png(rows, bits=8, channels=1, size=None):
    """Rows of whole numbers as a PNG, grey or RGB with alpha; `size` is what its header says."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    width, height = size or (len(rows[0]) // channels, len(rows))
    code = ">%dH" if bits == 16 else "%dB"
    lines = b"".join(b"\0" + struct.pack(code % len(row), *row) for row in rows)
    head = struct.pack(">IIBBBBB", width, height, bits, {1: 0, 3: 2, 4: 6}[channels], 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b"")


def numbers_of(path):
    """The numbers of an .npy of float32 or uint16."""
    data = path.read_bytes()
    start = 10 + struct.unpack("<H", data[8:10])[0]
    numbers = array.array("f" if b"'<f4'" in data[:start] else "H")
    numbers.frombytes(data[start:])
    return numbers


def relative_difference(found, expected):
    """sum |a - b| / sum b."""
    return sum(abs(a - b) for a, b in zip(found, expected, strict=True)) / sum(expected)


def with_disk(sandbox, mode, call=0):
    """The environment of a program whose disk fails below `out`; see faulty_disk.cpp. Its calls are in the file `calls`."""
    (sandbox.folder / "calls").unlink(missing_ok=True)
    return dict(os.environ, LD_PRELOAD=os.environ["FAULTY_DISK"], FAULTY_DISK_BELOW=str(sandbox.out),
                FAULTY_DISK_LOG=str(sandbox.folder / "calls"), FAULTY_DISK_MODE=mode, FAULTY_DISK_CALL=str(call))


def digest(folder, without=()):
    """SHA-256 of every file below `folder`, by relative name."""
    return {str(p.relative_to(folder)): hashlib.sha256(p.read_bytes()).hexdigest()
            for p in sorted(folder.rglob("*")) if p.is_file() and p.name not in without}


def python_with(module):
    """Debian's packages belong to Debian's Python, which need not be the one of the tests."""
    for python in (sys.executable, "/usr/bin/python3"):
        with contextlib.suppress(FileNotFoundError):
            if subprocess.run([python, "-c", f"import {module}"], capture_output=True, check=False).returncode == 0:
                return python
    return None


def run_with(*modules):
    """Starts these tests again in a Python that has the modules; exit code 77 where there is none."""
    if not all(map(importlib.util.find_spec, modules)):
        python = python_with(", ".join(modules))
        if python in (None, sys.executable):
            sys.exit(77)
        os.execv(python, [python, *sys.orig_argv[1:]])


class Sandbox(unittest.TestCase):
    FILES = {}      # other than those of every sandbox, by their names

    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="sonarsim-", dir=IN_MEMORY)))
        self.out = self.folder / "out"
        self.write_all({"mission.yaml": MISSION, "materials.csv": MATERIALS, "box.gltf": box_gltf(), "path.csv": path_csv(6),
                        **self.FILES})

    def write_all(self, files):
        for name, content in files.items():
            self.write(name, content)

    def write(self, name, content):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content if isinstance(content, bytes) else content.encode())
        return path

    def edit(self, name, old, new):
        text = (self.folder / name).read_text()
        self.assertIn(old, text)
        self.write(name, text.replace(old, new, 1))

    def add(self, text):
        """Appends to the mission."""
        self.write("mission.yaml", (self.folder / "mission.yaml").read_text() + text)

    def run_program(self, *command, code=0, **options):
        """The result of a program, which ends with this exit code; None: with any."""
        options = {"cwd": self.folder, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "timeout": 300, **options}
        result = subprocess.run([str(word) for word in command], text=True, check=False, **options)
        if code is not None:
            self.assertEqual(result.returncode, code, result.stderr)
        return result

    def run_sonarsim(self, *arguments, code=None, **options):
        return self.run_program(SONARSIM, *arguments, code=code, **options)

    def start(self, *arguments, **options):
        """A run that goes on meanwhile; what it prints is thrown away."""
        return subprocess.Popen([SONARSIM, *map(str, arguments)], cwd=self.folder, text=True, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE, **options)

    def wait_for(self, holds, process, seconds=120):
        """Until `holds` returns something true, which a process brings about."""
        end = time.monotonic() + seconds
        while not holds():
            self.assertIsNone(process.poll(), "ended before it came to the phase")
            self.assertLess(time.monotonic(), end, "never came to the phase")
            time.sleep(0.005)

    def succeeds(self, *arguments, **options):
        return self.run_program(SONARSIM, *arguments, **options)

    def reported(self, *arguments, **options):
        """What a command says in JSON."""
        return json.loads(self.succeeds(*arguments, "--json", **options).stdout)

    def render(self, *arguments, **options):
        return self.run_sonarsim("render", "mission.yaml", *arguments, **options)

    def assert_renders(self, *arguments, **options):
        return self.succeeds("render", "mission.yaml", *arguments, **options)

    def assert_has(self, text, *fragments):
        for fragment in fragments:
            self.assertIn(fragment, text)

    def assert_refused(self, result, *fragments):
        """Exit code 2, every fragment in the message, and nothing written."""
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        self.assert_has(result.stderr, *fragments)
        self.assertEqual(result.stderr.count("error:"), 1, result.stderr)

    def refused(self, *fragments, arguments=()):
        """validate and render refuse the mission, with the same message."""
        for command in ("validate", "render"):
            with self.subTest(command=command):
                self.assert_refused(self.run_sonarsim(command, "mission.yaml", *arguments), *fragments)
                self.assertFalse(self.out.exists(), "a refused mission leaves no folder")

    def render_whole(self, *arguments, name="mission.yaml", out="out", **options):
        """The sums of the dataset that a run makes where nothing disturbs it; the dataset is removed again."""
        self.succeeds("render", name, "--out", out, *arguments, **options)
        whole = digest(self.folder / out)
        shutil.rmtree(self.folder / out)
        return whole

    def assert_near(self, found, expected, delta=1e-9):
        for a, b in zip(found, expected, strict=True):
            self.assertAlmostEqual(a, b, delta=delta)

    def assert_verify_finds(self, *fragments, more=()):
        """`verify out` ends with exit code 1 and these words."""
        result = self.run_sonarsim("verify", "out", *more, code=1)
        self.assert_has(result.stderr, *fragments)
        return result

    def assert_shards_agree(self, *arguments, count=2):
        """Shards in folders of their own, merged in another order and completed, are the dataset in `out`."""
        parts = [f"part{k}" for k in range(1, count + 1)]
        for k, part in enumerate(parts, 1):
            self.assert_renders("--shard", f"{k}/{count}", "--out", part, *arguments)
        self.succeeds("merge", *reversed(parts), "merged")
        self.assert_renders("--out", "merged", *arguments)
        self.assertEqual(digest(self.folder / "merged"), digest(self.out))

    def json(self, name):
        return json.loads((self.folder / name).read_text())

    def dataset(self, folder="out"):
        return self.json(pathlib.Path(folder) / "dataset.json")

    def variants(self, folder="out"):
        return self.json(f"{folder}/variants.json")["variants"]

    def meta(self, ping, sensor="fls"):
        return self.json(f"out/{sensor}/meta/{ping:06}.json")

    def objects_of(self, ping, sensor="fls"):
        return self.json(f"out/{sensor}/objects/{ping:06}.json")["objects"]

    def boxes(self, folder="out"):
        """The boxes of all instances in the world, by name."""
        return {one["name"]: one["box_world_m"] for one in self.dataset(folder)["labels"]["instances"]}


class Rendered(Sandbox):
    """Its mission is rendered."""

    def setUp(self):
        super().setUp()
        self.assert_renders()


class Composed(Sandbox):
    """A floor, a crate, and a sonar that looks at them."""

    def setUp(self):
        super().setUp()
        self.write("floor.gltf", gltf([{"name": "floor", "mesh": 0}], [sheet_mesh()]))
        self.write("crate.gltf", gltf([{"name": "crate", "mesh": 0}], [box_mesh()]))
        self.write("path.csv", path_csv(6, "0,0,2,0,20"))
        self.edit("mission.yaml", "range_max_m: 6", "range_max_m: 9")
        self.scene()

    def scene(self, text="", head="  file: floor.gltf\n  materials: materials.csv\n"):
        mission = (self.folder / "mission.yaml").read_text()
        start, end = mission.index("scene:\n"), mission.index("\ntrajectory:") + 1
        self.write("mission.yaml", mission[:start] + "scene:\n" + head + text + mission[end:])

    def objects(self, *lines, **options):
        self.scene("  objects:\n" + "".join(f"    - {line}\n" for line in lines), **options)
