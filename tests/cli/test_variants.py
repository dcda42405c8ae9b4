"""Variants of a mission, and what `vary` draws for every ping: draws, seeds, shards, resume, and what is refused."""
import json
import math
import shutil

from sandbox import MISSION, Sandbox, box_gltf, digest

VARY = """
variants: 6
vary:
  - {key: sensors.fls.noise.add_sigma, uniform: [0.01, 0.2]}
  - {key: water.sound_speed_m_s, normal: [1490, 20], within: [1400, 1600]}
  - {key: sensors.fls.range_bins, whole: [40, 60]}
  - {key: water.density_kg_m3, choice: [1000, 1025], per: dataset}
"""
PER_PING = """
vary:
  - {key: sensors.fls.noise.add_sigma, log_uniform: [0.001, 0.2], per: ping}
  - {key: sensors.fls.mount.rpy_deg.2, normal: [0, 3], within: [-6, 6], per: ping}
  - {key: vehicle.offset_m.2, uniform: [-0.2, 0.2], per: ping}
  - {key: vehicle.turn_deg.0, choice: [-5, 5], per: ping}
"""
TWO = ("--set", "variants=2")
# The rules, a text of the mission, what it becomes, and words of the message.
WRONG = ((VARY, "noise.add_sigma", "noise.add_sgma", "mission.yaml:26:5", "add_sgma", "did you mean 'add_sigma'?"),
    (VARY, "uniform: [0.01, 0.2]", "uniform: [0.2, 0.01]", "mission.yaml:26:", "the first number must not be above the second"),
    (VARY, "uniform: [0.01, 0.2]", "uniform: [-2, -1]", "mission.yaml:26:5", "'add_sigma' must be at least 0"),
    (VARY, "uniform: [0.01, 0.2]", "log_uniform: [0, 1]", "mission.yaml:26:", "'log_uniform' takes numbers above 0"),
    (VARY, ", uniform: [0.01, 0.2]", "", "mission.yaml:26:5", "needs exactly one of: uniform"),
    (VARY, "sensors.fls.noise.add_sigma", "water.sound_speed_m_s", "mission.yaml:27:5", "'water.sound_speed_m_s' varies twice"),
    (VARY, "{key: sensors.fls.range_bins, whole: [40, 60]}", "{key: sensors.fls.noise, choice: [{add_sigma: 0.1}]}",
     "mission.yaml:28:5", "'sensors.fls.noise' replaces what is drawn for 'sensors.fls.noise.add_sigma'",
     "write that rule after this one"), (VARY, "water.density_kg_m3, choice: [1000, 1025]", "seed, choice: [1, 2]",
     "mission.yaml:29:5", "'seed' cannot vary", "a seed of its own"),
    (VARY, "sensors.fls.noise.add_sigma", "sensors.fls.mount.rpy_deg.1", "mission.yaml:26:5",
     "there is no list 'rpy_deg' with an item '1'", "write the whole list in the mission first"),
    (VARY, "within: [1400, 1600]", "within: [9000, 9001]", "mission.yaml:27:5", "a thousand normal draws", "wider"),
    (VARY, "whole: [40, 60]", "uniform: [40, 60]", "mission.yaml:28:5", "'range_bins' must be a whole number"),
    (VARY, "variants: 6\n", "", "mission.yaml:", "'vary' needs 'variants'"),
    (PER_PING, "noise.add_sigma", "range_bins", "mission.yaml:25:5",
     "'sensors.fls.range_bins' cannot be drawn for every ping", "noise.add_sigma", "vehicle.offset_m.0"),
    (PER_PING, "log_uniform: [0.001, 0.2]", "uniform: [-0.1, 0.2]", "mission.yaml:25:5",
     "'sensors.fls.noise.add_sigma' must be at least 0, not -0.1"), (PER_PING, "within: [-6, 6]", "within: [40, 41]",
     "mission.yaml:26:5", "less than 5 % of the normal draws", "make it wider"),
    (PER_PING, "within: [-6, 6], ", "", "mission.yaml:26:", "a normal draw for every ping needs 'within'"),
    (PER_PING, "choice: [-5, 5]", "choice: [left, 5]", "mission.yaml:28:5", "takes numbers"),
    (PER_PING, "    kind: imaging\n", "    kind: imaging\n    moves_in_ping: true\n", "moves_in_ping"))


class Variants(Sandbox):
    FILES = {"mission.yaml": MISSION + VARY}

    def test_all_differ_and_come_again(self):
        self.assert_renders()
        index = self.variants()
        self.assertEqual([one["folder"] for one in index], [f"variant_{k:04}" for k in range(6)])
        self.assertEqual(len({one["seed"] for one in index}), 6)
        self.assertEqual(len({one["drawn"]["sensors.fls.noise.add_sigma"] for one in index}), 6)
        self.assertEqual(len({one["drawn"]["water.density_kg_m3"] for one in index}), 1)
        self.assertEqual(len({(self.out / one["folder"] / "fls/polar/000000.npy").read_bytes() for one in index}), 6)
        for one in index:
            dataset = self.dataset(self.out / one["folder"])
            self.assertEqual((dataset["complete"], dataset["seed"], dataset["variant"]["drawn"]), (True, one["seed"], one["drawn"]))
            self.assertEqual(len(dataset["sensors"][0]["range_edges_m"]) - 1, one["drawn"]["sensors.fls.range_bins"])
            self.assertEqual(self.json(f"out/{one['folder']}/fls/meta/000001.json")["variant"]["drawn"], one["drawn"])
        self.assert_renders("--set", "sensors.fls.noise.add_sigma=0.5", "--out", "fixed")
        others = [{key: value for key, value in one["drawn"].items() if not key.endswith("add_sigma")} for one in index]
        self.assertEqual([one["drawn"] for one in self.variants("fixed")], others)
        # One alone, and fewer of them.
        again = ("render", "out/variant_0004/mission.resolved.yaml", "--paths-from", ".", "--out")
        self.assert_refused(self.run_sonarsim(*again, "out/variant_0004"), "that is a variant of a mission")
        self.succeeds(*again, "alone")
        self.assertEqual(digest(self.folder / "alone/fls/polar"), digest(self.out / "variant_0004/fls/polar"))
        self.assert_renders("--overwrite", "--set", "variants=3")
        self.assertEqual(self.variants(), index[:3])
        self.assertFalse((self.out / "variant_0003").exists())
        self.assert_renders("--overwrite", "--set", "variants=2", "--seed", "8")
        self.assertNotEqual(self.variants()[1]["drawn"], index[1]["drawn"])

    def test_rules_of_a_file_vary_the_sensor_that_is_named(self):
        own = "vary:\n  - {key: sensors.fls.noise.add_sigma"
        self.edit("mission.yaml", own, own.replace("vary:\n", "vary:\n  - {preset: rules.yaml, sensor: fls}\n"))
        self.refused("mission.yaml:", "there is no preset", "randomised/NAME.yaml")
        self.write("rules.yaml", "noise: 3\n")
        self.refused("rules.yaml:", "a list of rules")
        self.write("rules.yaml", "- {key: noise.mult_sigma, uniform: [0.2, 0.3]}\n" "- {key: noise.add_sigma, uniform: [3, 4]}\n")
        self.edit("mission.yaml", ", sensor: fls}", ", per: ping}")
        self.refused("mission.yaml:", "takes the key 'sensor'")
        self.edit("mission.yaml", "rules.yaml, per: ping}", "rules.yaml, sensor: fls}\n  - {preset: sea.yaml}")
        self.write("sea.yaml", "- {key: water.temperature_c, scale: [0.5, 2]}\n"
                               "- {key: water.scattering_db_per_m3, scale: [0.5, 2]}\n")
        self.refused("sea.yaml:2", "'scale' needs a number to multiply")
        self.edit("sea.yaml", "- {key: water.scattering_db_per_m3, scale: [0.5, 2]}\n", "")
        self.assert_renders()
        for one in self.variants():
            self.assertTrue(0.2 <= one["drawn"]["sensors.fls.noise.mult_sigma"] <= 0.3)
            self.assertTrue(0.01 <= one["drawn"]["sensors.fls.noise.add_sigma"] <= 0.2)  # the mission's own rule
            self.assertTrue(5 <= one["drawn"]["water.temperature_c"] <= 20)  # the default is 10

    def test_finished_variants_are_skipped_without_their_scenes(self):
        for shard in ("2/3", "1/3", "3/3"):
            self.assert_renders("--shard", shard)
        whole = digest(self.out)

        def again(*counts):
            result = self.assert_renders("--json")
            self.assertEqual(digest(self.out), whole)
            summary = json.loads(result.stdout)
            self.assertEqual((summary["pings"], summary["skipped"], summary["complete"]), (*counts, True))
            return result.stderr

        stderr = again(0, 36)
        self.assertIn("all of its 36 pings were there already", stderr)
        self.assertNotIn("triangles", stderr, "no scene is read")
        (self.out / "variant_0002/fls/polar/000003.npy").unlink()
        shutil.rmtree(self.out / "variant_0004")
        self.assertIn("7 pings rendered, 29 were there already", again(7, 29))
        (self.out / "journal.d").mkdir()
        (self.out / "journal.d/1-of-1.txt").touch()  # of a run that was killed
        again(0, 36)
        # An input with other bytes is not the same mission.
        self.edit("materials.csv", "2400", "2500")
        self.assert_refused(self.render(), "variant_0000", "other scene, material or trajectory files")
        self.assertEqual(digest(self.out), whole)

    def test_more_variants_are_added(self):
        self.assert_renders("--out", "whole")
        for some in (2, 4):
            self.assert_renders("--set", f"variants={some}")
            self.assertEqual(self.variants(), self.variants("whole")[:some])
        for shard in ("2/5", "5/5", "1/5"):  # none, one, and one of two is new
            result = self.assert_renders("--shard", shard, "--json")
            self.assertEqual(len(self.variants()), 6)
        self.assertEqual([json.loads(result.stdout)[key] for key in ("pings", "skipped", "complete")], [6, 6, True])
        self.assertEqual(digest(self.out), digest(self.folder / "whole"))

    def test_merge(self):
        self.assert_renders(*TWO)
        self.assert_shards_agree(*TWO, count=3)
        shutil.rmtree(self.out / "variant_0001")
        self.assertRegex(self.succeeds("merge", "out", "half").stderr, " [1-9][0-9]* are missing")
        self.assert_renders(*TWO, "--set", "sensors.fls.noise.mult_sigma=0.3", "--out", "other")
        self.assert_refused(self.run_sonarsim("merge", "other", "merged"), "holds variants of another mission")

    def test_merge_with_a_missing_file(self):
        for part in ("part1", "part2"):
            self.assert_renders(*TWO, "--out", part)
        for name in ("fls/polar/000001.npy", "SHA256SUMS", "mission.resolved.yaml"):
            path = self.folder / "part1/variant_0001" / name
            path.rename(self.folder / "away")
            self.assert_refused(self.run_sonarsim("merge", "part1", "part2", "merged"), "part1/variant_0001", name.split("/")[-1])
            (self.folder / "away").rename(path)
            shutil.rmtree(self.folder / "merged")
        (self.folder / "part1/variant_0001").rename(self.folder / "away")
        (self.folder / "part1/variant_0001").symlink_to(self.folder / "away")
        self.assert_refused(self.run_sonarsim("merge", "part1", "part2", "merged"), "variant_0001: is a symbolic link")

    def test_what_a_kill_left(self):
        """verify names it; resume, --overwrite and merge remove it; what is not sonarsim's stays."""
        self.assert_renders(*TWO)
        whole = digest(self.out)
        left = [f"out/{name}.0123456789abcdef.part" for name in (".variants.json", "..variants.json.0123456789abcdef.part",
                                                                 "variant_0000/.dataset.json", "variant_0001/fls/polar/.x")]
        for name in (*left, "out/mine.part"):
            self.write(name, "half")
        unknown = sorted(name.removeprefix("out/") for name in (*left, "out/mine.part"))
        self.assertEqual(self.reported("verify", "out")["unknown_files"], unknown)
        (self.out / "mine.part").unlink()
        for more in ((), ("--shard", "1/2"), ("--overwrite",), "merge"):
            with self.subTest(more=more):
                for name in left:
                    self.write(name, "half")
                self.succeeds("merge", "part", "out") if more == "merge" else self.assert_renders(*TWO, *more)
                kept = [left[3]] if "--shard" in more else []    # the other shard's
                self.assertEqual([str(p.relative_to(self.folder)) for p in self.out.rglob("*.part")], kept)
                if "--overwrite" in more:
                    shutil.copytree(self.out, self.folder / "part")
        self.assertEqual(digest(self.out), whole)

    def test_overwrite_over_a_link(self):
        self.write("victim/1-of-1.txt", "mine")
        self.assert_renders("--set", "variants=2")
        shutil.copy(self.out / "variant_0000/dataset.json", self.folder / "victim")
        victim = digest(self.folder / "victim")
        for name, target in (("journal.d", "victim"), ("variant_0001/journal.d", "victim"),
                             ("journal.d/1-of-1.txt", "victim/1-of-1.txt"), ("variant_0000", "victim")):
            link = self.out / name
            link.parent.mkdir(exist_ok=True)
            shutil.rmtree(link, ignore_errors=True)
            link.symlink_to(self.folder / target)
            with self.subTest(name=name):
                self.assert_refused(self.render("--set", "variants=2", "--overwrite"), name, "is a symbolic link")
                self.assertEqual(digest(self.folder / "victim"), victim)
            link.unlink()

    def test_what_is_refused(self):
        for rules, old, new, *words in WRONG:
            with self.subTest(new=new):
                self.write("mission.yaml", MISSION + rules)
                self.edit("mission.yaml", old, new)
                self.refused(*words)

    def test_variants_with_files_of_their_own_are_rendered(self):
        self.write("one/box.gltf", box_gltf())
        self.write("two/box.gltf", box_gltf((2.5, 1.5, 2.0)))
        self.edit("mission.yaml", "vary:\n", "vary:\n" "  - {key: scene.file, choice: [one/box.gltf, two/box.gltf]}\n")
        for k in (1, 2):
            self.assert_renders("--shard", f"{k}/2")
        self.assertEqual(len({one["drawn"]["scene.file"] for one in self.variants()}), 2)
        self.succeeds("verify", "out")

    def test_validate_counts(self):
        found = self.reported("validate", "mission.yaml")
        self.assertEqual((found["variants"], found["pings"], found["images"]), (6, 36, 36))
        self.assert_has(self.succeeds("validate", "mission.yaml").stdout, "variants    6\n", "surveyed    variant_0000:\n",
                        "together    6 variants:\n", "36 pings\n")

    def test_validate_refuses_a_folder_as_render_does(self):
        self.assert_renders("--set", "variants=2")
        self.write("other/thesis.txt", "years of work")
        whole = digest(self.folder)
        for command in ("validate", "render"):
            for arguments, *words in ((("--set", "variants=1"), "of another mission, number", "--overwrite"),
                                      (("--set", "variants=2", "--seed", "9"), "holds variants of another mission"),
                                      (("--out", "other", "--overwrite"), "not variants of a sonarsim mission")):
                self.assert_refused(self.run_sonarsim(command, "mission.yaml", *arguments), *words)
        self.succeeds("validate", "mission.yaml", "--set", "variants=3")
        self.succeeds("validate", "mission.yaml", "--set", "variants=1", "--overwrite")
        self.assertEqual(digest(self.folder), whole)

    def scatter(self, *lines):
        """Lets the mission scatter small boxes, and writes only the rules `lines`."""
        self.write("small.gltf", box_gltf(half=(0.1, 0.1, 0.1)))
        scattered = "".join(f"    - {{name: {name}, count: [0, 1], files: small.gltf, area_min_m: [-1.5, -1.5], "
                            "area_max_m: [1.5, 1.5]}\n" for name in ("mine", "tyre", "drum"))
        self.write("mission.yaml", MISSION.replace("trajectory:", f"  scatter:\n{scattered}trajectory:", 1) +
                   "\n".join(("  labels: [class, instance]\nvariants: 8", *lines, "")))

    def test_classes_have_the_same_numbers(self):
        self.scatter("classes:", "  - {nodes: 'mine_*', class: threat}", "vary:",
                     "  - {key: scene.scatter.1.class, choice: [tyre, buoy]}")
        self.assert_renders()
        labels = [self.dataset(self.out / one["folder"])["labels"] for one in self.variants()]
        self.assertGreater(len({len(one["instances"]) for one in labels}), 1, "counts must differ")
        names = [[one["name"] for one in variant["classes"]] for variant in labels]
        self.assertEqual(names, [["walls", "threat", "tyre", "drum", "buoy"]] * 8)

    def test_a_variant_without_room_is_found_before_the_first(self):
        self.scatter("vary:", "  - {key: scene.scatter.2.spacing_m, choice: [0, 3]}", "  - {key: scene.scatter.2.count, choice: [2]}")
        self.refused("finds no room in 1000 tries", "the bottom lies from (-2, -2) to (2, 2)")


class PingDraws(Sandbox):
    KEYS = ["vehicle.offset_m.2", "vehicle.turn_deg.0", "sensors.fls.noise.add_sigma", "sensors.fls.mount.rpy_deg.2"]

    def test_every_ping_has_draws_of_its_own(self):
        self.add(PER_PING)
        self.assert_renders("-j", "1")
        metas = [self.meta(ping) for ping in range(6)]
        self.assertTrue(all(list(meta["drawn"]) == self.KEYS for meta in metas))
        for key in self.KEYS[:1] + self.KEYS[2:]:
            self.assertEqual(len({meta["drawn"][key] for meta in metas}), len(metas), key)
        for meta in metas:
            self.assertTrue(0.001 <= meta["drawn"][self.KEYS[2]] <= 0.2)
            # The path lies in the plane z = 0, and the sonar in the middle of the vehicle.
            self.assertEqual(meta["T_world_vehicle"]["position_m"][2], meta["drawn"][self.KEYS[0]])
            # The scalar product of two attitudes that are turned by a is cos(a / 2).
            vehicle, sensor = (meta[f"T_world_{what}"]["quaternion_xyzw"] for what in ("vehicle", "sensor"))
            angle = 2 * math.degrees(math.acos(min(1.0, abs(sum(a * b for a, b in zip(vehicle, sensor))))))
            self.assertAlmostEqual(angle, abs(meta["drawn"][self.KEYS[3]]), places=4)
        self.assert_renders("--set", f"{self.KEYS[2]}=0.125", "--out", "fixed")
        self.assertEqual(self.json("fixed/fls/meta/000003.json")["drawn"], metas[3]["drawn"] | {self.KEYS[2]: 0.125})
        # Shards, and the dataset's own mission; tests/golden has any number of threads.
        self.assert_shards_agree()
        self.succeeds("render", "out/mission.resolved.yaml", "--paths-from", ".", "--out", "again")
        self.assertEqual(digest(self.folder / "again/fls"), digest(self.out / "fls"))
        self.assert_renders("--overwrite", "--seed", "8")
        self.assertNotEqual(self.meta(0)["drawn"], metas[0]["drawn"])

    def test_a_drawn_mount_moves_as_a_fixed_one(self):
        moving = ("--set", "sensors.fls.moves_in_ping=true")
        self.assert_renders(*moving, "--set", "sensors.fls.mount.rpy_deg=[0, 0, 70]", "--out", "fixed")
        self.add("\nvary:\n  - {key: sensors.fls.mount.rpy_deg.2, choice: [70, 70], per: ping}\n")
        self.assert_renders(*moving, "--out", "drawn")
        self.assertEqual(*(digest(self.folder / out / "fls/polar") for out in ("fixed", "drawn")))
