"""scripts/sweep.mk: one folder per point, nothing done twice, what was interrupted resumes."""
import csv
import json
import os
import subprocess
import unittest

from sandbox import ROOT, SONARSIM, Sandbox, box_gltf


class Sweep(Sandbox):
    def sweep(self, *arguments):
        # A make that runs the tests hands its own flags down; they are not this sweep's.
        environment = {k: v for k, v in os.environ.items() if not k.startswith(("MAKE", "MFLAGS"))}
        return subprocess.run(
            ["make", "-f", ROOT / "scripts/sweep.mk", f"SONARSIM={SONARSIM}", "MISSION=mission.yaml", "OUT=grid",
             *arguments], cwd=self.folder, env=environment, text=True, capture_output=True,
            timeout=120, check=False)

    def assert_sweeps(self, *arguments):
        result = self.sweep(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def index(self):
        return (self.folder / "grid/index.csv").read_text().splitlines()

    def test_any_key(self):
        self.write("more/box.gltf", box_gltf((1.0, 1.0, 1.0)))
        grid = ["-j2", "SENSOR=fls", "add_sigma=0 0.1", "scene.file=box.gltf more/box.gltf",
                "sensors.fls.mount.translation_m=[0,0,0.5]", "seed=3"]
        self.assert_sweeps(*grid)
        rows = self.index()
        self.assertEqual(rows[0], "add_sigma,seed,scene.file,sensors.fls.mount.translation_m,folder")
        self.assertEqual(rows[4], '0.1,3,more/box.gltf,"[0,0,0.5]","add_sigma=0.1,seed=3,scene.file=more_box.gltf,'
                                  'sensors.fls.mount.translation_m=0,0,0.5"')
        for row in csv.DictReader(rows):
            folder = self.folder / "grid" / row["folder"]
            self.assertTrue(self.dataset(folder)["complete"])
            resolved = (folder / "mission.resolved.yaml").read_text()
            # Paths in it start at the folder of the scene file.
            above = "../" if row["scene.file"].startswith("more/") else ""
            for line in (f"add_sigma: {row['add_sigma']}\n", "translation_m: [0, 0, 0.5]\n",
                         f'materials: "{above}materials.csv"'):
                self.assertIn(line, resolved)
        self.assertEqual(len(rows), 5)
        self.assertNotIn("render", self.assert_sweeps(*grid).stdout)

    def test_variants_and_what_was_interrupted(self):
        grid = ["variants=1 2", "seed=1"]
        self.assert_sweeps(*grid)
        self.assertEqual(self.index(),
                         ['seed,variants,folder', '1,1,"seed=1,variants=1"', '1,2,"seed=1,variants=2"'])
        spoilt = self.folder / "grid/seed=1,variants=2/variant_0001/dataset.json"
        spoilt.write_text(json.dumps({**json.loads(spoilt.read_text()), "complete": False}))
        resumed = self.assert_sweeps(*grid)
        self.assertEqual(resumed.stdout.count(" render "), 1, resumed.stdout)
        self.assertTrue(self.dataset(spoilt.parent)["complete"])

    def test_a_seed_that_is_shared(self):
        (self.folder / "grid").mkdir()
        for arguments, shared in ((["SENSOR=fls", "add_sigma=0 0.1", "seed=1 2"], True),
                                  (["SENSOR=fls", "add_sigma=0.1", "seed=1 2"], False)):
            self.assertEqual("share a seed" in self.assert_sweeps("-n", *arguments).stderr, shared)

    def test_a_point_that_fails(self):
        """The others are rendered, and the sweep reports which it was and why."""
        result = self.sweep("-j2", "sensors.fls.range_max_m=5 0.01 6", "seed=1")
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("of 3 points these failed", result.stderr)
        self.assertIn("range_min_m must be below range_max_m", result.stderr)
        self.assertEqual([p.name for p in (self.folder / "grid/failed").iterdir()],
                         ["seed=1,sensors.fls.range_max_m=0.01.txt"])
        self.assertEqual(len(self.index()), 3)

    def test_mistakes(self):
        """A value reaches neither make nor the shell: nothing runs."""
        marker = self.folder / "ran"
        sign = ": its name and its value must not hold "
        for argument, message in (
                ("add_sgma=0", "unknown: add_sgma"), ("add_sigma=0", "SENSOR"), ("-j1", "at least one of"),
                ("MISSION=none.yaml", "none.yaml: no such file"),
                ("MISSION=my mission.yaml", "MISSION must be one file without blanks"),
                (f"seed=$(shell touch {marker})1", sign), (f"seed=1';touch {marker};'2", sign), (f"seed=`touch {marker}`", sign),
                ('seed=1"', sign), ("seed=1\\", sign), ("scene.file=*.gltf", sign), ("scene.file=a(b).gltf", sign),
                ("a.b';id;'=1", sign), (f"OUT=$(shell touch {marker})grid", sign),
                (f"SENSOR=x';touch {marker};'", sign), (f"MISSION=$(shell touch {marker})mission.yaml", sign)):
            with self.subTest(argument=argument):
                more = ["engine=rays"] if "=" in argument and not argument.startswith("add_") else []
                result = self.sweep(argument, *more)
                self.assertEqual(result.returncode, 2, result.stdout)
                self.assertIn(message, result.stderr)
                self.assertFalse(marker.exists() or (self.folder / "grid").exists())


if __name__ == "__main__":
    unittest.main()
