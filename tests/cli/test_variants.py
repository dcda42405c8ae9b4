"""Variants of a mission: draws, seeds, shards, resume, and what is refused."""
import json
import shutil
import unittest

from sandbox import MISSION, Sandbox, box_gltf, digest

VARY = """
variants: 6
vary:
  - {key: sensors.fls.noise.add_sigma, uniform: [0.01, 0.2]}
  - {key: water.sound_speed_m_s, normal: [1490, 20], within: [1400, 1600]}
  - {key: sensors.fls.range_bins, whole: [40, 60]}
  - {key: water.density_kg_m3, choice: [1000, 1025], per: dataset}
"""


class Variants(Sandbox):
    def setUp(self):
        super().setUp()
        mission = (self.folder / "mission.yaml").read_text()
        self.write("mission.yaml", mission + VARY)

    def refused(self, *fragments, arguments=()):
        for command in ("validate", "render"):
            self.assert_refused(self.run_sonarsim(command, "mission.yaml", *arguments), *fragments)
            self.assertFalse(self.out.exists(), "a refused mission leaves no folder")

    def index(self, folder=None):
        return json.loads(((folder or self.out) / "variants.json").read_text())["variants"]

    def test_all_differ_and_come_again(self):
        self.assert_renders()
        index = self.index()
        self.assertEqual([one["folder"] for one in index],
                         [f"variant_{k:04}" for k in range(6)])
        self.assertEqual(len({one["seed"] for one in index}), 6)
        self.assertEqual(len({one["drawn"]["sensors.fls.noise.add_sigma"] for one in index}), 6)
        self.assertEqual(len({one["drawn"]["water.density_kg_m3"] for one in index}), 1)
        polar = {(self.out / one["folder"] / "fls/polar/000000.npy").read_bytes() for one in index}
        self.assertEqual(len(polar), 6)
        for one in index:
            self.assertTrue(0.01 <= one["drawn"]["sensors.fls.noise.add_sigma"] <= 0.2)
            dataset = self.dataset(self.out / one["folder"])
            self.assertTrue(dataset["complete"])
            self.assertEqual(dataset["variant"]["drawn"], one["drawn"])
            bins = len(dataset["sensors"][0]["range_edges_m"]) - 1
            self.assertEqual(bins, one["drawn"]["sensors.fls.range_bins"])
            meta = json.loads((self.out / one["folder"] / "fls/meta/000001.json").read_text())
            self.assertEqual(meta["variant"]["drawn"], one["drawn"])
        first = digest(self.out)
        self.assert_renders("--overwrite", "-j", "1")
        self.assertEqual(digest(self.out), first)
        self.assert_renders()  # nothing is missing, and nothing changes
        self.assertEqual(digest(self.out), first)

    def test_a_variant_does_not_depend_on_how_many_there_are(self):
        self.assert_renders()
        six = self.index()
        self.assert_renders("--overwrite", "--set", "variants=3")
        self.assertEqual(self.index(), six[:3])
        self.assertFalse((self.out / "variant_0003").exists())

    def test_shards_and_resume(self):
        self.assert_renders()
        whole = digest(self.out)
        shutil.rmtree(self.out)
        for shard in ("2/3", "1/3", "3/3"):
            self.assert_renders("--shard", shard)
        self.assertEqual(digest(self.out), whole)
        shutil.rmtree(self.out / "variant_0004")
        (self.out / "variant_0002/fls/polar/000003.npy").unlink()
        self.assert_renders()
        self.assertEqual(digest(self.out), whole)

    def test_finished_variants_are_skipped_without_their_scenes(self):
        self.assert_renders()
        whole = digest(self.out)

        def again(*arguments):
            result = self.assert_renders("--json", *arguments)
            self.assertEqual(digest(self.out), whole)
            return json.loads(result.stdout), result.stderr

        summary, stderr = again()
        self.assertEqual((summary["pings"], summary["skipped"], summary["complete"]), (0, 36, True))
        self.assertIn("all of its 36 pings were there already", stderr)
        self.assertNotIn("triangles", stderr, "no scene is read")
        (self.out / "variant_0002/fls/polar/000003.npy").unlink()
        shutil.rmtree(self.out / "variant_0004")
        summary, stderr = again()
        self.assertEqual((summary["pings"], summary["skipped"]), (7, 29))
        self.assertIn("7 pings rendered, 29 were there already", stderr)
        (self.out / "journal.d").mkdir()
        (self.out / "journal.d/1-of-1.txt").touch()  # of a run that was killed
        again()
        # An input with other bytes is not the same mission.
        self.edit("materials.csv", "2400", "2500")
        self.assert_refused(self.render(), "variant_0000", "other scene, material or trajectory files")
        self.assertEqual(digest(self.out), whole)

    def test_merge_and_verify(self):
        self.assert_renders()
        whole = digest(self.out)
        for k in (1, 2):
            self.assert_renders("--shard", f"{k}/2", "--out", f"part{k}")
        result = self.run_sonarsim("merge", "part1", "joined", "--json")
        self.assertIs(json.loads(result.stdout)["complete"], False, result.stderr)
        result = self.run_sonarsim("merge", "part1", "part2", "joined", "--json")
        self.assertIs(json.loads(result.stdout)["complete"], True, result.stderr)
        self.assertEqual(digest(self.folder / "joined"), whole)
        self.assertEqual(self.run_sonarsim("verify", "joined").returncode, 0)
        self.assert_renders("--out", "joined")
        self.assertEqual(digest(self.folder / "joined"), whole)
        (self.folder / "joined/variant_0003/fls/polar/000000.npy").write_bytes(b"spoilt")
        result = self.run_sonarsim("verify", "joined")
        self.assertEqual(result.returncode, 1)
        self.assertIn("variant_0003", result.stderr)

    def test_more_shards_than_variants(self):
        self.assert_renders("--set", "variants=2")
        parts = [f"part{k}" for k in (1, 2, 3)]
        for k, part in enumerate(parts, 1):
            self.assert_renders("--set", "variants=2", "--shard", f"{k}/3", "--out", part)
        result = self.run_sonarsim("merge", *parts, "joined")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(digest(self.folder / "joined"), digest(self.out))

    def test_variants_with_files_of_their_own_are_rendered(self):
        for name in ("one", "two"):
            self.write(f"{name}/box.gltf", (self.folder / "box.gltf").read_text())
        self.write("two/box.gltf", box_gltf((2.5, 1.5, 2.0)))
        self.edit("mission.yaml", "vary:\n", "vary:\n"
                  "  - {key: scene.file, choice: [one/box.gltf, two/box.gltf]}\n")
        for k in (1, 2):
            self.assert_renders("--shard", f"{k}/2")
        self.assertEqual(len({one["drawn"]["scene.file"] for one in self.index()}), 2)
        self.assertEqual(self.run_sonarsim("verify", "out").returncode, 0)

    def test_merge_into_variants_of_another_mission(self):
        self.assert_renders()
        self.assert_renders("--set", "sensors.fls.noise.mult_sigma=0.3", "--out", "other")
        self.assertEqual(self.run_sonarsim("merge", "out", "joined").returncode, 0)
        self.assert_refused(self.run_sonarsim("merge", "other", "joined"),
                            "holds variants of another mission")

    def test_a_variant_renders_alone(self):
        self.assert_renders()
        own = self.out / "variant_0004"
        result = self.run_sonarsim("render", own / "mission.resolved.yaml", "--paths-from", ".",
                                   "--out", "alone")
        self.assertEqual(result.returncode, 0, result.stderr)
        images = {k: v for k, v in digest(own).items() if k.endswith((".npy", ".png"))}
        alone = digest(self.folder / "alone")
        self.assertEqual({k: alone[k] for k in images}, images)

    def test_validate_counts(self):
        result = self.run_sonarsim("validate", "mission.yaml", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        reported = json.loads(result.stdout)
        self.assertEqual((reported["variants"], reported["pings"]), (6, 36))
        text = self.run_sonarsim("validate", "mission.yaml").stdout
        self.assertIn("variants    6\n", text)
        self.assertIn("36 pings", text)

    def test_another_mission_is_not_overwritten(self):
        self.assert_renders()
        self.assert_refused(self.render("--seed", "9"), "holds variants of another mission",
                            "--overwrite")
        self.write("other/thesis.txt", "years of work")
        self.assert_refused(self.render("--out", "other"), "not variants of a sonarsim mission")

    def test_validate_refuses_a_folder_as_render_does(self):
        self.assert_renders("--set", "variants=2")
        self.write("other/thesis.txt", "years of work")
        whole = digest(self.folder)
        for command in ("validate", "render"):
            self.assert_refused(self.run_sonarsim(command, "mission.yaml", "--set", "variants=3"),
                                "variants: 2 there, 3 here", "--overwrite")
            self.assert_refused(self.run_sonarsim(command, "mission.yaml", "--out", "other", "--overwrite"),
                                "not variants of a sonarsim mission")
            self.assertEqual(digest(self.folder), whole)
        for arguments in (("--set", "variants=2"), ("--set", "variants=3", "--overwrite"), ("--out", "new")):
            result = self.run_sonarsim("validate", "mission.yaml", *arguments)
            self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(digest(self.folder), whole)

    def test_bad_keys(self):
        for old, new, fragments in (
                ("noise.add_sigma", "noise.add_sgma",
                 ("mission.yaml:26:5", "add_sgma", "did you mean 'add_sigma'?")),
                ("uniform: [0.01, 0.2]", "uniform: [0.2, 0.01]",
                 ("mission.yaml:26:", "the first number must not be above the second")),
                ("uniform: [0.01, 0.2]", "uniform: [-2, -1]",
                 ("mission.yaml:26:5", "'add_sigma' must be at least 0")),
                ("uniform: [0.01, 0.2]", "log_uniform: [0, 1]",
                 ("mission.yaml:26:", "'log_uniform' takes numbers above 0")),
                (", uniform: [0.01, 0.2]", "", ("mission.yaml:26:5", "needs exactly one of: uniform")),
                ("sensors.fls.noise.add_sigma", "water.sound_speed_m_s",
                 ("mission.yaml:27:5", "'water.sound_speed_m_s' varies twice")),
                ("{key: sensors.fls.range_bins, whole: [40, 60]}",
                 "{key: sensors.fls.noise, choice: [{add_sigma: 0.1}]}",
                 ("mission.yaml:28:5", "'sensors.fls.noise' replaces what is drawn for "
                  "'sensors.fls.noise.add_sigma'", "write that rule after this one")),
                ("water.density_kg_m3, choice: [1000, 1025]", "seed, choice: [1, 2]",
                 ("mission.yaml:29:5", "'seed' cannot vary", "a seed of its own")),
                ("water.density_kg_m3, choice: [1000, 1025]", "vary.0.key, choice: [a]",
                 ("mission.yaml:29:5", "'vary.0.key' cannot vary: it says what varies")),
                ("sensors.fls.noise.add_sigma", "sensors.fls.mount.rpy_deg.1",
                 ("mission.yaml:26:5", "there is no list 'rpy_deg' with an item '1'",
                  "write the whole list in the mission first")),
                ("within: [1400, 1600]", "within: [9000, 9001]",
                 ("mission.yaml:27:5", "a thousand normal draws", "wider")),
                ("whole: [40, 60]", "uniform: [40, 60]",
                 ("mission.yaml:28:5", "'range_bins' must be a whole number"))):
            with self.subTest(new=new):
                mission = (self.folder / "mission.yaml").read_text()
                self.edit("mission.yaml", old, new)
                try:
                    self.refused(*fragments)
                finally:
                    self.write("mission.yaml", mission)

    def scatter(self, *lines):
        """Lets the mission scatter small boxes, and writes only the rules `lines`."""
        self.write("small.gltf", box_gltf(half=(0.1, 0.1, 0.1)))
        self.write("mission.yaml", MISSION.replace(
            "trajectory:", "  scatter:\n" + "".join(
                f"    - {{name: {name}, count: [0, 1], files: small.gltf, area_min_m: [-1.5, -1.5], "
                "area_max_m: [1.5, 1.5]}\n" for name in ("mine", "tyre", "drum")) + "trajectory:", 1)
            + "  labels: [class, instance]\nvariants: 8\n" + "\n".join(lines) + "\n")

    def test_classes_have_the_same_numbers(self):
        self.scatter("classes:", "  - {nodes: 'mine_*', class: threat}", "vary:",
                     "  - {key: scene.scatter.1.class, choice: [tyre, buoy]}")
        self.assert_renders()
        labels = [self.dataset(self.out / one["folder"])["labels"] for one in self.index()]
        self.assertGreater(len({len(one["instances"]) for one in labels}), 1, "counts must differ")
        names = [[one["name"] for one in variant["classes"]] for variant in labels]
        self.assertEqual(names, [["walls", "threat", "tyre", "drum", "buoy"]] * 8)
        self.edit("mission.yaml", "classes:", "classes:\n  - {nodes: 'boat_*', class: boat}")
        shutil.rmtree(self.out)
        self.refused("mission.yaml:", "no node of the scene fits 'boat_*'")

    def test_a_variant_without_room_is_found_before_the_first(self):
        self.scatter("vary:", "  - {key: scene.scatter.2.spacing_m, choice: [0, 3]}",
                     "  - {key: scene.scatter.2.count, choice: [2]}")
        self.refused("finds no room in 1000 tries", "the bottom lies from (-2, -2) to (2, 2)")

    def test_validate_estimates_all_variants(self):
        result = self.run_sonarsim("validate", "mission.yaml", "--json")
        found = json.loads(result.stdout)
        self.assertEqual((found["pings"], found["images"]), (36, 36), "a ping is one image")
        self.assertGreater(found["set_up_seconds"], 0)
        self.assert_renders()
        blocks = [path.stat().st_blocks for path in [self.out, *self.out.rglob("*")]]
        self.assertLessEqual(512 * sum(blocks), found["bytes_at_most"])

    def test_vary_without_variants(self):
        self.edit("mission.yaml", "variants: 6\n", "")
        self.refused("mission.yaml:", "'vary' needs 'variants'")

    def test_report_takes_one_scene(self):
        self.assert_refused(self.run_sonarsim("report", "mission.yaml", "--quick"),
                            "this mission has variants")


if __name__ == "__main__":
    unittest.main()
