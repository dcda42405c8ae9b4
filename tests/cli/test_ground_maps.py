"""Maps of material and of strength on the ground: their place, what is refused, and missions that
differ by a map."""
import array
import base64
import json
import math
import struct
import unittest
import zlib

from composed import Composed, floor_mesh, gltf
from test_heightmap import png

MISSION = """\
seed: 5
scene:
  file: floor.gltf
  materials: materials.csv
  bottom: [floor]
%strajectory:
  waypoints: [{position_m: [-5, 0, 2]}, {position_m: [5, 0, 2]}]
  speed_m_s: 10
  rate_hz: 1
sensors:
  side:
    kind: sidescan
    range_min_m: 2.5
    range_max_m: 8
    range_bins: 55
output:
  folder: %s
  labels: [material, clean]
"""
# The floor has 20 x 20 m: values 1 and 2 in the north, 3 and 4 in the south.
QUARTERS = ('  sediment_map: {file: quarters.png, size_m: [20, 20], origin_m: [10, 10]%s,\n'
            '    materials: {1: north_west, 2: north_east, 3: south_west, 4: Concrete}}\n')
DECIBELS = '  backscatter_map: {file: db.png, size_m: [20, 20], origin_m: [10, 10]%s}\n'


def colour_png(rows):
    """Rows of (red, green, blue, alpha) as a PNG."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    lines = b"".join(b"\0" + bytes(value for pixel in row for value in pixel) for row in rows)
    head = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 6, 0, 0, 0)
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", zlib.compress(lines)) +
            chunk(b"IEND", b""))


def records_of(path):
    """The rows of an .npy of numbers."""
    data = path.read_bytes()
    size = struct.unpack("<H", data[8:10])[0]
    head = data[10:10 + size].decode()
    shape = [int(part) for part in head[head.index("(") + 1:head.index(")")].split(",") if part.strip()]
    numbers = array.array("f" if "f4" in head else "H")
    numbers.frombytes(data[10 + size:])
    return [numbers[k * shape[1]:(k + 1) * shape[1]] for k in range(shape[0])]


class GroundMaps(Composed):
    def setUp(self):
        super().setUp()
        self.write("materials.csv", "material,density_kg_m3,sound_speed_m_s\nConcrete,2400,3200\n"
                   "north_west,1500,1600\nnorth_east,1700,1700\nsouth_west,1900,1900\n")
        (self.folder / "quarters.png").write_bytes(png([[1, 2], [3, 4]], 8))
        (self.folder / "db.png").write_bytes(png([[10, 16], [13, 10]], 8))

    def mission(self, maps, out="out"):
        self.write("mission.yaml", MISSION % (maps, out))

    def rows(self, what, out="out"):
        """The values of the first and the last ping, at port and at starboard, in the middle of each."""
        side = self.folder / out / "side"
        path = next(path for path in side.glob("*.npy") if path.stem == what)
        rows = records_of(path)
        return [values for row in (rows[0], rows[-1])
                for values in (row[len(row) // 4], row[3 * len(row) // 4])]

    def material_names(self):
        names = self.dataset()["labels"]["materials"]
        names = {entry["id"]: entry["name"] for entry in names}
        return [names[value] for value in self.rows("material")]

    def test_place(self):
        """A sonar that heads east in the west and then in the east: port is the north. The map is not
        mirrored, and its first row is the north."""
        self.mission(QUARTERS % "" + DECIBELS % ", offset_db: -10")
        self.assert_renders()
        self.assertEqual(self.material_names(), ["north_west", "south_west", "north_east", "Concrete"])
        with_maps = self.rows("clean")
        self.mission(QUARTERS % "", "plain")
        self.assert_renders()
        plain = self.rows("clean", "plain")
        for found, before, db in zip(with_maps, plain, (0, 3, 6, 0), strict=True):
            self.assertAlmostEqual(10 * math.log10(found / before), db, delta=0.01)

    def test_world_file_and_other_origin(self):
        """The same place by a world file, whose coordinates are those of a pixel's centre."""
        (self.folder / "quarters.wld").write_text("10\n0\n0\n-10\n4995\n8005\n")
        self.mission((QUARTERS % "").replace("size_m: [20, 20], origin_m: [10, 10]", "origin_m: [5000, 8000]"))
        self.assert_renders()
        self.assertEqual(self.material_names(), ["north_west", "south_west", "north_east", "Concrete"])

    def test_colours(self):
        """A transparent pixel leaves the material of the mesh."""
        sand, mud = (200, 180, 120, 255), (1, 2, 255, 255)
        (self.folder / "quarters.png").write_bytes(colour_png([[sand, mud], [mud, (9, 9, 9, 0)]]))
        colours = (QUARTERS % "").replace("1: north_west, 2: north_east, 3: south_west, 4: Concrete",
                                          '"#C8b478": north_west, "#0102ff": south_west')
        self.mission(colours)
        self.assert_renders()
        self.assertEqual(self.material_names(), ["north_west", "south_west", "south_west", "Concrete"])

    def test_engines_and_threads(self):
        """The same bytes for any number of threads."""
        self.mission(QUARTERS % "" + DECIBELS % "")
        outs = []
        for out, options in (("one", ["--threads", "1"]), ("two", ["--threads", "2"])):
            self.assert_renders("--set", f"output.folder={out}", *options)
            outs.append((self.folder / out / "side/clean.npy").read_bytes())
        self.assertEqual(*outs)

    def test_another_map_is_another_mission(self):
        """A folder that was made with another map is not continued."""
        self.mission(DECIBELS % "")
        self.assert_renders()
        (self.folder / "db.png").write_bytes(png([[10, 16], [13, 11]], 8))
        result = self.run_sonarsim("render", "mission.yaml")
        self.assert_refused(result, "holds a dataset of this mission made from other scene, "
                            "material or trajectory files (db.png)")

    def test_outside_the_scene(self):
        self.mission((DECIBELS % "").replace("origin_m: [10, 10]", "origin_m: [1000, 10]"))
        result = self.run_sonarsim("validate", "mission.yaml")
        self.assertIn("scene.backscatter_map lies outside the scene and changes nothing: the map has x -1000 to "
                      "-980 m, y -10 to 10 m, the scene x -10 to 10 m", result.stdout + result.stderr)

    def test_a_map_of_no_decibels(self):
        self.mission(DECIBELS % ", scale_db: 0")
        result = self.run_sonarsim("validate", "mission.yaml")
        self.assertIn("scene.backscatter_map changes nothing: each of its pixels is unknown or 0 dB; check scale_db",
                      result.stdout + result.stderr)

    def test_refused(self):
        for maps, fragments in (
                ((QUARTERS % "").replace("4: Concrete", "5: Concrete"),
                 ("quarters.png: row 1, column 1: 4 has no material; add 4: MATERIAL to "
                  "scene.sediment_map.materials, or mark it: gdal_translate -a_nodata 4", "mission.yaml:6:")),
                ((QUARTERS % "").replace("4: Concrete", "4: chalk"), ("unknown material 'chalk'",)),
                ((QUARTERS % "").replace("4: Concrete", '"#102030": Concrete'),
                 ("one channel of numbers, and scene.sediment_map.materials has '#102030'; write 7: MATERIAL",)),
                ((QUARTERS % "").replace("size_m: [20, 20], ", ""),
                 ("quarters.png: does not say how large its pixels are", "scene.sediment_map.pixel_m")),
                ((QUARTERS % "").replace("{1: north_west, 2: north_east, 3: south_west, 4: Concrete}", "{}"),
                 ("'materials' must name",)),
                (DECIBELS % ", scale_db: 20", ("db.png: row 0, column 0: 10 makes 200 dB, and at most 100 are "
                                               "believed", "mission.yaml:6:"))):
            with self.subTest(maps=maps):
                self.mission(maps)
                self.assert_refused(self.run_sonarsim("validate", "mission.yaml"), *fragments)
        self.mission(DECIBELS % "")
        self.edit("mission.yaml", "  bottom: [floor]\n", "")
        self.refused("maps need ground to lie on; write scene.bottom: [NAME]")
        (self.folder / "db.png").write_bytes(colour_png([[(1, 2, 3, 4)]]))
        self.mission(DECIBELS % "")
        self.refused("db.png: has 4 channels, and a map of decibels has one")


if __name__ == "__main__":
    unittest.main()
