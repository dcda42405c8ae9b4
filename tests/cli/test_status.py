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
        reported = self.status("out")
        # Six pings, of which shard 2 of 3 has those with the indices 1 and 4.
        self.assertEqual(reported["state"], "interrupted")
        self.assertEqual(reported["pings"], {"done": 2, "all": 6})
        self.assertEqual(reported["sensors"], {"fls": {"done": 2, "all": 6}})
        self.assertEqual([(s["shard"], s["of"], s["state"], s["pings"]["done"]) for s in reported["shards"]],
                         [(1, 3, "not begun", 0), (2, 3, "done", 2), (3, 3, "not begun", 0)])
        self.assertIsNone(reported["seconds_left"])
        # Another shard in a folder of its own: both together are reported.
        self.assert_renders("--shard", "1/3", "--out", "other")
        self.assertEqual(self.status("out", "other")["pings"], {"done": 4, "all": 6})
        text = self.run_sonarsim("status", "out", "other").stdout
        self.assertIn("pings       4 of 6 (66.7 %)\n", text)
        self.assertIn("shard 3/3   0 of 2, not begun\n", text)
        self.assert_renders("--shard", "1/3")
        self.assert_renders("--shard", "3/3")
        reported = self.status("out")
        self.assertEqual((reported["state"], reported["pings"], reported["shards"]),
                         ("complete", {"done": 6, "all": 6}, []))

    def test_while_it_runs(self):
        self.write("path.csv", path_csv(200_000))
        with subprocess.Popen([SONARSIM, "render", "mission.yaml", "-q", "--checkpoint", "0.05", "--set",
                               "output.fan=false", "--set", "output.image=false", "-j1"],
                              cwd=self.folder, stdout=subprocess.DEVNULL) as process:
            try:
                reported = {}
                while process.poll() is None and not reported.get("pings_per_s"):
                    time.sleep(0.1)
                    if (self.out / "dataset.json").exists():
                        reported = self.status("out")
                self.assertEqual(reported["state"], "running")
                self.assertGreater(reported["pings"]["done"], 0)
                self.assertGreater(reported["seconds_left"], 0)
            finally:
                process.terminate()
        reported = self.status("out")
        self.assertEqual((reported["state"], reported["pings_per_s"]), ("interrupted", 0))

    def test_variants(self):
        mission = (self.folder / "mission.yaml").read_text()
        self.write("mission.yaml", mission + "variants: 3\nvary:\n"
                   "  - {key: sensors.fls.noise.add_sigma, uniform: [0.01, 0.02]}\n")
        self.assert_renders("--shard", "1/2")
        self.assertEqual(self.status("out"), {"variants": 3, "complete": 2, "under_way": {}})
        self.assert_renders("--shard", "2/2", "--out", "part2")
        self.assertEqual(self.status("out", "part2"), {"variants": 3, "complete": 3, "under_way": {}})
        self.assert_renders("--seed", "8", "--out", "other")
        self.assert_refused(self.run_sonarsim("status", "out", "other"), "seed: 8 there, 7 here")
        self.assert_refused(self.run_sonarsim("status", "out", "other/variant_0000"), "no variants")

    def test_what_is_no_dataset(self):
        self.assert_refused(self.run_sonarsim("status", "."), "is no dataset")
        self.assert_renders()
        self.assert_renders("--seed", "8", "--out", "other")
        self.assert_refused(self.run_sonarsim("status", "out", "other"), "of another mission")


if __name__ == "__main__":
    unittest.main()
