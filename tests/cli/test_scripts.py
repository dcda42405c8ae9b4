"""Many runs by the scripts: a sweep, one folder per point; and shards by the tasks of a Slurm array, with their merge: by a
Slurm of one node where it is installed, and by a stand-in."""
import collections
import csv
import json
import os
import pathlib
import re
import shutil
import sys
import textwrap
import unittest

import slurm_node
from sandbox import ALL_FILES, ENVIRONMENT, MISSION, ROOT, SONARSIM, Sandbox, box_gltf, digest, path_csv, png

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
export SLURM_ARRAY_TASK_COUNT=$tasks
for ((k = 1; k <= tasks; ++k)); do
    SLURM_ARRAY_TASK_ID=$k "$@" >"${log/\\%a/$k}" 2>&1 || touch "$SLURM_FAILED/$job"
done
"""

HEIGHTMAP = "  heightmap: {file: bed.png, material: Concrete, pixel_m: 0.25, height_offset_m: -3}\n"


class Sweep(Sandbox):
    def sweep(self, *arguments, code=0):
        return self.run_program("make", "-f", ROOT / "scripts/sweep.mk", f"SONARSIM={SONARSIM}", "MISSION=mission.yaml",
                                "OUT=grid", *arguments, code=code, env=ENVIRONMENT)

    def index(self):
        return (self.folder / "grid/index.csv").read_text().splitlines()

    def test_any_key(self):
        self.write("more/box.gltf", box_gltf((1.0, 1.0, 1.0)))
        grid = ["-j2", "SENSOR=fls", "add_sigma=0 0.1", "scene.file=box.gltf more/box.gltf",
                "sensors.fls.mount.translation_m=[0,0,0.5]", "seed=3"]
        self.sweep(*grid)
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
            self.assert_has(resolved, f"add_sigma: {row['add_sigma']}\n", "translation_m: [0, 0, 0.5]\n",
                            f'materials: "{above}materials.csv"')
        self.assertEqual(len(rows), 5)
        self.assertNotIn("render", self.sweep(*grid).stdout)

    def test_variants_and_what_was_interrupted(self):
        grid = ["variants=1 2", "seed=1"]
        self.sweep(*grid)
        self.assertEqual(self.index(), ['seed,variants,folder', '1,1,"seed=1,variants=1"', '1,2,"seed=1,variants=2"'])
        spoilt = self.folder / "grid/seed=1,variants=2/variant_0001/dataset.json"
        spoilt.write_text(json.dumps({**json.loads(spoilt.read_text()), "complete": False}))
        self.sweep(*grid)
        self.assertTrue(self.dataset(spoilt.parent)["complete"])
        self.write("path.csv", path_csv(4))
        self.assertIn("2 points these failed", self.sweep(*grid, code=2).stderr)    # other inputs
        self.assertEqual(self.index(), ["seed,variants,folder"])

    def test_a_seed_that_is_shared(self):
        (self.folder / "grid").mkdir()
        for arguments, shared in ((["SENSOR=fls", "add_sigma=0 0.1", "seed=1 2"], True),
                                  (["SENSOR=fls", "add_sigma=0.1", "seed=1 2"], False)):
            self.assertEqual("share a seed" in self.sweep("-n", *arguments).stderr, shared)
        twice = self.sweep("SENSOR=fls", "add_sigma=0", "sensors.fls.noise.add_sigma=1", code=2)
        self.assertIn("two axes are one key: sensors.fls.noise.add_sigma", twice.stderr)

    def test_a_point_that_fails(self):
        """The others are rendered, and the sweep reports which it was and why."""
        result = self.sweep("-j2", "sensors.fls.range_max_m=5 0.01 6", "seed=1", code=2)
        self.assertIn("of 3 points these failed", result.stderr)
        self.assertIn("range_min_m must be below range_max_m", result.stderr)
        self.assertEqual([p.name for p in (self.folder / "grid/failed").iterdir()], ["seed=1,sensors.fls.range_max_m=0.01.txt"])
        self.assertEqual(len(self.index()), 3)

    def test_mistakes(self):
        """A value reaches neither make nor the shell: nothing runs."""
        marker = self.folder / "ran"
        sign = ": its name and its value must not hold "
        for argument, message in (("add_sgma=0", "unknown: add_sgma"), ("add_sigma=0", "SENSOR"), ("-j1", "at least one of"),
                ("MISSION=none.yaml", "none.yaml: no such file"),
                ("MISSION=my mission.yaml", "MISSION must be one file without blanks"),
                (f"seed=$(shell touch {marker})1", sign), (f"seed=1';touch {marker};'2", sign), (f"seed=`touch {marker}`", sign),
                ('seed=1"', sign), ("seed=1\\", sign), ("scene.file=*.gltf", sign), ("scene.file=a(b).gltf", sign),
                ("a.b';id;'=1", sign), (f"OUT=$(shell touch {marker})grid", sign),
                (f"SENSOR=x';touch {marker};'", sign), (f"MISSION=$(shell touch {marker})mission.yaml", sign)):
            with self.subTest(argument=argument):
                more = ["engine=rays"] if "=" in argument and not argument.startswith("add_") else []
                self.assertIn(message, self.sweep(argument, *more, code=2).stderr)
                self.assertFalse(marker.exists() or (self.folder / "grid").exists())


class Clusters(Sandbox):
    FILES = {"mission.yaml": ALL_FILES, "path.csv": path_csv(5)}

    def setUp(self):
        super().setUp()
        self.whole = self.render_whole()

    def check_scripts(self, environment, queued=lambda: ""):
        """Where a shard fails nothing is merged; the same command goes on from what is there."""
        scene, away = self.folder / "box.gltf", self.folder / "away"
        for before, after in ((scene, away), (away, scene)):
            before.rename(after)
            job = self.run_program(ROOT / "scripts/slurm/render.sh", 4, "mission.yaml", "all", "--time=5",
                                   env={**environment, "SONARSIM": SONARSIM}).stdout.strip()
            self.assertTrue(slurm_node.wait_for(lambda job=job: job not in queued().split(), 120), "the merge did not end")
            logs = "\n".join(p.read_text() for p in (self.folder / "all.parts").glob("*.log"))
            self.assertEqual((self.folder / "all/SHA256SUMS").exists(), scene.exists(), logs)
        self.assertEqual(digest(self.folder / "all"), self.whole, logs)
        parts = [p.name for p in (self.folder / "all.parts").glob("*/fls/meta/*.json")]
        self.assertEqual(sorted(parts), [f"{k:06}.json" for k in range(5)])     # each ping is in one

    @unittest.skipIf(slurm_node.missing(), slurm_node.missing())
    def test_a_real_slurm(self):
        node = self.folder / "slurm"
        node.mkdir()
        with slurm_node.one_node(node) as environment:
            self.check_scripts(environment, lambda: self.run_program("squeue", "-h", "-o", "%A", env=environment).stdout)

    def test_a_stand_in(self):
        self.write("bin/sbatch", SBATCH).chmod(0o755)
        failed = self.folder / "failed"
        failed.mkdir()
        self.check_scripts({**os.environ, "SLURM_FAILED": str(failed), "PATH": f"{self.folder}/bin:{os.environ['PATH']}"})

    def test_make_and_kubernetes(self):
        """The bytes of a single run; the commands of the Jobs run here, one index after the other."""
        self.run_program("make", "-f", ROOT / "scripts/shards.mk", "-j2", "N=3", f"SONARSIM={SONARSIM}", "MISSION=mission.yaml",
                         "OUT=all", env=ENVIRONMENT)
        self.assertEqual(digest(self.folder / "all"), self.whole)
        self.write("bin/sonarsim", f'#!/bin/sh\nexec "{SONARSIM}" "$@"\n').chmod(0o755)
        environment = {**ENVIRONMENT, "PATH": f"{self.folder}/bin:{os.environ['PATH']}", "SHARDS": "2", "MISSION": "mission.yaml",
                       "OUT": "big"}
        for name, indices in (("shards", (1, 0)), ("merge", ("",))):
            text = (ROOT / f"scripts/kubernetes/{name}.yaml").read_text()
            command = textwrap.dedent(re.search(r"- \|\n((?: {14}.*\n)+)", text)[1])
            for index in indices:
                self.run_program("/bin/sh", "-c", command, env={**environment, "JOB_COMPLETION_INDEX": str(index)})
        self.assertEqual(digest(self.folder / "big"), self.whole)


class FirstPicture(Sandbox):
    """render.sh installs and builds the module for images when a mission names one, and not before."""

    def test_stock(self):
        """Closed meshes of plausible sizes that rest on 0, each example another; `--for` makes what a mission names."""
        sys.path.insert(0, str(ROOT / "scripts"))
        from scenes import stock
        self.assertIn(f"\nstock     {len(stock.KINDS)} kinds of things", (ROOT / "scripts/make_scenes.py").read_text())
        # The program and the scripts name the same kinds.
        source = (ROOT / "lib/input/mission/stock.cpp").read_text()
        for names, array in ((stock.KINDS, "stock_kinds"), (stock.CLUTTER, "clutter_kinds")):
            self.assertEqual(re.findall(r'"(\w+)"', re.search(array + r"\[\]\{(.*?)\}", source, re.S)[1]), list(names))
        materials = [line.split(",")[0] for line in (ROOT / "scenes/materials.csv").read_text().splitlines()]
        for kind in stock.KINDS:
            shapes = set()
            for parts in (stock.example(kind, k) for k in range(1, stock.EXAMPLES + 1)):
                numbers = [x for one in parts for x in one.vertices]
                shapes.add(tuple(numbers))
                sizes = [max(numbers[k::3]) - min(numbers[k::3]) for k in range(3)]
                self.assertTrue(0.05 < max(sizes) < 7, (kind, sizes))
                self.assertAlmostEqual(min(numbers[1::3]), 0, 3, kind)
                for one in parts:
                    self.assertIn(one.material, materials)
                    (indices,) = one.indices.values()
                    edges = collections.Counter(tuple(sorted((indices[k], indices[k - 2 if k % 3 == 2 else k + 1])))
                                                for k in range(len(indices)))
                    self.assertEqual(set(edges.values()), {2}, (kind, one.name))
            self.assertEqual(len(shapes), stock.EXAMPLES, kind)
        shutil.copytree(ROOT / "scripts/scenes", self.folder / "own/scripts/scenes")
        shutil.copy(ROOT / "scripts/make_scenes.py", self.folder / "own/scripts")
        mission = self.write("mission.yaml", "scene:\n  scatter:\n    - {name: a, stock: [can,\n        hook]}  # [tyre]\n")
        made = self.folder / "own/scenes/generated/stock"
        self.run_program("/usr/bin/python3", "-B", self.folder / "own/scripts/make_scenes.py", "--for", mission, "--set",
                         "scene.scatter.1.stock=[net]")
        self.assertEqual(sorted(path.name for path in made.iterdir()),
                         sorted(f"{kind}_{k}.glb" for kind in ("can", "hook", "net") for k in range(1, 7)))

    @unittest.skipIf(pathlib.Path("/usr/local/lib/sonarsim").exists(), "an installed module takes the place of a missing one")
    def test_images_on_demand(self):
        for name in ("render.sh", "make_scenes.py", "scenes"):
            self.write(f"clone/scripts/{name}", "").unlink()
            os.symlink(ROOT / "scripts" / name, self.folder / "clone/scripts" / name)
        program = self.write("clone/build/sonarsim", "")
        shutil.copy(SONARSIM, program)
        modules = pathlib.Path(SONARSIM).parent / "lib"
        self.write("clone/scripts/setup.sh", f"""\
#!/usr/bin/env bash
echo "images ${{SONARSIM_IMAGES:-yes}}" >> {self.folder}/setups
[[ ${{SONARSIM_IMAGES:-yes}} = no ]] || ln -s {modules} {program.parent}/lib
""").chmod(0o755)
        self.write("bed.png", png([[0] * 40] * 40))
        environment = {name: value for name, value in os.environ.items() if name != "SONARSIM"}
        plain = "images no\n"
        for scene, setups in (("", plain), (HEIGHTMAP, 2 * plain + "images yes\n")):
            self.write("mission.yaml", MISSION.replace("  materials:", scene + "  materials:"))
            self.run_program(self.folder / "clone/scripts/render.sh", "mission.yaml", "--quiet", "--overwrite", env=environment)
            self.assertEqual((self.folder / "setups").read_text(), setups)
