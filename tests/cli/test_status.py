"""`sonarsim status` of a job that runs, was interrupted, is complete, in shards and in variants."""
import json
import subprocess
import time
import unittest

from sandbox import SONARSIM, Sandbox, path_csv


class Status(Sandbox):
    def status(self, *folders):
        result = self.run_sonarsim("status", "--json", *folders)
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def test_shards_one_after_the_other(self):
        self.assert_renders("--shard", "2/3")
        self.assertEqual(self.status("out"), {"mission": "box", "state": "interrupted",
                                              "pings": {"done": 2, "all": 6}})
        # Another shard in a folder of its own: both together are reported.
        self.assert_renders("--shard", "1/3", "--out", "other")
        self.assertEqual(self.status("out", "other")["pings"], {"done": 4, "all": 6})
        self.assertIn("pings       4 of 6 (66.7 %)\n", self.run_sonarsim("status", "out", "other").stdout)
        self.assert_renders("--shard", "1/3")
        self.assert_renders("--shard", "3/3")
        self.assertEqual(self.status("out")["state"], "complete")

    def test_while_it_runs(self):
        self.write("path.csv", path_csv(200_000))
        with subprocess.Popen([SONARSIM, "render", "mission.yaml", "-q", "--checkpoint", "0.05", "--set",
                               "output.fan=false", "--set", "output.image=false", "-j1"],
                              cwd=self.folder, stdout=subprocess.DEVNULL) as process:
            try:
                reported = {}
                while process.poll() is None and not reported.get("pings", {}).get("done"):
                    time.sleep(0.1)
                    if (self.out / "dataset.json").exists():
                        reported = self.status("out")
                self.assertEqual(reported["state"], "running")
            finally:
                process.terminate()
        self.assertEqual(self.status("out")["state"], "interrupted")

    def test_variants(self):
        mission = (self.folder / "mission.yaml").read_text()
        self.write("mission.yaml", mission + "variants: 3\nvary:\n"
                   "  - {key: sensors.fls.noise.add_sigma, uniform: [0.01, 0.02]}\n")
        self.assert_renders("--shard", "1/2")
        reported = self.status("out")
        self.assertEqual((reported["state"], reported["variants"]), ("interrupted", {"done": 2, "all": 3}))
        self.assert_renders("--shard", "2/2", "--out", "part2")
        reported = self.status("out", "part2")
        self.assertEqual((reported["state"], reported["variants"]), ("complete", {"done": 3, "all": 3}))
        self.assert_renders("--seed", "8", "--out", "other")
        self.assert_refused(self.run_sonarsim("status", "out", "other"), "holds variants of another mission")
        self.assert_refused(self.run_sonarsim("status", "out", "other/variant_0000"), "no variants.json")

    def test_what_is_not_a_dataset(self):
        self.assert_refused(self.run_sonarsim("status", "."), "is not a dataset")
        self.assert_renders()
        self.assert_renders("--seed", "8", "--out", "other")
        self.assert_refused(self.run_sonarsim("status", "out", "other"), "of another mission")


if __name__ == "__main__":
    unittest.main()
