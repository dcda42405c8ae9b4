"""sonarsim merge: shards from several folders become the dataset of a single run, to the byte."""
import itertools
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

    def assert_merges(self, *folders):
        before = [digest(self.folder / part) for part in folders[:-1]]
        result = self.merge(*folders)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(digest(self.folder / folders[-1]), self.whole)
        self.assertEqual([digest(self.folder / part) for part in folders[:-1]], before)

    def test_in_any_order_without_the_inputs(self):
        for name in ("mission.yaml", "box.gltf", "materials.csv", "path.csv"):
            (self.folder / name).unlink()
        for order in itertools.permutations(("part1", "part2", "part3")):
            with self.subTest(order=order):
                self.assert_merges(*order, "-".join(order))
        result = self.run_sonarsim("verify", "part3-part1-part2")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_soundings_where_sound_bends(self):
        bent = ("--set", "sensors={mbes: {kind: profiling, azimuth_deg: 90, range_max_m: 4, range_bins: 100, "
                "azimuth_bins: 8}}", "--set", "scene.water_surface={height_m: 5}",
                "--set", "water.profile={points: [{depth_m: 0, sound_speed_m_s: 1500}]}")
        self.assert_renders(*bent, "--out", "bent")
        for k in "12":
            self.assert_renders(*bent, "--shard", f"{k}/2", "--out", f"bent{k}")
        result = self.merge("bent1", "bent2", "both")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(digest(self.folder / "both"), digest(self.folder / "bent"))

    def test_temporary_files_of_a_killed_merge_go(self):
        self.assert_merges("part1", "part2", "part3", "all")
        ping = self.folder / "all/fls/polar/000003.npy"
        ping.rename(ping.with_name(".000003.npy.0123456789abcdef.part"))
        self.assert_merges("part1", "part2", "part3", "all")

    def test_again_and_what_overlaps(self):
        self.assert_merges("part1", "part2", "part3", "all")
        result = self.run_sonarsim("merge", "part1", "part2", "part3", "all", "--json")
        self.assertEqual(json.loads(result.stdout)["pings"], 0)
        self.assert_merges("all", "copy")
        self.assert_merges("part1", "all", "part1", "twice")
        self.assert_renders("--out", "all")  # and render finds nothing to do
        self.assertEqual(digest(self.folder / "all"), self.whole)

    def test_an_unfinished_merge_goes_on(self):
        shutil.copytree(self.folder / "part1", self.folder / "all")
        self.assert_merges("part1", "part2", "part3", "all")

    def test_missing_part(self):
        result = self.merge("part1", "part3", "all")
        # 20 pings; part 2 has those with the index 1, 4, ..., 19.
        self.assert_refused(result, "7 of 20 pings", "--shard 2/3", "ping 0 of sensor 'mbes'")
        self.assertFalse((self.folder / "all").exists())
        (self.folder / "part2/fls/fan/000001.png").unlink()
        result = self.merge("part1", "part2", "part3", "all")
        self.assertFalse((self.folder / "all").exists())
        self.assert_refused(result, "1 of 20 pings", "sensor 'fls'")

    def test_the_depth_of_a_folder_is_no_matter(self):
        """Paths of the mission start at the scene, which may lie deeper than the parts and far from the
        trajectory: a path of many '..' from a part that lies near the root."""
        deep = "a/b/c/d/e/f/g/h/i/j"
        for name in ("box.gltf", "materials.csv"):
            self.write(f"{deep}/{name}", (self.folder / name).read_text())
        scene = ("--set", f"scene.file={deep}/box.gltf", "--set", f"scene.materials={deep}/materials.csv")
        self.assert_renders(*scene, "--out", "single")
        self.assertIn("../../../../../../../../../../path.csv",
                      (self.folder / "single/mission.resolved.yaml").read_text())
        parts = ("one", "x/y/z/two", "a/b/c/d/e/f/g/h/i/j/k/l/three")
        for k, part in enumerate(parts, 1):
            self.assert_renders(*scene, "--shard", f"{k}/3", "--out", part)
        whole = digest(self.folder / "single")
        for order in itertools.permutations(parts):
            with self.subTest(order=order):
                result = self.merge(*order, "all")
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual(digest(self.folder / "all"), whole)
                shutil.rmtree(self.folder / "all")

    def test_times_far_from_zero(self):
        """What is written as trajectory.tum is read again by merge."""
        for start in (1.7e9, 1e10 + 1, 9e11, -9e11):
            with self.subTest(start=start):
                rows = path_csv(3).splitlines()
                moved = [rows[0]] + [f"{start + k}," + row.split(",", 1)[1] for k, row in enumerate(rows[1:])]
                self.write("path.csv", "\n".join(moved) + "\n")
                self.assert_renders("--out", "single")
                self.assertEqual(self.merge("single", "all").returncode, 0)
                self.assertEqual(digest(self.folder / "all"), digest(self.folder / "single"))
                for name in ("single", "all"):
                    shutil.rmtree(self.folder / name)
        # A survey so slow that it would end beyond what is read is refused before it is rendered.
        mission = (self.folder / "mission.yaml").read_text()
        slow = ("trajectory: {waypoints: [{position_m: [0, 0, 0]}, {position_m: [1, 0, 0]}], "
                "speed_m_s: 1e-13, rate_hz: 2e-13}")
        lines = mission.splitlines()
        at = next(k for k, line in enumerate(lines) if line.startswith("trajectory:"))
        rest = next((k for k in range(at + 1, len(lines)) if not lines[k].startswith(" ")), len(lines))
        self.write("mission.yaml", "\n".join([*lines[:at], slow, *lines[rest:]]) + "\n")
        self.assert_refused(self.render("--out", "slow"), "trajectory", "speed_m_s")
        self.assertFalse((self.folder / "slow").exists())

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

    def test_damage_on_the_way(self):
        path = next((self.folder / "part2/fls/polar").iterdir())
        data = path.read_bytes()
        path.write_bytes(data[:-1] + bytes([data[-1] ^ 1]))
        result = self.merge("part1", "part2", "part3", "all")
        self.assert_refused(result, str(path.relative_to(self.folder)), "copy the part again")
        self.assertIs(self.dataset(self.folder / "all")["complete"], False)
        path.write_bytes(data)
        self.assert_merges("part1", "part2", "part3", "all")

    def test_damaged_record(self):
        """What is not the record that the journal tells counts as missing."""
        path = self.folder / "part2/sss/waterfall.npy"
        data = bytearray(path.read_bytes())
        for k in range(128, len(data)):
            data[k] ^= 1
        path.write_bytes(data)
        self.assert_refused(self.merge("part1", "part2", "part3", "all"), "sensor 'sss'")

    def test_mistakes(self):
        self.assert_refused(self.merge("part1", "part2", "part3", "part1"), "part1",
                            "one of the parts")
        self.assert_refused(self.merge("part1", "none", "all"), "none", "there is no such folder")
        self.write("taken/thesis.txt", "years of work")
        self.assert_refused(self.merge("part1", "part2", "part3", "taken"), "taken",
                            "no sonarsim dataset")
        self.assertEqual(self.merge("part1").returncode, 2)
        shutil.rmtree(self.folder / "part2/sss")
        self.assertEqual(self.merge("part1", "part2", "part3", "all").returncode, 1)


if __name__ == "__main__":
    unittest.main()
