"""Grounds: images of heights, maps of material and strength, and beds that are made from numbers and the mission's
seed. What is refused: test_refusals.py."""
import array
import math
import shutil
import unittest

from sandbox import ROOT, Composed, box_mesh, digest, gltf, grid_mesh, height_of, numbers_of, png, relative_difference

COLUMNS, ROWS, PIXEL = 48, 40, 0.25
SONAR = """\
sensors:
  fls: {kind: imaging, range_max_m: 9, range_bins: 48, azimuth_bins: 32, mount: {rpy_deg: [0, 25, 0]}}
output: {folder: %s, labels: true}
"""
OVER_THE_MAP = """\
seed: 5
scene:
%s  materials: materials.csv
%strajectory: {waypoints: [{position_m: [1, 4.5, 3]}, {position_m: [2, 5, 3], rpy_deg: [0, 0, 30]}], speed_m_s: 1, rate_hz: 3}
""" + SONAR
OBJECTS = """\
  objects:
    - {name: crate, file: crate.gltf, position_m: [5, 5, 0], place: on_bottom, bury_m: 0.1}
  scatter:
    - {name: mine, files: [crate.gltf], count: 4, area_min_m: [3, 2], area_max_m: [9, 8], scale: 0.4}
"""
MAP = "  heightmap: {file: bed.png, material: Concrete, pixel_m: 0.25, height_scale: 0.001, height_offset_m: -3}\n"


def surface():
    """The ground of the map as a mesh, in glTF's axes (y up): x east, z south."""
    return grid_mesh([(PIXEL * (c + 0.5), 0.001 * height_of(r, c) - 3, -PIXEL * (ROWS - r - 0.5))
                      for r in range(ROWS) for c in range(COLUMNS)], COLUMNS)


class Heightmap(Composed):
    FILES = {"bed.png": png([[height_of(r, c) for c in range(COLUMNS)] for r in range(ROWS)], 16),
             "bed.gltf": gltf([{"name": "heightmap", "mesh": 0}], [surface()])}

    def assert_same(self, objects="", change=str):
        """The images of the map equal those of the mesh to 1e-4."""
        images = []
        for scene, out in (("  file: bed.gltf\n", "mesh"), (MAP, "map")):
            self.write("mission.yaml", change(OVER_THE_MAP % (scene, objects, out)))
            self.assert_renders()
            images.append([numbers_of(path) for path in sorted((self.folder / out / "fls/polar").glob("*.npy"))])
        self.assertGreater(len(images[0]), 2)
        for mesh, image in zip(*images, strict=True):
            self.assertLess(relative_difference(image, mesh), 1e-4)

    def test_the_same_as_a_mesh(self):
        """With a buried crate and scattered mines, which lie where they do on the mesh."""
        self.assert_same(OBJECTS)
        mesh, image = self.boxes("mesh"), self.boxes("map")
        self.assertEqual(list(image), ["heightmap", "crate", *(f"mine_{k}" for k in range(1, 5))])
        for name in list(image)[1:]:
            for side in ("min", "max"):
                self.assert_near(mesh[name][side], image[name][side], 1e-5)

    def test_only_what_is_in_range(self):
        """1.5 m above the ground a sonar that reaches 4 m leaves most of the map out."""
        self.assert_same("  objects: []\nengine: rays\n",
                         lambda text: text.replace("max_m: 9", "max_m: 4").replace("5, 3]", "5, 1.5]"))
        mesh, image = (self.dataset(name)["scene"]["triangles"] for name in ("mesh", "map"))
        self.assertLess(image, 0.6 * mesh)

    def test_long_cells_are_warned_of(self):
        """Cells of 0.25 m have visible facets in bins of 2.5 cm, and none in bins of 6 cm."""
        self.write("mission.yaml", OVER_THE_MAP % (MAP, "", "out"))
        for bins, warned in ((356, True), (142, False)):
            result = self.succeeds("validate", "mission.yaml", "--set", f"sensors.fls.range_bins={bins}")
            self.assertEqual("W37 scene.heightmap: its cells of 0.25 m are 10 times" in result.stderr, warned)
            cure = self.succeeds("validate", "mission.yaml", "--set", f"sensors.fls.range_bins={bins}",
                                 "--set", "scene.heightmap.cell_m=0.101")
            self.assertNotIn("W37", cure.stderr)

    def test_its_name_is_its_own(self):
        """Labels and maps find the ground by its name: a node of the scene's file gets another."""
        self.write("crate.gltf", gltf([{"name": "heightmap", "mesh": 0}], [box_mesh()]))
        self.write("mission.yaml", OVER_THE_MAP % ("  file: crate.gltf\n" + MAP, "", "out"))
        self.assert_renders()
        self.assertEqual(list(self.boxes()), ["heightmap_2", "heightmap"])
        self.assertEqual(self.dataset()["labels"]["annotations"]["background"], ["heightmap"])


class Maps(Composed):
    """The floor has 20 x 20 m: values 1 and 2 in the north, 3 and 4 in the south."""
    MISSION = """\
seed: 5
scene:
  file: floor.gltf
  materials: materials.csv
  bottom: [floor]
%strajectory: {waypoints: [{position_m: [-5, 0, 2]}, {position_m: [5, 0, 2]}], speed_m_s: 10, rate_hz: 1}
sensors: {side: {kind: sidescan, range_min_m: 2.5, range_max_m: 8, range_bins: 55}}
output: {folder: out, labels: [material, clean]}
"""
    QUARTERS = ('  sediment_map: {file: quarters.png, pixel_m: 10, origin_m: [10, 10],\n'
                '    materials: {1: north_west, 2: north_east, 3: south_west, 4: Concrete}}\n')
    DECIBELS = '  backscatter_map: {file: db.png, pixel_m: 10, origin_m: [10, 10]}\n'

    FILES = {"materials.csv": "material,density_kg_m3,sound_speed_m_s\nConcrete,2400,3200\n"
                              "north_west,1500,1600\nnorth_east,1700,1700\nsouth_west,1900,1900\n",
             "quarters.png": png([[1, 2], [3, 4]]), "db.png": png([[0, 6], [3, 0]])}

    def rows(self, maps, what):
        """The values of the first and the last ping, at port and at starboard, in the middle of each."""
        self.write("mission.yaml", self.MISSION % maps)
        self.assert_renders("--overwrite")
        numbers = numbers_of(self.out / f"side/{what}.npy")
        half = len(numbers) // 2
        return [numbers[k] for row in (0, half) for k in (row + half // 4, row + 3 * half // 4)]

    def assert_materials(self, maps, *names):
        values = self.rows(maps, "material")
        known = {entry["id"]: entry["name"] for entry in self.dataset()["labels"]["materials"]}
        self.assertEqual([known[value] for value in values], list(names))

    def assert_decibels(self, maps, decibels, *expected):
        plain, found = self.rows(maps, "clean"), self.rows(maps + decibels, "clean")
        self.assert_near([10 * math.log10(a / b) for a, b in zip(found, plain)], expected, 0.01)

    def test_place(self):
        """A sonar that heads east in the west and then in the east: port is the north. The map is not
        mirrored, and its first row is the north."""
        places = ("north_west", "south_west", "north_east", "Concrete")
        self.assert_materials(self.QUARTERS, *places)
        self.assert_decibels(self.QUARTERS, self.DECIBELS, 0, 3, 6, 0)
        # The same place by a world file, whose coordinates are those of a pixel's centre.
        self.write("quarters.wld", "10\n0\n0\n-10\n4995\n8005\n")
        self.assert_materials(self.QUARTERS.replace("pixel_m: 10, origin_m: [10, 10]", "origin_m: [5000, 8000]"), *places)

    @unittest.skipIf(shutil.which("gdal_translate") is None, "needs gdal-bin")
    def test_no_data(self):
        """A pixel that the file marks leaves the material of the mesh, and its strength."""
        for name, value in (("quarters", 3), ("db", 6)):
            self.run_program("gdal_translate", "-q", "-a_nodata", value, f"{name}.png", f"{name}.tif")
        quarters = self.QUARTERS.replace(", 3: south_west", "").replace(".png", ".tif")
        self.assert_materials(quarters, "north_west", "Concrete", "north_east", "Concrete")
        self.assert_decibels(quarters, self.DECIBELS.replace(".png", ".tif"), 0, 3, 0, 0)

    def test_colours(self):
        """A transparent pixel leaves the material of the mesh."""
        sand, mud = (200, 180, 120, 255), (1, 2, 255, 255)
        self.write("quarters.png", png([sand + mud, mud + (9, 9, 9, 0)], channels=4))
        self.assert_materials(self.QUARTERS.replace("1: north_west, 2: north_east, 3: south_west, 4: Concrete",
                                                    '"#C8b478": north_west, "#0102ff": south_west'),
                              "north_west", "south_west", "south_west", "Concrete")


BED = """\
seed: 5
scene:
  materials: materials.csv
  seabed:
    cell_m: 0.2
    z_m: -2.5
    material: Concrete
    class: bottom
    roughness: {spectral_strength_cm4: 0.003}
    ripples: {height_m: 0.1, length_m: 0.8, direction_deg: 20}
  objects:
    - {name: crate, file: crate.gltf, position_m: [4, 0.5, 9], place: on_bottom}
trajectory: {waypoints: [{position_m: [0, 0, 0]}, {position_m: [1, 0, 0]}], speed_m_s: 1, rate_hz: 2}
""" + SONAR % "out"


class Seabed(Composed):
    def test_truth(self):
        """The files of the truth are that of what is rendered: the same rocks in the labels, which lie in the same
        heights, and the share of each material. Objects rest on it."""
        self.write("mission.yaml", BED.replace("    material: Concrete\n", """\
    sediments: [{material: Concrete, share: 2}, {material: steel, share: 1}]
    patch_m: 3
    rocks: {density_per_m2: 0.3, diameter_m: [0.3, 1.5], exponent: 2, material: steel}
""").replace("labels: true", "labels: [objects]"))
        self.assert_renders()
        reported = self.json("out/seabed/seabed.json")
        grid = reported["grid"]
        heights = array.array("f", (self.out / "seabed/heights.tif").read_bytes()[-4 * grid["rows"] * grid["columns"]:])
        self.assertTrue(-4 < min(heights) < max(heights) < -1)
        boxes = self.boxes()
        self.assertTrue(-2.8 < boxes["crate"]["min"][2] < -1, boxes["crate"])
        self.assertGreater(len(reported["rocks"]), 20)
        for rock in reported["rocks"]:
            for side in ("min", "max"):
                self.assert_near(rock["box_world_m"][side], boxes[rock["name"]][side], 1e-4)
            x, y, _ = rock["middle_m"]
            row = int((grid["north_m"] - y) / grid["cell_m"])
            column = int((x - grid["west_m"]) / grid["cell_m"])
            bottom, top = (rock["box_world_m"][side][2] for side in ("min", "max"))
            # The bed within half a cell of the middle has nearly its height.
            self.assertAlmostEqual(bottom + rock["buried"] * (top - bottom), heights[row * grid["columns"] + column], delta=0.25)
        self.assertEqual([one["material"] for one in reported["materials"]], ["Concrete", "steel"])
        self.assertAlmostEqual(sum(one["share"] for one in reported["materials"]), 1)
        # A dataset like any other: verified, resumed where a file of the truth is gone, and merged.
        before = digest(self.out)
        (self.out / "seabed/heights.tif").unlink()
        self.assert_verify_finds("seabed/heights.tif: is missing")
        self.assert_renders()
        self.assertEqual(digest(self.out), before)
        self.assert_shards_agree()

    def test_its_files_are_the_ground_of_the_next_mission(self):
        self.write("materials.csv", "material,density_kg_m3,sound_speed_m_s\nConcrete,2400,3100\nmud,1150,1470\n" "sand,1900,1700\n")
        self.write("mission.yaml", BED.replace("labels: true", "labels: [clean]").replace("cell_m: 0.2", "cell_m: 0.1").replace(
            "    material: Concrete\n", "    sediments: [{material: sand, share: 1}, {material: mud, share: 1}]\n"
            "    patch_m: 1\n"))
        text = (self.folder / "mission.yaml").read_text()
        self.assert_renders()
        names = ", ".join(f"{one['value']}: {one['material']}" for one in self.json("out/seabed/seabed.json")["materials"])
        start, end = text.index("  seabed:"), text.index("  objects:")
        self.write("again.yaml", text[:start] + "  heightmap: {file: out/seabed/heights.tif, material: sand}\n"
                   f"  sediment_map: {{file: out/seabed/materials.png, materials: {{{names}}}}}\n" + text[end:])
        self.succeeds("render", "again.yaml", "--out", "again")
        one, other = (numbers_of(folder / "fls/clean/000000.npy") for folder in (self.out, self.folder / "again"))
        # Fields of the map end at its pixels, and those of the bed within its triangles.
        self.assertLess(relative_difference(other, one), 0.04)

    def test_mixtures_have_the_label_of_what_prevails(self):
        """Also beside a material of the user's whose name looks like a mixture's."""
        self.write("materials.csv", "material,density_kg_m3,sound_speed_m_s,grain_phi\nConcrete,2400,3100,\nsand,1900,1700,1.5\n"
                   "mud + shells,1150,1470,7\nmud,1200,1480,7\n")
        self.write("mission.yaml", BED.replace("    material: Concrete\n", "    patch_m: 2\n    sediments:\n"
                   "      [{material: sand, share: 1}, {material: mud + shells, share: 1}, {material: mud, share: 1}]\n")
                   .replace("imaging", "sidescan").replace("azimuth_bins: 32, ", "").replace("true", "[material]"))
        self.assert_renders()
        names = {entry["id"]: entry["name"] for entry in self.dataset()["labels"]["materials"]}
        self.assertTrue({"sand + 40 % mud + shells", "mud + shells + 40 % sand"} < set(names.values()), names)
        self.assertEqual({names[value] for value in numbers_of(self.out / "fls/material.npy") if value} - {"Concrete"},
                         {"sand", "mud + shells", "mud"})

    def test_presets(self):
        """Each bed of configs/seabeds, with keys of the mission's own above those of the file."""
        for path in sorted((ROOT / "configs/seabeds").glob("*.yaml")):
            self.write("mission.yaml", BED.replace("    material: Concrete\n", f"    preset: seabeds/{path.name}\n").replace(
                "materials.csv", f"{ROOT}/scenes/materials.csv\n  material_default: sand"))
            self.succeeds("validate", "mission.yaml", "--set", "sensors.fls.range_max_m=4")
