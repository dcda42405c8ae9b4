"""A folder with a small, sound mission, and the binary under test. Each test spoils one thing."""
import base64
import hashlib
import json
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

SONARSIM = os.environ["SONARSIM"]
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

MATERIALS = "material,density_kg_m3,sound_speed_m_s\nConcrete,2400,3200\n"


def box_gltf(half=(2.0, 1.5, 2.0), material="Concrete"):
    """A closed box around the origin, half-extents in glTF axes, as one JSON text."""
    corners = [tuple((1 if i >> k & 1 else -1) * half[k] for k in range(3)) for i in range(8)]
    quads = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    indices = [i for a, b, c, d in quads for i in (a, b, c, a, c, d)]
    points = b"".join(struct.pack("<3f", *corner) for corner in corners)
    data = points + struct.pack(f"<{len(indices)}H", *indices)
    return json.dumps({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"name": "walls", "mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"name": material}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," +
                     base64.b64encode(data).decode()}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(points)},
                        {"buffer": 0, "byteOffset": len(points),
                         "byteLength": len(data) - len(points)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3",
                       "min": [-h for h in half], "max": list(half)},
                      {"bufferView": 1, "componentType": 5123, "count": len(indices),
                       "type": "SCALAR"}],
    })


def copies_gltf(copies, cells, flat=1.0):
    """A sheet of cells x cells x 2 triangles, `copies` times one below the other: a large scene of
    a small file. With `flat` = 0 its triangles have no area and are dropped."""
    side = cells + 1
    points = b"".join(struct.pack("<3f", 0.1 * i, 0.0, 0.1 * flat * j)
                      for i in range(side) for j in range(side))
    corners = [i * side + j for i in range(cells) for j in range(cells)]
    indices = [k for a in corners for k in (a, a + 1, a + side + 1, a, a + side + 1, a + side)]
    data = points + struct.pack(f"<{len(indices)}I", *indices)
    return json.dumps({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": list(range(copies))}],
        "nodes": [{"mesh": 0, "translation": [0, -2 - 0.01 * k, 0]} for k in range(copies)],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "materials": [{"name": "Concrete"}],
        "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," +
                     base64.b64encode(data).decode()}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(points)},
                        {"buffer": 0, "byteOffset": len(points),
                         "byteLength": len(data) - len(points)}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": side * side,
                       "type": "VEC3", "min": [0, 0, 0], "max": [0.1 * cells, 0, 0.1 * cells]},
                      {"bufferView": 1, "componentType": 5125, "count": len(indices),
                       "type": "SCALAR"}],
    })


def path_csv(poses):
    """`poses` poses that turn slowly on the spot, five a second."""
    rows = [f"{0.2 * i:.1f},0,0,0,0,0,{3 * i}" for i in range(poses)]
    return "\n".join(["t_s,x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg", *rows]) + "\n"


def png_file(width, height, rows):
    """A PNG file of 8 bits, whole if `rows` are: a zero and the pixels of each."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 0, 0, 0, 0)) +
            chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


def digest(folder, without=()):
    """SHA-256 of every file below `folder`, by relative name."""
    return {str(p.relative_to(folder)): hashlib.sha256(p.read_bytes()).hexdigest()
            for p in sorted(folder.rglob("*")) if p.is_file() and p.name not in without}


def python_with(module):
    """Debian's packages belong to Debian's Python, which need not be the one of the tests."""
    for python in (sys.executable, "/usr/bin/python3"):
        try:
            if subprocess.run([python, "-c", f"import {module}"], capture_output=True,
                              check=False).returncode == 0:
                return python
        except FileNotFoundError:
            pass
    return None


class Sandbox(unittest.TestCase):
    def setUp(self):
        self._temporary = tempfile.TemporaryDirectory(prefix="sonarsim-", dir=IN_MEMORY)
        self.addCleanup(self._temporary.cleanup)
        self.folder = pathlib.Path(self._temporary.name)
        self.write("mission.yaml", MISSION)
        self.write("materials.csv", MATERIALS)
        self.write("box.gltf", box_gltf())
        self.write("path.csv", path_csv(6))
        self.out = self.folder / "out"

    def write(self, name, text):
        path = self.folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)
        return path

    def edit(self, name, old, new):
        text = (self.folder / name).read_text()
        self.assertIn(old, text)
        self.write(name, text.replace(old, new, 1))

    def run_sonarsim(self, *arguments, **options):
        return subprocess.run([SONARSIM, *map(str, arguments)], cwd=self.folder, text=True,
                              capture_output=True, timeout=120, check=False, **options)

    def render(self, *arguments, **options):
        return self.run_sonarsim("render", "mission.yaml", *arguments, **options)

    def assert_renders(self, *arguments, **options):
        result = self.render(*arguments, **options)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def assert_refused(self, result, *fragments):
        """Exit code 2, every fragment in the message, and nothing written."""
        self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
        for fragment in fragments:
            self.assertIn(fragment, result.stderr)
        self.assertEqual(result.stderr.count("error:"), 1, result.stderr)

    def dataset(self, folder=None):
        return json.loads(((folder or self.out) / "dataset.json").read_text())
