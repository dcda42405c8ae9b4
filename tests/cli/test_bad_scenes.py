"""Objects and scatters that are refused, and those that a mission is warned of."""
import unittest

from composed import SCATTER, Composed, box_mesh, floor_mesh, gltf


class BadObjects(Composed):
    def test_below_the_bottom(self):
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, -3]}"])
        self.refused("mission.yaml:7:7: 'a' lies wholly below the bottom", "place: on_bottom")

    def test_beside_the_bottom(self):
        self.objects(["{name: a, file: crate.gltf, position_m: [9.8, 0, 0], place: on_bottom}"])
        self.refused("mission.yaml:7:7: 'a' reaches beyond the bottom",
                     "from (-10, -10) to (10, 10)", "position_m")

    def test_scale_of_zero(self):
        self.objects(["{name: a, file: crate.gltf, scale: 0}"])
        self.refused("mission.yaml:7:42: 'scale' must be at least 1e-06, not '0'")

    def test_unknown_material(self):
        for key in ("material: steal", "materials_map: {Concrete: steal}"):
            self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 0.5], " + key + "}"])
            self.refused("mission.yaml:7:7: unknown material 'steal' (did you mean 'steel'?)",
                         "materials.csv")

    def test_renames_what_is_not_there(self):
        self.objects(["{name: a, file: crate.gltf, materials_map: {Concreet: steel}}"])
        self.refused("mission.yaml:7:7: materials_map:", "crate.gltf has no material 'Concreet'",
                     "did you mean 'Concrete'?")

    def test_two_of_one_name(self):
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 1]}",
                      "{name: a, file: crate.gltf, position_m: [7, 0, 1]}"])
        self.refused("mission.yaml:8:7: there is an object 'a' already")

    def test_buried_but_free(self):
        self.objects(["{name: a, file: crate.gltf, bury_m: 0.1}"])
        self.refused("mission.yaml:7:", "bury_m and align need place: on_bottom")

    def test_no_scene_at_all(self):
        self.scene("  materials: materials.csv\n")
        self.refused("mission.yaml:4:3: 'scene' needs the key 'file', a heightmap, a seabed or objects")

    def test_missing_file(self):
        self.objects(["{name: a, file: crat.gltf}"])
        self.refused("crat.gltf", "No such file", "; mission.yaml:7:7 names it")
        self.objects(["{name: a, file: crate.gltf, trajectory: {file: fish.csv}}"])
        self.refused("fish.csv", "No such file", "; mission.yaml:7:7 names it")

    def test_nothing_is_left(self):
        self.write("crate.gltf", '{"asset": {"version": "2.0"}}')
        self.objects(["{file: crate.gltf}"])
        self.refused("mission.yaml:7:7: 'crate.gltf': there is no surface in", "another file")

    def test_buried_wholly(self):
        self.objects(["{name: a, file: crate.gltf, place: on_bottom, bury_m: 1.01}"])
        self.refused("mission.yaml:7:7: 'a' lies wholly below the bottom; lower bury_m")
        self.scene("  file: floor.gltf\n  materials: materials.csv\n" +
                   SCATTER.replace("count: 5", "count: 2, bury_m: 1.01"))
        self.refused("mission.yaml:7:7: 'mine_1' lies wholly below the bottom; lower bury_m")

    def test_names_that_nothing_asks_for(self):
        """What no object needs so far is checked all the same."""
        for line, fragments in (("bottom: [flor]", ("bottom: no node of", "fits 'flor'")),
                                ("material_default: steal", ("unknown material 'steal' (did you "
                                                             "mean 'steel'?)", "materials.csv"))):
            self.scene(f"  file: floor.gltf\n  materials: materials.csv\n  {line}\n")
            self.refused("mission.yaml:4:3: ", *fragments)

    def test_empty_and_short_lists(self):
        self.objects(["{name: a, file: crate.gltf, position_m: [1, 2]}"])
        self.refused("mission.yaml:7:47: 'position_m' must be a list of 3 numbers, not of 2")
        self.scene("  file: floor.gltf\n  materials: materials.csv\n" +
                   SCATTER.replace("[crate.gltf]", "[]"))
        self.refused("mission.yaml:7:27: 'files' must be", "not an empty list")

    def warned(self, *fragments):
        result = self.run_sonarsim("validate", "mission.yaml")
        self.assertEqual(result.returncode, 0, result.stderr)
        for fragment in fragments:
            self.assertIn(fragment, result.stderr)

    def test_hidden_by_another(self):
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 1]}",
                      "{name: b, file: crate.gltf, scale: 0.5, position_m: [5, 0, 1]}"])
        self.warned("W21 scene: 1 object is in view but not seen", "'b'; these may lie behind")

    def test_a_mount_that_is_drawn_away_from_an_object(self):
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 1]}"])
        turned = "\nvary: [{key: sensors.fls.mount.rpy_deg.2, uniform: [175, 185], per: ping}]\n"
        self.write("mission.yaml", (self.folder / "mission.yaml").read_text() + turned)
        self.warned("W21 scene: 1 object is not in view", "'a'; move these")

    def test_a_count_of_zero(self):
        self.scene("  file: floor.gltf\n  materials: materials.csv\n" +
                   SCATTER.replace("count: 5", "count: 0"))
        self.warned("of 'mine' no object is placed because its count is 0")

    def test_not_in_metres(self):
        self.write("crate.gltf", gltf([{"name": "crate", "mesh": 0}], [box_mesh(6000.0)]))
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 6001]}"])
        result = self.run_sonarsim("validate", "mission.yaml")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("crate.gltf is 1.2e+04 m long", result.stderr)
        self.assertIn("units: mm", result.stderr)
        self.write("crate.gltf", gltf([{"name": "crate", "mesh": 0}], [box_mesh(0.0004)]))
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 1]}"])
        self.warned("crate.gltf is 0.0008 m long", "units: mm")
        # A proposed unit is one that is accepted.
        self.write("floor.gltf", gltf([{"name": "floor", "mesh": 0}], [floor_mesh(0.02)]))
        self.scene("  file: floor.gltf\n  materials: materials.csv\n")
        self.warned("check its units (scene.units: mm, cm, km, in)")
        self.edit("mission.yaml", "materials.csv\n", "materials.csv\n  units: in\n")
        self.assertEqual(self.run_sonarsim("validate", "mission.yaml").returncode, 0)


if __name__ == "__main__":
    unittest.main()
