"""Bad input ends with exit code 2, a message that names file, place and cure, and no dataset."""
import unittest

from sandbox import MATERIALS, Sandbox, box_gltf, digest, path_csv


class BadUsage(Sandbox):
    def test_usage_errors_exit_2(self):
        for arguments in ([], ["rendr"], ["render"], ["render", "mission.yaml", "--no-such"],
                          ["render", "mission.yaml", "-j", "0"],
                          ["render", "mission.yaml", "-j", "many"],
                          ["render", "mission.yaml", "--seed", "-1"],
                          ["render", "mission.yaml", "--shard", "3/2"],
                          ["render", "mission.yaml", "--shard", "0/2"],
                          ["render", "mission.yaml", "--shard", "1"],
                          ["render", "mission.yaml", "--log-level", "loud"]):
            with self.subTest(arguments=arguments):
                result = self.run_sonarsim(*arguments)
                self.assertEqual(result.returncode, 2, result.stdout + result.stderr)
                self.assertNotEqual(result.stderr, "")
                self.assertFalse(self.out.exists())

    def test_what_is_misspelt_is_named(self):
        for arguments, message in (
                (["rendr", "mission.yaml"], "unknown subcommand 'rendr' (did you mean 'render'?)"),
                (["--quiet"], "unknown option '--quiet'"),
                (["frobnicate"], "unknown subcommand 'frobnicate'\n"),
                (["render", "mission.yaml", "--overwite"],
                 "unknown option '--overwite' (did you mean '--overwrite'?)"),
                (["render", "mission.yaml", "--sead=3"],
                 "unknown option '--sead' (did you mean '--seed'?)"),
                (["inspect", "box.gltf", "box.gltf"], "one argument too many: 'box.gltf'"),
                (["inspect", "--jsn", "box.gltf"],
                 "unknown option '--jsn' (did you mean '--json'?)")):
            with self.subTest(arguments=arguments):
                result = self.run_sonarsim(*arguments)
                self.assertEqual(result.returncode, 2)
                self.assertTrue(result.stderr.startswith("error: " + message), result.stderr)

    def test_help_and_version_exit_0(self):
        for arguments in (["--help"], ["--version"], ["render", "--help"]):
            result = self.run_sonarsim(*arguments)
            self.assertEqual(result.returncode, 0)
            self.assertIn("sonarsim", result.stdout.lower())


class BadInput(Sandbox):
    def refused(self, *fragments, arguments=()):
        """Both render and validate refuse, with the same message."""
        for command in ("validate", "render"):
            with self.subTest(command=command):
                self.assert_refused(self.run_sonarsim(command, "mission.yaml", *arguments),
                                    *fragments)
                self.assertFalse(self.out.exists(), "a refused mission leaves no folder")

    def test_missing_mission(self):
        (self.folder / "mission.yaml").unlink()
        self.refused("mission.yaml", "No such file")

    def test_malformed_yaml(self):
        self.write("mission.yaml", "name: [1, 2\n")
        self.refused("mission.yaml:")

    def test_unknown_key(self):
        # range_max_m stands on line 13 of the mission, after four blanks.
        self.edit("mission.yaml", "range_max_m", "range_mx_m")
        self.refused("mission.yaml:13:5", "range_mx_m", "did you mean 'range_max_m'?")

    def test_duplicate_key(self):
        self.edit("mission.yaml", "seed: 7\n", "seed: 7\nseed: 8\n")
        self.refused("mission.yaml:3:1", "seed")

    def test_number_with_rubbish(self):
        self.edit("mission.yaml", "range_max_m: 6", "range_max_m: 6m")
        self.refused("mission.yaml:13:18", "6m")

    def test_empty_range(self):
        self.edit("mission.yaml", "range_max_m: 6", "range_max_m: 0.05")
        self.refused("mission.yaml:", "range_m")

    def test_domains(self):
        for old, new in (("range_bins: 48", "range_bins: 0"),
                         ("azimuth_bins: 32", "azimuth_bins: -1"),
                         ("azimuth_deg: 60", "azimuth_deg: 400"),
                         ("elevation_deg: 12", "elevation_deg: 0"),
                         ("add_sigma: 0.05", "add_sigma: -0.05"),
                         ("mult_sigma: 0.1", "mult_sigma: .nan")):
            with self.subTest(new=new):
                self.edit("mission.yaml", old, new)
                self.refused("mission.yaml:", new.split(":")[0])
                self.edit("mission.yaml", new, old)

    def test_set_unknown_key(self):
        self.refused("add_sgma", "did you mean 'add_sigma'?",
                     arguments=["--set", "sensors.fls.noise.add_sgma=0.2"])

    def test_set_bad_value(self):
        self.refused("add_sigma", "much", arguments=["--set", "sensors.fls.noise.add_sigma=much"])

    def test_set_without_equals(self):
        self.refused("--set", arguments=["--set", "seed"])

    def test_set_unknown_sensor(self):
        self.refused("fl2", arguments=["--set", "sensors.fl2.range_max_m=3"])

    def test_missing_scene(self):
        (self.folder / "box.gltf").unlink()
        self.refused("box.gltf", "No such file")

    def test_malformed_scene(self):
        self.write("box.gltf", box_gltf()[:-40])
        self.refused("box.gltf")

    def test_meshes_of_other_formats(self):
        for name in ("hull.fbx", "hull.DAE", "hull.off"):
            with self.subTest(name=name):
                self.write(name, "solid\nendsolid\n")
                self.refused(name, "convert it: assimp export " + name + " hull.glb",
                             arguments=["--set", "scene.file=" + name])

    def test_names_cannot_steer_the_terminal(self):
        self.write("box.gltf", box_gltf(material="Con\x1b[2Jcrete"))
        self.refused("Con\\x1b[2Jcrete")
        for arguments in (["inspect", "box.gltf"], ["render", "mission.yaml"]):
            result = self.run_sonarsim(*arguments)
            self.assertNotIn("\x1b", result.stdout + result.stderr)
        self.assertIn("Con\\x1b[2Jcrete", self.run_sonarsim("inspect", "box.gltf").stdout)

    def test_leaves_too_small_for_the_scene(self):
        self.write("box.gltf", box_gltf(half=(1e6, 1e6, 1e6)))
        self.refused("error: octree.leaf_m of 0.001 is too small for a scene 2e+06 m long; "
                     "use engine: auto or larger leaves",
                     arguments=["--set", "engine=octree", "--set", "octree.leaf_m=0.001"])

    def test_missing_materials(self):
        (self.folder / "materials.csv").unlink()
        self.refused("materials.csv", "No such file")

    def test_material_not_in_csv(self):
        self.write("box.gltf", box_gltf(material="Granite"))
        self.refused("materials.csv", "Granite")

    def test_density_zero(self):
        self.write("materials.csv", MATERIALS.replace("2400", "0"))
        self.refused("materials.csv:2", "density")

    def test_missing_trajectory(self):
        (self.folder / "path.csv").unlink()
        self.refused("path.csv", "No such file")

    def test_nan_pose(self):
        self.write("path.csv", path_csv(3) + "0.6,nan,0,0,0,0,0\n")
        self.refused("path.csv:5", "x_m")

    def test_unsorted_times(self):
        self.write("path.csv", path_csv(3) + "0.2,0,0,0,0,0,0\n")
        self.refused("path.csv:5", "increase")

    def test_zero_quaternion(self):
        self.write("path.csv", "t_s,x_m,y_m,z_m,qx,qy,qz,qw\n0,0,0,0,0,0,0,0\n")
        self.refused("path.csv:2", "quaternion")

    def test_empty_trajectory(self):
        self.write("path.csv", path_csv(0))
        self.refused("path.csv")


class BadFolder(Sandbox):
    def test_folder_holds_something_else(self):
        kept = self.write("out/thesis.txt", "years of work")
        self.assert_refused(self.render(), "out", "not a sonarsim dataset", "another output.folder")
        self.assertEqual(kept.read_text(), "years of work")
        self.assertEqual([p.name for p in self.out.iterdir()], ["thesis.txt"])

    def test_overwrite_never_replaces_the_mission_itself(self):
        self.assert_renders()
        own = self.out / "mission.resolved.yaml"
        before = digest(self.out)
        result = self.run_sonarsim("render", str(own), "--overwrite", "--seed", "9",
                                   "--paths-from", ".", "--out", "out")
        self.assert_refused(result, "mission.resolved.yaml", "the mission itself")
        self.assertEqual(digest(self.out), before)

    def test_overwrite_never_deletes_what_is_no_dataset(self):
        kept = self.write("out/thesis.txt", "years of work")
        self.assert_refused(self.render("--overwrite"), "out", "not a sonarsim dataset")
        self.assertEqual(kept.read_text(), "years of work")

    def test_folder_is_a_file(self):
        self.write("out", "a file")
        self.assert_refused(self.render(), "out")
        self.assertEqual(self.out.read_text(), "a file")

    def test_another_mission_is_not_overwritten(self):
        self.assert_renders()
        self.assert_refused(self.render("--seed", "8"), "out", "--overwrite")
        self.assertEqual(self.dataset()["seed"], 7)
        self.assert_renders("--seed", "8", "--overwrite")
        self.assertEqual(self.dataset()["seed"], 8)


if __name__ == "__main__":
    unittest.main()
