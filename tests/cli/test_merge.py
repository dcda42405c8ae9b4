"""sonarsim merge, and the render that completes what it copied: the dataset of a single run, to the byte; and shards by
the tasks of a Slurm array, with its merge."""
import json
import os
import shutil
import subprocess
import unittest

from sandbox import ALL_FILES, ROOT, SONARSIM, Sandbox, digest, path_csv


class Whole(Sandbox):
    def setUp(self):
        super().setUp()
        self.write("mission.yaml", ALL_FILES)
        self.write("path.csv", path_csv(5))
        self.assert_renders()
        self.whole = digest(self.out)
        shutil.rmtree(self.out)


class Merge(Whole):
    def setUp(self):
        super().setUp()
        for k in "123":
            self.assert_renders("--shard", f"{k}/3", "--out", f"part{k}", "-j" + k)

    def merge(self, *folders):
        return self.run_sonarsim("merge", *folders)

    def assert_merges(self, *folders, rendered=0):
        """The parts stay as they are, and `rendered` pings are in none of them."""
        before = [digest(self.folder / part) for part in folders[:-1]]
        merged = json.loads(self.succeeds("merge", *folders, "--json").stdout)
        self.assertEqual([digest(self.folder / part) for part in folders[:-1]], before)
        self.assertEqual((merged["missing"], merged["pings"] + merged["skipped"]), (rendered, 20 - rendered))
        completed = json.loads(self.assert_renders("--out", folders[-1], "--json").stdout)
        self.assertEqual((completed["pings"], completed["complete"]), (rendered, True))
        self.assertEqual(digest(self.folder / folders[-1]), self.whole)
        self.assertEqual(self.run_sonarsim("verify", folders[-1]).returncode, 0)
        return merged

    def test_in_any_order_without_the_inputs(self):
        for name in ("box.gltf", "path.csv"):
            (self.folder / name).rename(self.folder / f"away.{name}")
        self.assertEqual(self.merge("part3", "part1", "part2", "all").returncode, 0)
        for name in ("box.gltf", "path.csv"):
            (self.folder / f"away.{name}").rename(self.folder / name)
        self.assertEqual(self.assert_merges("part1", "part2", "part3", "all")["pings"], 0)

    def test_again_and_what_overlaps(self):
        shutil.copytree(self.folder / "part1", self.folder / "all")
        self.assertEqual(self.assert_merges("part2", "part3", "all")["pings"], 13)
        self.assertIs(self.assert_merges("part1", "all", "part1", "copy")["complete"], True)

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
        self.assertEqual([(p.name, p.read_text()) for p in (self.folder / "victim").iterdir()], [("file", "mine")])

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


# Stands in for Slurm's: runs the tasks of a job at once, and one that depends on a job only if that did well.
SBATCH = """\
#!/usr/bin/env bash
tasks=0 log=/dev/null ok=1
while [[ $1 == --* ]]; do
    case $1 in
        --array=1-*) tasks=${1#--array=1-} ;;
        --output=*) log=${1#--output=} ;;
        --dependency=afterok:*) [[ ! -e $SLURM_FAILED/${1#--dependency=afterok:} ]] || ok=0 ;;
    esac
    shift
done
job=$$
echo $job
[[ $ok == 1 ]] || exit 0
export SLURM_CPUS_PER_TASK=2
if [[ $tasks == 0 ]]; then "$@" >"$log" 2>&1; exit 0; fi
export SLURM_ARRAY_TASK_COUNT=$tasks SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_MAX=$tasks
for ((k = 1; k <= tasks; ++k)); do
    SLURM_ARRAY_TASK_ID=$k "$@" >"${log/\\%a/$k}" 2>&1 || touch "$SLURM_FAILED/$job"
done
"""


class Clusters(Whole):
    def in_array(self, task, count, first=1, last=None):
        return dict(os.environ, SLURM_ARRAY_TASK_ID=str(task), SLURM_ARRAY_TASK_COUNT=str(count),
                    SLURM_ARRAY_TASK_MIN=str(first), SLURM_ARRAY_TASK_MAX=str(count if last is None else last))

    def test_shards_by_the_task_of_an_array(self):
        for task, shard in ((4, 1), (6, 2), (8, 3)):
            result = self.assert_renders(env=self.in_array(task, 3, 4, 8))
            self.assertIn(f"--shard {shard}/3", result.stderr)
        self.assertEqual(digest(self.out), self.whole)
        # The command line counts first, and an array may have a gap.
        shutil.rmtree(self.out)
        self.assert_renders("--shard", "1/1", env=self.in_array(2, 3))
        self.assertEqual(digest(self.out), self.whole)
        self.assert_refused(self.render(env=self.in_array(3, 3, 1, 7)),
                            "task 3 of a Slurm array", "--array=1-N", "--shard I/N")

    def test_the_scripts_of_slurm(self):
        self.write("bin/sbatch", SBATCH).chmod(0o755)
        failed = self.folder / "failed"
        failed.mkdir()
        environment = dict(os.environ, SONARSIM=SONARSIM, SLURM_FAILED=str(failed),
                           PATH=f"{self.folder}/bin:{os.environ['PATH']}")

        def submit():
            subprocess.run([ROOT / "scripts/slurm/render.sh", "3", "mission.yaml", "all", "--time=5"], cwd=self.folder,
                           env=environment, capture_output=True, text=True, timeout=60, check=True)
            return "\n".join(p.read_text() for p in (self.folder / "all.parts").glob("*.log"))

        # Where a shard fails nothing is merged; the same command goes on from what is there.
        (self.folder / "box.gltf").rename(self.folder / "away")
        self.assertIn("box.gltf", submit())
        self.assertFalse((self.folder / "all").exists())
        (self.folder / "away").rename(self.folder / "box.gltf")
        logs = submit()
        self.assertTrue((self.folder / "all").exists(), logs)
        self.assertEqual(digest(self.folder / "all"), self.whole, logs)


if __name__ == "__main__":
    unittest.main()
