"""sonarsim merge, and the render that completes what it copied: the dataset of a single run, to the byte."""
import json
import shutil
import unittest

from sandbox import Sandbox, digest, path_csv
from test_faults import MISSION


class Merge(Sandbox):
    def setUp(self):
        super().setUp()
        self.write("mission.yaml", MISSION)
        self.write("path.csv", path_csv(5))
        self.assert_renders()
        self.whole = digest(self.out)
        shutil.rmtree(self.out)
        for k in "123":
            self.assert_renders("--shard", f"{k}/3", "--out", f"part{k}", "-j" + k)

    def merge(self, *folders):
        return self.run_sonarsim("merge", *folders)

    def assert_merges(self, *folders, rendered=0):
        """The parts stay as they are, and `rendered` pings are in none of them."""
        before = [digest(self.folder / part) for part in folders[:-1]]
        result = self.merge(*folders, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual([digest(self.folder / part) for part in folders[:-1]], before)
        merged = json.loads(result.stdout)
        self.assertEqual((merged["missing"], merged["pings"] + merged["skipped"]), (rendered, 20 - rendered))
        completed = json.loads(self.assert_renders("--out", folders[-1], "--json").stdout)
        self.assertEqual((completed["pings"], completed["complete"]), (rendered, True))
        self.assertEqual(digest(self.folder / folders[-1]), self.whole)
        self.assertEqual(self.run_sonarsim("verify", folders[-1]).returncode, 0)
        return merged

    def test_in_any_order_without_the_inputs(self):
        for name in ("box.gltf", "path.csv"):
            (self.folder / name).rename(self.folder / f"away.{name}")
        for order in (("part1", "part2", "part3"), ("part3", "part1", "part2")):
            self.assertEqual(self.merge(*order, "-".join(order)).returncode, 0)
        for name in ("box.gltf", "path.csv"):
            (self.folder / f"away.{name}").rename(self.folder / name)
        for order in (("part1", "part2", "part3"), ("part3", "part1", "part2")):
            self.assertEqual(self.assert_merges(*order, "-".join(order))["pings"], 0)

    def test_again_and_what_overlaps(self):
        self.assert_merges("part1", "part2", "part3", "all")
        self.assertIs(self.assert_merges("part1", "part2", "all")["complete"], True)
        self.assertIs(self.assert_merges("part1", "all", "part1", "copy")["complete"], True)

    def test_an_unfinished_merge_goes_on(self):
        shutil.copytree(self.folder / "part1", self.folder / "all")
        self.assertEqual(self.assert_merges("part2", "part3", "all")["pings"], 13)

    def test_render_renders_what_is_missing(self):
        self.assert_merges("part1", "part3", "two", rendered=7)
        # Another size than the journal lists, and a record that is not as the journal lists it.
        next((self.folder / "part2/fls/fan").iterdir()).write_bytes(b"")
        path = self.folder / "part2/sss/waterfall.npy"
        data = path.read_bytes()
        path.write_bytes(data[:128] + bytes(len(data) - 128))
        self.assertEqual(self.merge("part1", "part2", "part3", "all").returncode, 0)
        self.assertGreater(json.loads(self.assert_renders("--out", "all", "--json").stdout)["pings"], 0)
        self.assertEqual(digest(self.folder / "all"), self.whole)

    def test_damage_on_the_way_is_found_by_verify(self):
        path = next((self.folder / "part2/fls/polar").iterdir())
        data = path.read_bytes()
        path.write_bytes(data[:-1] + bytes([data[-1] ^ 1]))
        self.assertEqual(self.merge("part1", "part2", "part3", "all").returncode, 0)
        self.assert_renders("--out", "all")
        result = self.run_sonarsim("verify", "all")
        self.assertEqual(result.returncode, 1)
        self.assertIn(f"fls/polar/{path.name}: its bytes differ", result.stderr)

    def test_foreign_parts(self):
        self.assert_renders("--shard", "2/3", "--out", "seed", "--seed", "8")
        self.assert_refused(self.merge("part1", "seed", "part3", "all"), "seed", "another mission")
        self.write("path.csv", path_csv(6))
        self.assert_renders("--shard", "2/3", "--out", "poses")
        self.assert_refused(self.merge("part1", "poses", "part3", "all"), "poses",
                            "other scene, material or trajectory files")
        for old, new, words in (('"program_version": "', '"program_version": "0', "another version"),
                                ('"arithmetic": "', '"arithmetic": "x', "a build")):
            with self.subTest(words=words):
                shutil.copytree(self.folder / "part2", self.folder / "other")
                self.edit("other/dataset.json", old, new)
                self.assert_refused(self.merge("part1", "other", "part3", "all"), "other", words)
                shutil.rmtree(self.folder / "other")
        self.assertFalse((self.folder / "all").exists())

    def test_nothing_outside_is_touched(self):
        self.write("victim/file", "mine")
        self.assertEqual(self.merge("part1", "all").returncode, 0)
        shutil.rmtree(self.folder / "all/fls")
        (self.folder / "all/fls").symlink_to(self.folder / "victim")
        self.assert_refused(self.merge("part2", "all"), "is a symbolic link")
        (self.folder / "all/fls").unlink()
        waterfall = self.folder / "all/sss/waterfall.npy"
        waterfall.unlink()
        waterfall.symlink_to(self.folder / "victim/file")
        self.assert_refused(self.merge("part3", "all"), "waterfall.npy", "is a symbolic link")
        self.assertEqual([p.name for p in (self.folder / "victim").iterdir()], ["file"])
        self.assertEqual((self.folder / "victim/file").read_text(), "mine")

    def test_mistakes(self):
        self.assert_refused(self.merge("part1", "part2", "part3", "part1"), "part1", "one of the parts")
        self.assert_refused(self.merge("part1", "none", "all"), "none", "there is no such folder")
        self.write("taken/thesis.txt", "years of work")
        self.assert_refused(self.merge("part1", "part2", "part3", "taken"), "taken", "not a sonarsim dataset")
        self.assertEqual(self.merge("part1").returncode, 2)
        shutil.rmtree(self.folder / "part2/sss")
        result = self.merge("part1", "part2", "part3", "all")
        self.assertEqual(result.returncode, 1)
        self.assertIn("part2/sss/", result.stderr)


if __name__ == "__main__":
    unittest.main()
