"""Shards by the tasks of a Slurm array, with its merge: the bytes of a single run. By a Slurm of one node where it is
installed, and by a stand-in."""
import os
import subprocess
import unittest

import slurm_node
from sandbox import ALL_FILES, ROOT, SONARSIM, Sandbox, digest, path_csv

# Runs the tasks of a job at once, and one that depends on a job only if that did well.
SBATCH = """\
#!/usr/bin/env bash
tasks=0 log=/dev/null ok=1
while [[ $1 == --* ]]; do
    case $1 in
        --array=1-*) tasks=${1#--array=1-} ;;
        --output=*) log=${1#--output=} ;;
        --dependency=afterok:*) [[ ! -e $SLURM_FAILED/${1#--dependency=afterok:} ]] || ok=0 ;;
        --parsable | --kill-on-invalid-dep=yes | --job-name=* | --time=5) ;;
        *) exit 1 ;;
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


class Clusters(Sandbox):
    def setUp(self):
        super().setUp()
        self.write("mission.yaml", ALL_FILES)
        self.write("path.csv", path_csv(5))
        self.whole = self.render_whole()

    def check_scripts(self, environment, queued=lambda: ""):
        """Where a shard fails nothing is merged; the same command goes on from what is there."""
        scene, away = self.folder / "box.gltf", self.folder / "away"
        for before, after in ((scene, away), (away, scene)):
            before.rename(after)
            job = subprocess.run([ROOT / "scripts/slurm/render.sh", "4", "mission.yaml", "all", "--time=5"], cwd=self.folder,
                                 env={**environment, "SONARSIM": SONARSIM}, stdout=subprocess.PIPE, text=True, timeout=60,
                                 check=True).stdout.strip()
            self.assertTrue(slurm_node.wait_for(lambda job=job: job not in queued().split(), 120), "the merge did not end")
            logs = "\n".join(p.read_text() for p in (self.folder / "all.parts").glob("*.log"))
            self.assertEqual((self.folder / "all/SHA256SUMS").exists(), scene.exists(), logs)
        self.assertEqual(digest(self.folder / "all"), self.whole, logs)

    @unittest.skipIf(slurm_node.missing(), slurm_node.missing())
    def test_a_real_slurm(self):
        node = self.folder / "slurm"
        node.mkdir()
        with slurm_node.one_node(node) as environment:
            self.check_scripts(environment, lambda: subprocess.run(
                ["squeue", "-h", "-o", "%A"], env=environment, capture_output=True, text=True, check=True).stdout)

    def test_a_stand_in(self):
        self.write("bin/sbatch", SBATCH).chmod(0o755)
        failed = self.folder / "failed"
        failed.mkdir()
        self.check_scripts({**os.environ, "SLURM_FAILED": str(failed), "PATH": f"{self.folder}/bin:{os.environ['PATH']}"})

    def test_shards_by_the_task_of_an_array(self):
        def in_array(task, count, first=1, last=None):
            return dict(os.environ, SLURM_ARRAY_TASK_ID=str(task), SLURM_ARRAY_TASK_COUNT=str(count),
                        SLURM_ARRAY_TASK_MIN=str(first), SLURM_ARRAY_TASK_MAX=str(last or count))
        for task, shard in ((4, 1), (6, 2), (8, 3)):
            result = self.assert_renders(env=in_array(task, 3, 4, 8))
            self.assertIn(f"--shard {shard}/3", result.stderr)
        self.assertEqual(digest(self.out), self.whole)
        # The command line counts first, and an array may have a gap.
        self.assert_renders("--shard", "1/1", "--overwrite", env=in_array(2, 3))
        self.assertEqual(digest(self.out), self.whole)
        self.assert_refused(self.render(env=in_array(3, 3, 1, 7)), "task 3 of a Slurm array", "--array=1-N", "--shard I/N")


if __name__ == "__main__":
    unittest.main()
