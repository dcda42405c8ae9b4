"""Images of heights as the bottom: the same echoes as of the same surface in glTF, objects that rest on it,
maps that the program wrote itself, and files that are faulty."""
import array
import json
import math
import pathlib
import re
import shutil
import struct
import subprocess
import unittest
import zlib

from composed import Composed, box_mesh, gltf
from sandbox import SONARSIM

COLUMNS, ROWS, PIXEL = 48, 40, 0.25
MISSION = """\
seed: 5
scene:
%s  materials: materials.csv
%strajectory:
  waypoints: [{position_m: [1, 4.5, 3]}, {position_m: [2, 5, 3], rpy_deg: [0, 0, 30]}]
  speed_m_s: 1
  rate_hz: 3
sensors:
  fls:
    kind: imaging
    range_max_m: 9
    range_bins: 48
    azimuth_bins: 32
    mount: {rpy_deg: [0, 25, 0]}
output:
  folder: %s
  labels: true
"""
OBJECTS = """\
  objects:
    - {name: crate, file: crate.gltf, position_m: [5, 5, 0], place: on_bottom, bury_m: 0.1}
  scatter:
    - {name: mine, files: [crate.gltf], count: 4, area_min_m: [3, 2], area_max_m: [9, 8], scale: 0.4}
"""
MAP = "  heightmap: {file: %s, material: Concrete%s}\n"


def value(row, column):
    """Whole numbers for PNG: a slope, a ridge along a diagonal, nothing that a turned or mirrored map
    has, too."""
    return round(3000 + 12 * column - 5 * row + 150 * math.sin(0.31 * column + 0.17 * row))


def png(values, depth=16):
    """Rows of whole numbers as a grey PNG."""
    code = ">%dH" if depth == 16 else "%dB"
    rows = b"".join(b"\0" + struct.pack(code % len(row), *row) for row in values)

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    head = struct.pack(">IIBBBBB", len(values[0]), len(values), depth, 0, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(rows)) +
            chunk(b"IEND", b""))


def surface():
    """The same ground as a mesh, in glTF's axes (y up): x east, z south."""
    points = [(PIXEL * (c + 0.5), 0.001 * value(r, c) - 3, -PIXEL * (ROWS - r - 0.5))
              for r in range(ROWS) for c in range(COLUMNS)]
    indices = []
    for r in range(ROWS - 1):
        for c in range(COLUMNS - 1):
            a = r * COLUMNS + c
            indices += [a, a + COLUMNS, a + COLUMNS + 1, a, a + COLUMNS + 1, a + 1]
    return points, indices, 0


def numbers_of(path):
    """The floats of an .npy."""
    data = path.read_bytes()
    numbers = array.array("f")
    numbers.frombytes(data[10 + struct.unpack("<H", data[8:10])[0]:])
    return numbers


def heights_of(path, count):
    """The cells of a map that the program wrote, which end the file."""
    heights = array.array("f")
    heights.frombytes(path.read_bytes()[-4 * count:])
    return heights


class Heightmap(Composed):
    def setUp(self):
        super().setUp()
        (self.folder / "bed.png").write_bytes(
            png([[value(r, c) for c in range(COLUMNS)] for r in range(ROWS)]))
        self.write("bed.gltf", gltf([{"name": "heightmap", "mesh": 0}], [surface()]))

    def mission(self, scene, objects="", out="out", low=False):
        """With `low` the sonar is 1.5 m above the ground and reaches 4 m."""
        text = MISSION % (scene, objects, out)
        if low:
            text = text.replace("max_m: 9", "max_m: 4").replace("5, 3]", "5, 1.5]")
        self.write("mission.yaml", text)

    def map_mission(self, options="", objects="", file="bed.png"):
        self.mission(MAP % (file, options), objects)

    def polar(self, out):
        return [numbers_of(path) for path in sorted((self.folder / out / "fls/polar").glob("*.npy"))]

    def assert_same(self, scene, **options):
        """The images of `scene` equal those of the mesh to 1e-4, their differences by their sums."""
        self.mission("  file: bed.gltf\n", out="mesh", **options)
        self.assert_renders()
        self.mission(scene, out="map", **options)
        self.assert_renders()
        pairs = list(zip(self.polar("mesh"), self.polar("map"), strict=True))
        self.assertGreater(len(pairs), 2)
        for mesh, image in pairs:
            self.assertGreater(sum(mesh), 0)
            self.assertLess(sum(abs(a - b) for a, b in zip(mesh, image, strict=True)), 1e-4 * sum(mesh))
        return self.dataset(self.folder / "mesh"), self.dataset(self.folder / "map")

    OWN = MAP % ("bed.png", ", pixel_m: 0.25, height_scale: 0.001, height_offset_m: -3")

    def test_same_as_a_mesh(self):
        self.assert_same(self.OWN)

    def test_objects_rest_on_it(self):
        """With a buried crate and scattered mines, which lie where they do on the mesh."""
        mesh, image = (dataset["labels"]["instances"][1:]
                       for dataset in self.assert_same(self.OWN, objects=OBJECTS))
        self.assertEqual([one["name"] for one in image], ["crate", *(f"mine_{k}" for k in range(1, 5))])
        for on_mesh, on_map in zip(mesh, image, strict=True):
            for side in ("min", "max"):
                for a, b in zip(on_mesh["box_world_m"][side], on_map["box_world_m"][side], strict=True):
                    self.assertAlmostEqual(a, b, delta=1e-5)

    def test_only_what_is_in_range(self):
        """With the rays the images are those of the whole map, though most of it is left out."""
        rays = "  objects: []\nengine: rays\n"
        mesh, image = self.assert_same(self.OWN, objects=rays, low=True)
        self.assertEqual(mesh["scene"]["triangles"], 2 * (COLUMNS - 1) * (ROWS - 1))
        self.assertLess(image["scene"]["triangles"], 0.6 * mesh["scene"]["triangles"])
        for one, other in zip(self.polar("mesh"), self.polar("map"), strict=True):
            self.assertLess(max(abs(a - b) for a, b in zip(one, other, strict=True)), 1e-6)

    def test_long_cells_are_told(self):
        """Cells of 0.25 m have facets in bins of 2.5 cm, and none to see in bins of 6 cm."""
        self.map_mission(", pixel_m: 0.25, height_scale: 0.001, height_offset_m: -3")
        for bins, told in ((356, True), (142, False)):
            result = self.run_sonarsim("validate", "mission.yaml", "--set", f"sensors.fls.range_bins={bins}")
            self.assertEqual("W37 scene.heightmap: its cells of 0.25 m are 10 times" in result.stderr, told,
                             result.stderr)

    def test_extent_and_origin(self):
        """size_m instead of pixel_m, and another origin with a trajectory moved by as much."""
        self.assert_same(MAP % ("bed.png", ", size_m: [12, 10], origin_m: [0, 0], height_scale: 0.001, "
                                           "height_offset_m: -3"))
        self.map_mission(", pixel_m: 0.25, origin_m: [3, 4]")
        reported = json.loads(self.run_sonarsim("inspect", "bed.png", "--pixel-m", "0.25", "--json").stdout)
        self.assertEqual(reported["bounds_min_m"][:2], [0.125, 0.125])
        self.assertEqual(reported["instances"], [{"name": "heightmap", "triangles": 2 * 47 * 39}])

    def test_with_a_scene_file(self):
        """Both are there, and the heightmap is the bottom."""
        self.mission("  file: crate.gltf\n" + self.OWN, OBJECTS)
        self.assert_renders()
        names = [one["name"] for one in self.dataset()["labels"]["instances"]]
        self.assertEqual(names[:3], ["crate_2", "heightmap", "crate"])
        crate = self.dataset()["labels"]["instances"][2]["box_world_m"]
        self.assertAlmostEqual(crate["max"][2] - crate["min"][2], 1, delta=1e-5)
        # It touches the map 10 cm below its highest point there, which lies between 0 and 1 m.
        self.assertTrue(-0.2 < crate["min"][2] < 1)

    def test_its_name_is_its_own(self):
        """Labels and maps find the ground by its name: a node of the scene's file gets another."""
        self.write("crate.gltf", gltf([{"name": "heightmap", "mesh": 0}], [box_mesh()]))
        self.mission("  file: crate.gltf\n" + self.OWN)
        self.edit("mission.yaml", "labels: true", "labels: [objects]")
        self.assert_renders()
        labels = self.dataset()["labels"]
        self.assertEqual([one["name"] for one in labels["instances"]], ["heightmap_2", "heightmap"])
        self.assertEqual(labels["annotations"]["background"], ["heightmap"])
        self.mission(self.OWN, OBJECTS.replace("name: crate", "name: heightmap"), out="other")
        self.assert_refused(self.run_sonarsim("validate", "mission.yaml"),
                            "an object has the name of the ground")

    def test_own_bathymetry(self):
        """What a profiler writes of the ground is the same ground for the next mission."""
        self.mission(self.OWN)
        profiler = ("  mbes: {kind: profiling, azimuth_deg: 90, range_max_m: 8, range_bins: 800, "
                    "azimuth_bins: 90}\noutput:\n")
        self.edit("mission.yaml", "  labels: true\n", "")
        self.edit("mission.yaml", "  rate_hz: 3", "  rate_hz: 20")
        self.edit("mission.yaml", "[2, 5, 3], rpy_deg: [0, 0, 30]", "[9, 4.5, 3]")
        self.edit("mission.yaml", "output:\n", profiler)
        self.assert_renders()
        first = json.loads((self.out / "mbes/bathymetry.json").read_text())
        cells = first["rows"] * first["columns"]
        truth = heights_of(self.out / "mbes/bathymetry.tif", cells)
        shutil.copy(self.out / "mbes/bathymetry.tif", self.folder / "own.tif")
        self.edit("mission.yaml", self.OWN, MAP % ("own.tif", ""))
        self.assert_renders("--set", "output.folder=again")
        second = json.loads((self.folder / "again/mbes/bathymetry.json").read_text())
        again = heights_of(self.folder / "again/mbes/bathymetry.tif", second["rows"] * second["columns"])
        # Cells begin at multiples of their size, so those of both maps fit together.
        self.assertEqual(first["cell_m"], second["cell_m"])
        right = round((second["west_m"] - first["west_m"]) / first["cell_m"])
        down = round((first["north_m"] - second["north_m"]) / first["cell_m"])
        off = []
        for r in range(second["rows"]):
            for c in range(second["columns"]):
                row, column = r + down, c + right
                if 0 <= row < first["rows"] and 0 <= column < first["columns"]:
                    off.append(abs(again[r * second["columns"] + c] - truth[row * first["columns"] + column]))
        off = sorted(x for x in off if not math.isnan(x))
        self.assertGreater(len(off), 200)
        # A range bin has 1 cm; the ground rises by up to 5 cm within a cell.
        self.assertLess(off[len(off) // 2], 0.02)

    def test_depths(self):
        """Depths that are read as heights put the vehicle below the bottom: a warning says so."""
        self.mission(MAP % ("bed.png", ", pixel_m: 0.25, height_scale: 0.002"))
        self.edit("mission.yaml", "[1, 4.5, 3]", "[5, 4.5, -2]")
        self.edit("mission.yaml", "[2, 5, 3]", "[6, 5, -2]")
        result = self.run_sonarsim("validate", "mission.yaml")
        self.assertIn("W12 sensor 'fls': 4 of 4 pings are blind", result.stderr)
        self.edit("mission.yaml", "height_scale: 0.002", "height_scale: -0.002")
        self.assertNotIn("4 of 4 pings are blind", self.run_sonarsim("validate", "mission.yaml").stderr)

    def test_refused(self):
        for options, fragments in (
                ("", ("bed.png", "no world file lies next to it", "scene.heightmap.pixel_m", "mission.yaml:3:")),
                (", pixel_m: 0", ("pixel_m", "above 0")),
                (", pixel_m: 1, size_m: [1, 1]", ("give pixel_m or size_m, not both",)),
                (", pixel_m: 1, height_scale: 0", ("height_scale of 0 makes all flat",)),
                (", pixel_m: 1, colour: red", ("colour",))):
            with self.subTest(options=options):
                self.map_mission(options)
                self.refused(*fragments)
        self.map_mission(", pixel_m: 1", file="none.png")
        self.refused("none.png: no such file")
        self.map_mission(", pixel_m: 1", file="box.gltf")
        self.refused("box.gltf: is JSON, such as a .gltf mesh; PNG, TIFF and OpenEXR are read")
        self.mission("  heightmap: {file: bed.png, pixel_m: 1}\n")
        self.refused("the heightmap has no material; write scene.heightmap.material: NAME")

    def test_hostile(self):
        whole = (self.folder / "bed.png").read_bytes()
        rgb = whole.replace(whole[16:33], struct.pack(">IIBBBBB", 16, 40, 16, 2, 0, 0, 0) + struct.pack(
            ">I", zlib.crc32(b"IHDR" + struct.pack(">IIBBBBB", 16, 40, 16, 2, 0, 0, 0))))
        head = struct.pack(">IIBBBBB", 2 ** 31 - 1, 2 ** 31 - 1, 16, 0, 0, 0, 0)
        bomb = whole.replace(whole[16:33], head + struct.pack(">I", zlib.crc32(b"IHDR" + head)))
        head = struct.pack(">IIBBBBB", 30000, 30000, 8, 0, 0, 0, 0)
        wide = whole.replace(whole[16:33], head + struct.pack(">I", zlib.crc32(b"IHDR" + head)))
        for content, fragments in (
                (whole[:200], ("cannot be read",)),
                (whole[:40], ("cannot be read",)),
                (whole[:9], ("cannot be read",)),
                (whole[:100] + bytes(50) + whole[150:], ("cannot be read",)),
                (rgb, ("has 3 channels, and a heightmap has one", "gdal_translate -b 1")),
                (bomb, ()),
                (wide, ("has 30000 x 30000 pixels of 1 value, and at most 2^26", "gdal_translate"))):
            with self.subTest(size=len(content), fragments=fragments):
                (self.folder / "bad.png").write_bytes(content)
                self.map_mission(", pixel_m: 1", file="bad.png")
                for command in ("validate", "render"):
                    result = self.run_sonarsim(command, "mission.yaml")
                    self.assertEqual(result.returncode, 2, result.stderr)
                    for fragment in ("bad.png: ", "mission.yaml:3:", *fragments):
                        self.assertIn(fragment, result.stderr)
                    self.assertFalse(self.out.exists())

    def test_without_the_module(self):
        """A start does not need OpenImageIO. A mission that does says what to install."""
        libraries = subprocess.run(["ldd", SONARSIM], capture_output=True, text=True, check=True).stdout
        self.assertNotIn("OpenImageIO", libraries)
        if pathlib.Path("/usr/local/lib/sonarsim").exists():
            self.skipTest("an installed module takes the place of a missing one")
        own = self.folder / "deep/er/bin/sonarsim"
        own.parent.mkdir(parents=True)
        shutil.copy(SONARSIM, own)
        result = subprocess.run([own, "inspect", "bed.png", "--pixel-m", "1"], cwd=self.folder,
                                capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertTrue(re.search(r"bed.png: cannot be read: .*install libopenimageio-dev", result.stderr),
                        result.stderr)

    def test_soundings_lie_on_it(self):
        """Soundings of a profiling sonar lie on the map's surface, within their bins."""
        self.mission(self.OWN)
        for old, new in (("kind: imaging", "kind: profiling\n    azimuth_deg: 60\n    noise: {add_sigma: 0, mult_sigma: 0}"),
                         ("range_bins: 48", "range_bins: 900"), ("azimuth_bins: 32", "azimuth_bins: 120"),
                         ("    mount: {rpy_deg: [0, 25, 0]}\n", ""), ("  labels: true\n", ""),
                         ("[1, 4.5, 3]", "[2, 5, 3]"), ("[2, 5, 3], rpy_deg: [0, 0, 30]", "[10, 5, 3]")):
            self.edit("mission.yaml", old, new)
        self.assert_renders()
        table = (self.folder / "out/fls/soundings.csv").read_text().splitlines()
        names = table[0].split(",")
        rows = [dict(zip(names, map(float, line.split(",")), strict=True)) for line in table[1:]]
        self.assertGreater(len(rows), 500)
        off = []
        for row in rows:
            x, y = row["x_m"] / PIXEL - 0.5, ROWS - row["y_m"] / PIXEL - 0.5
            column, line = math.floor(x), math.floor(y)
            if not (0 <= column < COLUMNS - 1 and 0 <= line < ROWS - 1):
                continue
            a, b = x - column, y - line
            north, south = ((1 - a) * value(line + k, column) + a * value(line + k, column + 1) for k in (0, 1))
            off.append(row["z_m"] - (0.001 * ((1 - b) * north + b * south) - 3))
        self.assertGreater(len(off), 500)
        # Bins of 1 cm, and footprints of 5 to 12 cm on slopes of up to 0.25.
        self.assertLess(abs(sum(off) / len(off)), 0.01)
        self.assertLess(math.sqrt(sum(d * d for d in off) / len(off)), 0.02)

    @unittest.skipIf(shutil.which("gdal_translate") is None, "needs gdal-bin")
    def test_geotiff(self):
        """A user's GeoTIFF at UTM coordinates, with nothing but origin_m."""
        subprocess.run(["gdal_translate", "-q", "-ot", "Float32", "-a_srs", "EPSG:32632", "-a_ullr",
                        "500000", "5600010", "500012", "5600000", "-scale", "0", "65535", "-3", "62.535",
                        "-co", "COMPRESS=DEFLATE", "bed.png", "utm.tif"], cwd=self.folder, check=True)
        self.assert_same(MAP % ("utm.tif", ", origin_m: [500000, 5600000]"))


if __name__ == "__main__":
    unittest.main()
