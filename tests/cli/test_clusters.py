"""Shards by a Slurm array, with its merge, and by GNU parallel: the bytes of a single run."""
import os
import pathlib
import shutil
import subprocess
import unittest

import slurm_node
from sandbox import SONARSIM, Sandbox, digest, path_csv
from test_faults import MISSION

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"


class Clusters(Sandbox):
    def setUp(self):
        super().setUp()
        self.write("mission.yaml", MISSION)
        self.write("path.csv", path_csv(5))
        self.assert_renders()
        self.whole = digest(self.out)
        shutil.rmtree(self.out)

    def in_array(self, task, count, first=1, last=None, **more):
        return dict(os.environ, SLURM_ARRAY_TASK_ID=str(task), SLURM_ARRAY_TASK_COUNT=str(count),
                    SLURM_ARRAY_TASK_MIN=str(first),
                    SLURM_ARRAY_TASK_MAX=str(count if last is None else last), **more)

    def test_shards_by_the_task_of_an_array(self):
        for tasks in ({1: 1, 2: 2, 3: 3}, {0: 1, 1: 2, 2: 3}, {4: 1, 6: 2, 8: 3}):
            shutil.rmtree(self.out, ignore_errors=True)
            for task, shard in tasks.items():
                result = self.assert_renders(env=self.in_array(task, 3, min(tasks), max(tasks)))
                self.assertIn(f"--shard {shard}/3", result.stderr)
            self.assertEqual(digest(self.out), self.whole)

    def test_the_command_line_counts_first(self):
        self.assert_renders("--shard", "1/1", env=self.in_array(2, 3))
        self.assertEqual(digest(self.out), self.whole)

    def test_an_array_that_is_no_row(self):
        result = self.render(env=self.in_array(3, 3, 1, 7))
        self.assert_refused(result, "task 3 of a Slurm array", "--array=1-N", "--shard I/N")
        self.assertFalse(self.out.exists())

    @unittest.skipIf(shutil.which("parallel") is None, "needs GNU parallel")
    def test_gnu_parallel(self):
        for where, parts in (("out", []), ("part{}", ["part1", "part2", "part3"])):
            subprocess.run(["parallel", "-j2", SONARSIM, "render", "mission.yaml", "--quiet",
                            "--threads", "1", "--shard", "{}/3", "--out", where, ":::", "1", "2", "3"],
                           cwd=self.folder, check=True, timeout=120,
                           env=dict(os.environ, HOME=str(self.folder)))
            if parts:
                result = self.run_sonarsim("merge", *parts, "merged")
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assert_renders("--out", "merged")
        self.assertEqual(digest(self.out), self.whole)
        self.assertEqual(digest(self.folder / "merged"), self.whole)

    @unittest.skipIf(slurm_node.missing(), slurm_node.missing())
    def test_a_real_slurm(self):
        node = self.folder / "slurm"
        node.mkdir()
        with slurm_node.one_node(node) as environment:
            environment["SONARSIM"] = SONARSIM

            def submit(*arguments):
                result = subprocess.run(
                    [SCRIPTS / "slurm/render.sh", *arguments], cwd=self.folder, env=environment,
                    capture_output=True, text=True, timeout=60, check=False)
                self.assertEqual(result.returncode, 0, result.stderr)
                job = result.stdout.strip()
                gone = slurm_node.wait_for(lambda: job not in subprocess.run(
                    ["squeue", "-h", "-o", "%A"], env=environment, capture_output=True, text=True,
                    check=True).stdout.split(), 120)
                self.assertTrue(gone, "the merge did not end")

            def logs():
                return {p.name: p.read_text() for p in (self.folder / "all.parts").glob("*.log")}

            submit("3", "mission.yaml", "all", "--time=5")
            self.assertTrue((self.folder / "all/SHA256SUMS").exists(), logs())
            self.assertEqual(digest(self.folder / "all"), self.whole, logs())
            # Where a shard fails nothing is merged; the same command goes on from what is there.
            shutil.rmtree(self.folder / "all")
            scene = self.folder / "box.gltf"
            scene.rename(self.folder / "away")
            submit("3", "mission.yaml", "all")
            self.assertFalse((self.folder / "all").exists())
            (self.folder / "away").rename(scene)
            submit("3", "mission.yaml", "all")
            self.assertEqual(digest(self.folder / "all"), self.whole, logs())


if __name__ == "__main__":
    unittest.main()
