"""Scenes that a mission composes of objects and scatters."""
import math
import unittest

from composed import SCATTER, Composed, box_mesh, floor_mesh, gltf
from sandbox import digest


class Objects(Composed):
    def test_the_same_bytes_as_one_gltf(self):
        """World (x, y, z) is (x, z, -y) in glTF; a turn about the world's z is one about glTF's y."""
        half = math.sqrt(0.5)
        self.write("whole.gltf", gltf(
            [{"name": "floor", "mesh": 0},
             {"name": "a", "mesh": 1, "translation": [4.25, 0.5, -1.125]},
             {"name": "b", "mesh": 1, "translation": [6.5, 0.75, 0.5], "scale": [1.5, 1.5, 1.5]},
             {"name": "c", "mesh": 1, "translation": [5.0, 0.625, 2.5],
              "rotation": [0, half, 0, half]}], [floor_mesh(), box_mesh()]))
        self.scene("  file: whole.gltf\n  materials: materials.csv\n")
        self.assert_renders()
        whole = self.images()
        self.assertGreater(len(whole), 6)
        self.objects(["{name: a, file: crate.gltf, position_m: [4.25, 1.125, 0.5]}",
                      "{name: b, file: crate.gltf, position_m: [6.5, -0.5, 0.75], scale: 1.5}",
                      "{name: c, file: crate.gltf, position_m: [5, -2.5, 0.625], "
                      "rpy_deg: [0, 0, 90]}"])
        self.assert_renders("--overwrite")
        self.assertEqual(self.images(), whole)

    def test_a_scene_of_objects_alone(self):
        self.scene("  file: floor.gltf\n  materials: materials.csv\n")
        self.assert_renders()
        whole = self.images()
        self.objects(["{file: floor.gltf}"], "  materials: materials.csv\n")
        self.assert_renders("--overwrite")
        self.assertEqual(self.images(), whole)

    def test_units_and_up_mend_a_file(self):
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 0.5], rpy_deg: [0, 0, 30]}"])
        self.assert_renders()
        whole = self.images()
        # 500 mm either way, and z up: the cube is the same after a quarter turn about x.
        self.write("mm.gltf", gltf([{"name": "crate", "mesh": 0}], [box_mesh(500.0)]))
        self.objects(["{name: a, file: mm.gltf, units: mm, position_m: [5, 0, 0.5], "
                      "rpy_deg: [0, 0, 30]}"])
        self.assert_renders("--overwrite")
        self.assertEqual(sorted(self.images()), sorted(whole))

    def test_rests_on_the_bottom(self):
        self.write("floor.gltf", gltf([{"name": "floor", "mesh": 0}], [floor_mesh(slope=0.1)]))
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 100], place: on_bottom}"])
        self.edit("mission.yaml", "output:\n", "output:\n  labels: [instance]\n")
        self.assert_renders()
        # Its lower edge at x = 5.5 touches the slope: 0.55 m, and the box reaches 1 m above that.
        box = self.dataset()["labels"]["instances"][1]["box_world_m"]
        self.assertAlmostEqual(box["min"][2], 0.55, places=4)
        self.assertAlmostEqual(box["max"][2], 1.55, places=4)

    def test_materials_by_other_names(self):
        self.write("crate.gltf", gltf([{"name": "crate", "mesh": 0}], [box_mesh()],
                                      ("0137_Black",)))
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 0.5]}"])
        self.refused("materials.csv", "0137_Black")
        for cure in ("material: steel", 'materials_map: {"0137_Black": steel}'):
            self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 0.5], " + cure + "}"])
            self.assert_renders("--overwrite")
        by_map = self.images()
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 0.5]}"],
                     "  file: floor.gltf\n  materials: materials.csv\n  material_default: steel\n")
        self.assert_renders("--overwrite")
        self.assertEqual(self.images(), by_map)


class Scattered(Composed):
    def setUp(self):
        super().setUp()
        self.scene("  file: floor.gltf\n  materials: materials.csv\n" + SCATTER)
        self.edit("mission.yaml", "output:\n", "output:\n  labels: [instance]\n")

    def boxes(self):
        return [one["box_world_m"] for one in self.dataset()["labels"]["instances"]
                if one["name"].startswith("mine_")]

    def test_seeded_and_apart(self):
        self.assert_renders()
        boxes = self.boxes()
        self.assertEqual(len(boxes), 5)
        for box in boxes:
            self.assertAlmostEqual(box["min"][2], 0, places=4)
            self.assertTrue(2 <= box["min"][0] and box["max"][0] <= 8)
            self.assertTrue(-4 <= box["min"][1] and box["max"][1] <= 4)
        # Crates whose centres are as far apart as their shortest side and the spacing.
        middle = [[(b["min"][k] + b["max"][k]) / 2 for k in (0, 1)] for b in boxes]
        for i, a in enumerate(middle):
            for b in middle[:i]:
                self.assertGreater(math.dist(a, b), 1.2)
        first = digest(self.out)
        self.assert_renders("--overwrite", "-j", "1")
        self.assertEqual(digest(self.out), first)
        self.assert_renders("--overwrite", "--seed", "8")
        self.assertNotEqual(self.boxes(), boxes)

    def test_no_room(self):
        self.edit("mission.yaml", "count: 5", "count: 50")
        self.refused("mission.yaml:7:7", "'mine': object", "of 50 finds no room in 1000 tries",
                     "larger area, fewer or smaller objects")

    def test_area_beside_the_bottom(self):
        self.edit("mission.yaml", "area_max_m: [8, 4]", "area_max_m: [80, 4]")
        self.edit("mission.yaml", "area_min_m: [2, -4]", "area_min_m: [70, -4]")
        self.refused("mission.yaml:7:7", "0 come too near", " have no bottom below")

    def test_inverted_area(self):
        self.edit("mission.yaml", "area_min_m: [2, -4]", "area_min_m: [9, -4]")
        self.refused("mission.yaml:7:", "area_min_m must be below area_max_m")

    def test_counts(self):
        self.edit("mission.yaml", "count: 5", "count: [3, 2]")
        self.refused("mission.yaml:7:", "'count': the first number must not be above the second")
        self.edit("mission.yaml", "count: [3, 2]", "count: 1.5")
        self.refused("mission.yaml:7:", "'count' must be a whole number or two of them")


if __name__ == "__main__":
    unittest.main()
