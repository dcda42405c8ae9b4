"""Four shards by a real Slurm of one node, with its merge: the bytes of a single run."""
import pathlib
import shutil
import subprocess
import unittest

import slurm_node
from sandbox import ALL_FILES, SONARSIM, Sandbox, digest, path_csv

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"


class Clusters(Sandbox):
    def setUp(self):
        super().setUp()
        self.write("mission.yaml", ALL_FILES)
        self.write("path.csv", path_csv(5))
        self.assert_renders()
        self.whole = digest(self.out)
        shutil.rmtree(self.out)

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

            submit("4", "mission.yaml", "all", "--time=5")
            self.assertTrue((self.folder / "all/SHA256SUMS").exists(), logs())
            self.assertEqual(digest(self.folder / "all"), self.whole, logs())
            # Where a shard fails nothing is merged; the same command renders what is missing.
            shutil.rmtree(self.folder / "all")
            scene = self.folder / "box.gltf"
            scene.rename(self.folder / "away")
            submit("4", "mission.yaml", "all")
            self.assertFalse((self.folder / "all").exists())
            (self.folder / "away").rename(scene)
            submit("4", "mission.yaml", "all")
            self.assertEqual(digest(self.folder / "all"), self.whole, logs())


if __name__ == "__main__":
    unittest.main()
