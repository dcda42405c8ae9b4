"""scripts/sweep.mk: one folder per point, nothing done twice, what was interrupted resumes."""
import json
import os
import subprocess
import unittest

from sandbox import SONARSIM, Sandbox

SWEEP = os.path.join(os.path.dirname(__file__), "../../scripts/sweep.mk")


class Sweep(Sandbox):
    def sweep(self, *arguments):
        # A make that runs the tests hands its own flags down; they are not this sweep's.
        environment = {k: v for k, v in os.environ.items() if not k.startswith(("MAKE", "MFLAGS"))}
        return subprocess.run(
            ["make", "-f", SWEEP, f"SONARSIM={SONARSIM}", "MISSION=mission.yaml", "OUT=grid",
             *arguments], cwd=self.folder, env=environment, text=True, capture_output=True,
            timeout=120, check=False)

    def test_grid(self):
        grid = ["-j2", "SENSOR=fls", "add_sigma=0 0.1", "mult_sigma=0 0.2"]
        result = self.sweep(*grid)
        self.assertEqual(result.returncode, 0, result.stderr)
        index = (self.folder / "grid/index.csv").read_text().splitlines()
        self.assertEqual(index, ['add_sigma,mult_sigma,folder',
                                 '0,0,"add_sigma=0,mult_sigma=0"',
                                 '0,0.2,"add_sigma=0,mult_sigma=0.2"',
                                 '0.1,0,"add_sigma=0.1,mult_sigma=0"',
                                 '0.1,0.2,"add_sigma=0.1,mult_sigma=0.2"'])
        for line in index[1:]:
            folder = self.folder / "grid" / line.split('"')[1]
            self.assertIs(self.dataset(folder)["complete"], True)
            resolved = (folder / "mission.resolved.yaml").read_text()
            add, mult = line.split(",")[:2]
            self.assertIn(f"add_sigma: {add}\n", resolved)
            self.assertIn(f"mult_sigma: {mult}\n", resolved)

        again = self.sweep(*grid)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertNotIn("render", again.stdout)

        spoilt = self.folder / "grid/add_sigma=0,mult_sigma=0/dataset.json"
        spoilt.write_text(json.dumps({**json.loads(spoilt.read_text()), "complete": False}))
        resumed = self.sweep(*grid)
        self.assertEqual(resumed.stdout.count(" render "), 1, resumed.stdout)
        self.assertIs(self.dataset(spoilt.parent)["complete"], True)

    def test_a_seed_that_is_shared(self):
        (self.folder / "grid").mkdir()
        for arguments, shared in ((["SENSOR=fls", "add_sigma=0 0.1"], True),
                                  (["SENSOR=fls", "add_sigma=0 0.1", "seed=1 2"], True),
                                  (["SENSOR=fls", "add_sigma=0.1", "seed=1 2"], False),
                                  (["seed=1 2 3"], False), (["SENSOR=fls", "add_sigma=0.1"], False)):
            with self.subTest(arguments=arguments):
                result = self.sweep("-n", *arguments)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual("share a seed" in result.stderr, shared, result.stderr)

    def test_mistakes(self):
        for arguments, message in ((["add_sgma=0"], "unknown: add_sgma"),
                                   (["add_sigma=0"], "SENSOR"),
                                   ([], "at least one of"),
                                   (["MISSION=none.yaml", "seed=1"], "none.yaml: no such file")):
            with self.subTest(arguments=arguments):
                result = self.sweep(*arguments)
                self.assertEqual(result.returncode, 2)
                self.assertIn(message, result.stderr)


if __name__ == "__main__":
    unittest.main()
