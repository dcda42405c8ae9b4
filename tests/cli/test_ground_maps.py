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
  waterfall: true
  labels: [material, clean]
"""
# The floor has 20 x 20 m: values 1 and 2 in the north, 3 and 4 in the south.
QUARTERS = ('  sediment_map: {file: quarters.png, size_m: [20, 20], origin_m: [10, 10], instances: [floor]%s,\n'
            '    materials: {1: north_west, 2: north_east, 3: south_west, 4: Concrete}}\n')
DECIBELS = '  backscatter_map: {file: db.png, size_m: [20, 20], origin_m: [10, 10], instances: ["*"]%s}\n'


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


UV = "  sediment_map: {file: quarters.png, placed: uv, instances: [floor]%s,\n" + QUARTERS.split("\n")[1] + "\n"


def unwrapped_floor(uv):
    """The floor with texture coordinates uv(x, y), x east and y north."""
    points, indices, material = floor_mesh(cells=5)
    floor = json.loads(gltf([{"name": "floor", "mesh": 0}], [(points, indices, material)]))
    data = b"".join(struct.pack("<2f", *uv(x, -z)) for x, _, z in points)
    floor["buffers"].append({"byteLength": len(data), "uri": "data:application/octet-stream;base64,"
                             + base64.b64encode(data).decode()})
    floor["bufferViews"].append({"buffer": 1, "byteLength": len(data)})
    floor["accessors"].append({"bufferView": 2, "componentType": 5126, "count": len(points), "type": "VEC2"})
    floor["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 2
    return floor


def data_uri(data, media="application/octet-stream"):
    return f"data:{media};base64," + base64.b64encode(data).decode()


def with_texture(floor, image, **use):
    """The floor with a material that names an image."""
    texture = {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0} | use}}
    return json.loads(json.dumps(floor)) | {"materials": [floor["materials"][0] | texture],
                                            "textures": [{"source": 0}], "images": [image]}


def halves(west, east, stretch=1):
    """The floor in two nodes, each with a material that names an image. The western one has texture
    coordinates up to `stretch` along x."""
    meshes, data = [], []
    for k in range(2):
        points, indices, _ = floor_mesh(half=10.0, cells=5)
        meshes.append(([((x - 10) / 2 + 10 * k, y, z) for x, y, z in points], indices, k))
        data.append(b"".join(struct.pack("<2f", (1 if k else stretch) * (x + 10) / 20, (z + 10) / 20)
                             for x, _, z in points))
    floor = json.loads(gltf([{"name": "west", "mesh": 0}, {"name": "east", "mesh": 1}], meshes,
                            ("Concrete", "Concrete")))
    for k in range(2):
        floor["buffers"].append({"byteLength": len(data[k]), "uri": data_uri(data[k])})
        floor["bufferViews"].append({"buffer": 1 + k, "byteLength": len(data[k])})
        floor["accessors"].append({"bufferView": 4 + k, "componentType": 5126, "count": 36, "type": "VEC2"})
        floor["meshes"][k]["primitives"][0]["attributes"]["TEXCOORD_0"] = 4 + k
        floor["materials"][k]["pbrMetallicRoughness"] = {"baseColorTexture": {"index": k}}
    return floor | {"textures": [{"source": 0}, {"source": 1}], "images": [west, east]}


def glb(document):
    """A .glb whose only chunk is the JSON."""
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    return struct.pack("<4sIIII", b"glTF", 2, 20 + len(text), len(text), 0x4E4F534A) + text


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

    def test_by_texture_coordinates(self):
        """Coordinates that are the place of the ground give the image of the map from above; turned ones
        turn the map."""
        self.mission(QUARTERS % "" + DECIBELS % "")
        self.assert_renders()
        above = records_of(self.folder / "out/side/clean.npy")
        for out, uv, names in (
                ("uv", lambda x, y: ((x + 10) / 20, (10 - y) / 20),
                 ["north_west", "south_west", "north_east", "Concrete"]),
                ("turned", lambda x, y: ((10 - x) / 20, (y + 10) / 20),
                 ["Concrete", "north_east", "south_west", "north_west"])):
            self.write("floor.gltf", json.dumps(unwrapped_floor(uv)))
            self.mission(UV % "" + '  backscatter_map: {file: db.png, placed: uv, instances: ["*"]}\n', out)
            self.assert_renders()
            materials = self.dataset(self.folder / out)["labels"]["materials"]
            materials = {entry["id"]: entry["name"] for entry in materials}
            self.assertEqual([materials[value] for value in self.rows("material", out)], names)
            rows = records_of(self.folder / out / "side/clean.npy")
            off = sum(abs(a - b) for one, other in zip(rows, above, strict=True)
                      for a, b in zip(one, other, strict=True))
            whole = sum(sum(row) for row in above)
            if out == "uv":
                self.assertLess(off, 1e-4 * whole)
            else:
                self.assertGreater(off, 0.1 * whole)

    def test_own_texture(self):
        """The texture that the material of a glTF names: embedded, in a .glb, or a file beside it. The
        images are those of the same image as a file."""
        picture = (self.folder / "quarters.png").read_bytes()
        floor = unwrapped_floor(lambda x, y: ((x + 10) / 20, (10 - y) / 20))
        self.write("floor.gltf", json.dumps(floor))
        self.mission(UV % "", "file")
        self.assert_renders()
        (self.folder / "a floor.png").write_bytes(picture)
        textured = with_texture(floor, {"uri": "a%20floor.png"})
        embedded = with_texture(floor, {"bufferView": 3})
        embedded["buffers"].append({"byteLength": len(picture), "uri": data_uri(picture)})
        embedded["bufferViews"].append({"buffer": 2, "byteLength": len(picture)})
        inline = with_texture(floor, {"uri": data_uri(picture, "image/png")})
        for out, file, content in (("beside", "floor.gltf", json.dumps(textured).encode()),
                                   ("view", "floor.gltf", json.dumps(embedded).encode()),
                                   ("inline", "floor.gltf", json.dumps(inline).encode()),
                                   ("glb", "floor.glb", glb(embedded))):
            with self.subTest(out=out):
                (self.folder / file).write_bytes(content)
                self.mission((UV % "").replace("quarters.png", file), out)
                text = (self.folder / "mission.yaml").read_text()
                self.write("mission.yaml", text.replace("file: floor.gltf", "file: " + file))
                self.assert_renders()
                self.assertEqual(self.rows("material", out), self.rows("material", "file"))
                self.assertEqual((self.folder / out / "side/clean.npy").read_bytes(),
                                 (self.folder / "file/side/clean.npy").read_bytes())

    def test_several_own_textures(self):
        """Two halves of the floor whose materials name images of their own, of other sizes, and the same
        as one image from above. Texture coordinates beyond the western image do not reach the eastern one."""
        west, east = [[1, 2], [3, 4]], [[4, 3, 2], [1, 2, 3], [1, 1, 4]]
        (self.folder / "west.png").write_bytes(png(west, 8))
        (self.folder / "east.png").write_bytes(png(east, 8))
        own = (UV % "").replace("quarters.png", "floor.gltf").replace("[floor]", "[west, east]")
        above = (QUARTERS % ", no_data: 0").replace("[floor]", "[west, east]")
        for stretch in (1, 4):
            with self.subTest(stretch=stretch):
                whole = [[west[row // 3][stretch * k // 6] if stretch * k < 12 else 0 for k in range(12)] +
                         [east[row // 2][k // 4] for k in range(12)] for row in range(6)]
                (self.folder / "quarters.png").write_bytes(png(whole, 8))
                self.write("floor.gltf", json.dumps(halves({"uri": "west.png"}, {"uri": "east.png"}, stretch)))
                rows = []
                for out, maps in (("own", own), ("one", above)):
                    self.mission(maps, f"{out}{stretch}")
                    self.assert_renders()
                    rows.append(records_of(self.folder / f"{out}{stretch}" / "side/clean.npy"))
                off = sum(abs(a - b) for mine, other in zip(*rows, strict=True)
                          for a, b in zip(mine, other, strict=True))
                # The one image has smaller pixels, so that bins on a border are summed in smaller parts.
                self.assertLess(off, 1e-3 * sum(sum(row) for row in rows[1]))

    def test_own_texture_refused(self):
        floor = unwrapped_floor(lambda x, y: (x, y))
        two = halves({"uri": "quarters.png"}, {"uri": "quarters.png"})
        (self.folder / "colours.png").write_bytes(colour_png([[(1, 2, 3, 255)]]))
        mixed = halves({"uri": "quarters.png"}, {"uri": "colours.png"})
        moved = with_texture(floor, {"uri": "quarters.png"})
        use = moved["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]
        use["extensions"] = {"KHR_texture_transform": {"scale": [2, 2]}}
        for content, fragment in (
                (floor, "has no material with a baseColorTexture; name an image as the map's file"),
                (mixed, "has images of different kinds"),
                (halves({"uri": "quarters.png"}, {"uri": "none.png"}), "none.png: no such file"),
                (two | {"images": [{"uri": "quarters.png"}]}, "images[1] does not exist"),
                (moved, "moves its texture with KHR_texture_transform"),
                (with_texture(floor, {"uri": "quarters.png"}, texCoord=1), "by another TEXCOORD than TEXCOORD_0"),
                (with_texture(floor, {"uri": "../db.png"}), "is not in the folder of the glTF file or below"),
                (with_texture(floor, {"uri": "none.png"}), "none.png: no such file"),
                (with_texture(floor, {"uri": data_uri(b"\xff\xd8\xff\xe0")}), "is a JPEG, whose values are not exact"),
                (with_texture(floor, {"uri": data_uri(png([[1, 2]], 8)[:50])}), "cannot be read"),
                (with_texture(floor, {"bufferView": 2**31 - 1}), "reaches beyond bufferViews[2147483647]"),
                (with_texture(floor, {"uri": "a.png"}, index=7), "textures[7] does not exist")):
            with self.subTest(fragment=fragment):
                self.write("floor.gltf", json.dumps(content))
                self.mission((UV % "").replace("quarters.png", "floor.gltf").replace("[floor]", '["*"]'))
                result = self.run_sonarsim("validate", "mission.yaml")
                # The PNG library's own message may contain the word "error:" as well.
                result.stderr = result.stderr.replace("Read error:", "").replace("read error:", "")
                self.assert_refused(result, fragment, "mission.yaml:5:")
        self.mission((QUARTERS % "").replace("quarters.png", "floor.gltf"))
        self.refused("is a mesh, whose texture lies on it by placed: uv; name an image")
        self.write("floor.gltf", json.dumps(two))
        own = (UV % "").replace("quarters.png", "floor.gltf").replace("[floor]", '["*"]')
        self.mission(own + '  backscatter_map: {file: db.png, placed: uv, instances: ["*"]}\n')
        self.refused("the materials of the glTF name several images, over which no second map lies", "mission.yaml:5:")
        self.write("other.gltf", json.dumps(floor))
        self.mission(own + "  objects: [{name: lid, file: other.gltf, "
                     "position_m: [0, 0, 1]}]\n")
        self.refused("floor.gltf, whose images lie on its own materials; name its nodes as instances")

    def test_texture_coordinates_refused(self):
        def write(change):
            floor = unwrapped_floor(lambda x, y: (x, y))
            change(floor)
            self.write("floor.gltf", json.dumps(floor))

        def primitive(floor):
            return floor["meshes"][0]["primitives"][0]

        for change, fragment in (
                (lambda floor: primitive(floor)["attributes"].pop("TEXCOORD_0"),
                 "of node 'floor' has no TEXCOORD_0, by which a map is placed with placed: uv"),
                (lambda floor: floor["accessors"][2].update(count=35), "TEXCOORD_0 has 35 elements, and POSITION has 36"),
                (lambda floor: floor["accessors"][2].update(count=10**6), "bufferView 2 is too short"),
                (lambda floor: floor["accessors"][2].update(type="VEC3"), "TEXCOORD_0: expected an accessor of type VEC2"),
                (lambda floor: floor["accessors"][2].update(componentType=5125),
                 "texture coordinates must be float"),
                (lambda floor: primitive(floor)["attributes"].update(TEXCOORD_0=9), "accessor 9 does not exist")):
            with self.subTest(fragment=fragment):
                write(change)
                self.mission(UV % "")
                self.assert_refused(self.run_sonarsim("validate", "mission.yaml"), fragment, "floor.gltf")
        for maps, fragment in ((UV % ", size_m: [20, 20]", "with placed: uv the mesh says where the map lies"),
                               (UV % "" + DECIBELS % "", "must be placed alike")):
            write(lambda floor: None)
            self.mission(maps)
            self.assert_refused(self.run_sonarsim("validate", "mission.yaml"), fragment)

    def test_no_data(self):
        self.mission((QUARTERS % ", no_data: 3").replace(", 3: south_west", "") + DECIBELS % ", no_data: 16")
        self.assert_renders()
        self.assertEqual(self.material_names(), ["north_west", "Concrete", "north_east", "Concrete"])

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
        self.assertIn("scene.backscatter_map changes nothing: each of its pixels is unknown or 0 dB; check no_data",
                      result.stdout + result.stderr)

    def test_refused(self):
        for maps, fragments in (
                ((QUARTERS % "").replace("4: Concrete", "5: Concrete"),
                 ("quarters.png: row 1, column 1: 4 has no material; add 4: MATERIAL to "
                  "scene.sediment_map.materials, or write no_data: 4", "mission.yaml:5:")),
                ((QUARTERS % "").replace("4: Concrete", "4: chalk"), ("unknown material 'chalk'",)),
                ((QUARTERS % "").replace("4: Concrete", '"#102030": Concrete'),
                 ("one channel of numbers, and scene.sediment_map.materials has '#102030'; write 7: MATERIAL",)),
                ((QUARTERS % "").replace("[floor]", "[flor]"),
                 ("no instance at rest is named 'flor' (did you mean 'floor'?)",)),
                ((QUARTERS % "").replace(", instances: [floor]", ""),
                 ("scene.sediment_map does not say what it lies on; write instances: [NAME]",)),
                ((QUARTERS % "").replace("size_m: [20, 20], ", ""),
                 ("quarters.png: does not say how large its pixels are", "scene.sediment_map.pixel_m")),
                ((QUARTERS % "").replace("{1: north_west, 2: north_east, 3: south_west, 4: Concrete}", "{}"),
                 ("'materials' must name",)),
                (DECIBELS % ", scale_db: 20", ("db.png: row 0, column 0: 10 makes 200 dB, and at most 100 are "
                                               "believed", "mission.yaml:5:"))):
            with self.subTest(maps=maps):
                self.mission(maps)
                self.assert_refused(self.run_sonarsim("validate", "mission.yaml"), *fragments)
        (self.folder / "db.png").write_bytes(colour_png([[(1, 2, 3, 4)]]))
        self.mission(DECIBELS % "")
        self.refused("db.png: has 4 channels, and a map of decibels has one")


if __name__ == "__main__":
    unittest.main()
