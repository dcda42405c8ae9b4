"""scripts/sweep.mk: one folder per point, nothing done twice, what was interrupted resumes."""
import csv
import json
import os
import subprocess
import unittest

from sandbox import SONARSIM, Sandbox, box_gltf

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

    def test_any_key(self):
        (self.folder / "more").mkdir()
        (self.folder / "more/box.gltf").write_text(box_gltf((1.0, 1.0, 1.0)))
        result = self.sweep("-j2", "sensors.fls.range_max_m=5 6", "scene.file=box.gltf more/box.gltf",
                            "sensors.fls.mount.translation_m=[0,0,0.5]", "seed=3")
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = (self.folder / "grid/index.csv").read_text().splitlines()
        self.assertEqual(rows[0], "seed,scene.file,sensors.fls.mount.translation_m,"
                                  "sensors.fls.range_max_m,folder")
        self.assertEqual(len(rows), 5)
        self.assertEqual(rows[4], '3,more/box.gltf,"[0,0,0.5]",6,"seed=3,scene.file=more_box.gltf,'
                                  'sensors.fls.mount.translation_m=0,0,0.5,sensors.fls.range_max_m=6"')
        with open(self.folder / "grid/index.csv", newline="") as file:
            for row in csv.DictReader(file):
                resolved = (self.folder / "grid" / row["folder"] / "mission.resolved.yaml").read_text()
                self.assertIn(f"range_max_m: {row['sensors.fls.range_max_m']}\n", resolved)
                self.assertIn("translation_m: [0, 0, 0.5]\n", resolved)
                # Paths in it start at the folder of the scene file.
                deeper = row["scene.file"].startswith("more/")
                self.assertIn(f'materials: "{"../" if deeper else ""}materials.csv"', resolved)

    def test_a_mission_with_variants(self):
        grid = ["variants=1 2", "seed=1"]
        result = self.sweep(*grid)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual((self.folder / "grid/index.csv").read_text().splitlines(),
                         ['seed,variants,folder', '1,1,"seed=1,variants=1"', '1,2,"seed=1,variants=2"'])
        self.assertNotIn("render", self.sweep(*grid).stdout)
        spoilt = self.folder / "grid/seed=1,variants=2/variant_0001/dataset.json"
        spoilt.write_text(json.dumps({**json.loads(spoilt.read_text()), "complete": False}))
        resumed = self.sweep(*grid)
        self.assertEqual(resumed.stdout.count(" render "), 1, resumed.stdout)
        self.assertIs(self.dataset(spoilt.parent)["complete"], True)

    def test_a_point_that_fails(self):
        """The others are rendered, and the sweep says which it was and why; the next one tries again."""
        grid = ["-j2", "sensors.fls.range_max_m=5 0.01 6", "seed=1"]
        result = self.sweep(*grid)
        self.assertEqual(result.returncode, 2, result.stderr)
        self.assertIn("of 3 points these failed", result.stderr)
        self.assertIn("range_min_m must be below range_max_m", result.stderr)
        name = "seed=1,sensors.fls.range_max_m=0.01"
        self.assertEqual([p.name for p in (self.folder / "grid/failed").iterdir()], [name + ".txt"])
        self.assertEqual(len((self.folder / "grid/index.csv").read_text().splitlines()), 3)
        self.edit("mission.yaml", "range_max_m: 6", "range_max_m: 6\n    range_min_m: 0.001")
        again = self.sweep(*grid, "OUT=other")
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertFalse((self.folder / "other/failed").exists())

    def test_mistakes(self):
        for arguments, message in ((["add_sgma=0"], "unknown: add_sgma"),
                                   (["add_sigma=0"], "SENSOR"),
                                   ([], "at least one of"),
                                   (["MISSION=none.yaml", "seed=1"], "none.yaml: no such file")):
            with self.subTest(arguments=arguments):
                result = self.sweep(*arguments)
                self.assertEqual(result.returncode, 2)
                self.assertIn(message, result.stderr)

    def test_what_make_or_the_shell_would_run_is_refused(self):
        """A value reaches neither: nothing runs, and the message names the variable and the sign."""
        marker = self.folder / "ran"
        for name, value in (("seed", f"$(shell touch {marker})1"), ("seed", f"1';touch {marker};'2"),
                            ("seed", f"`touch {marker}`"), ("seed", '1"'), ("seed", "1\\"), ("seed", "1!2"),
                            ("scene.file", "*.gltf"), ("scene.file", "a(b).gltf"), ("scene.file", "a#b"),
                            ("a.b';id;'", "1"),
                            ("OUT", f"$(shell touch {marker})grid"), ("SENSOR", f"x';touch {marker};'"),
                            ("MISSION", f"$(shell touch {marker})mission.yaml")):
            with self.subTest(name=name, value=value):
                result = self.sweep("SENSOR=fls", f"{name}={value}", "engine=rays")
                self.assertEqual(result.returncode, 2, result.stdout)
                self.assertIn(f"{name}: its name and its value must not hold ", result.stderr)
                self.assertFalse(marker.exists())
                self.assertFalse((self.folder / "grid").exists())

    def test_a_mission_with_a_blank_in_its_name(self):
        self.write("my mission.yaml", (self.folder / "mission.yaml").read_text())
        result = self.sweep("MISSION=my mission.yaml", "seed=1")
        self.assertEqual(result.returncode, 2, result.stdout)
        self.assertIn("MISSION must be one file without blanks in its name, not 'my mission.yaml'",
                      result.stderr)


if __name__ == "__main__":
    unittest.main()
