"""Every command in a code block of README.md, the tutorial and docs/running.md is run on small input, or stands in NOT_RUN
with the reason; the snippets of docs/dataset.md in Python, too. Figures that README.md states are those of other pages."""
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import unittest

from clone import Clone
from sandbox import ENVIRONMENT, MATERIALS, MISSION, ROOT, SONARSIM, Sandbox, box_gltf, path_csv, python_with

PAGES = ("README.md", "docs/tutorial.md", "docs/running.md")

# How a command begins: variables, then a script of the repository or a program.
BEGINS = re.compile(r"""(?:[A-Z_]+=(?:"[^"]*"|\S+)\ )*
                    (?:\./|\.ci/|scripts/|build/|for\ \w+\ in\ [^:;]*;\ do|
                    (?:sonarsim|/usr/bin/python3|make|mkdir|ln|cd|cp|sudo|apt|python3|cmake|git|ctest|yolo)\ )""", re.VERBOSE)

NOT_RUN = {"./scripts/test.sh": "runs this test",
    "yolo detect train model=yolo11n.pt data=detection/data.yaml": "needs Ultralytics, which is not part of sonarsim",
    "yolo detect train model=yolo11n.pt data=anchors/data.yaml": "the same",
    "./scripts/package.sh && sudo apt install ./build-package/sonarsim_*.deb": "CI runs it: builds the program anew",
    "scripts/slurm/render.sh 64 mission.yaml out/big --time=60 --cpus-per-task=4":
        "needs Slurm; test_scripts.py runs it with a stand-in", }
PYTHON = python_with("matplotlib")
PACKAGE = os.environ.get("SONARSIM_PYTHON_PACKAGE", "")
MODULE_PYTHON = os.environ.get("SONARSIM_PYTHON_EXECUTABLE", sys.executable)

# What makes a command smaller, and what is run in place of one that has place-holders.
TINY = "--set sensors.fls.range_bins=64 --set sensors.fls.azimuth_bins=64"
FEW = f"--set trajectory.rate_hz=1 {TINY}"
WITH = {"./scripts/render.sh configs/tank_imaging.yaml": FEW,
    "./scripts/render.sh configs/detection.yaml": f"--set variants=5 --set trajectory.rate_hz=0.5 {TINY}",
    "build/sonarsim validate anchors.yaml": f"--set variants=1 {FEW}", "build/sonarsim preview anchors.yaml": FEW,
    "build/sonarsim preview anchors.yaml --set sensors.fls.range_max_m=25 --out far.png": FEW,
    "build/sonarsim render anchors.yaml": f"--set variants=5 {FEW}",
    'make -f scripts/sweep.mk -j2 MISSION=configs/tank_imaging.yaml OUT=out/sweep sensors.fls.range_max_m="6 10" seed="1 2"':
        "trajectory.rate_hz=1 sensors.fls.range_bins=64", }
INSTEAD = {command: f"{command} {more}" for command, more in WITH.items()} | {
    "build/sonarsim validate hull.yaml && build/sonarsim render hull.yaml":
        f"build/sonarsim validate hull.yaml {TINY} && build/sonarsim render hull.yaml {TINY}",
    "sonarsim render /usr/share/sonarsim/configs/tank_imaging.yaml":
        f"sonarsim render share/sonarsim/configs/tank_imaging.yaml {FEW} --out out/installed",
    "sonarsim status OUT": "sonarsim status part1", }

# What a page takes for granted.
BEFORE = {"docs/running.md": ("for i in $(seq 4); do sonarsim render mission.yaml -q --shard $i/4 --out part$i; done",)}

LINKED = ("configs", "docs", "scenes", "scripts", "trajectories")


def commands_of(text):
    """The commands in code blocks, without what is said of them beside, as (line number, command)."""
    commands, fence = [], None
    lines = iter(enumerate(text.splitlines(), 1))
    for number, line in lines:
        if line.startswith("```"):
            fence = None if fence is not None else line[3:]
            continue
        if fence is None and not line.startswith("    ") or fence not in (None, "", "sh", "bash"):
            continue
        line = line.strip()
        while line.endswith("\\"):
            line = line[:-1].rstrip() + " " + next(lines)[1].strip()
        if BEGINS.match(line):
            commands.append((number, re.split(r"\s{2,}|\s#\s", line)[0]))
    return commands


def fill(folder, clone):
    """What a reader has: the repository, the program, and files of the names that the pages use."""
    for name in LINKED:
        (folder / name).symlink_to(clone / name)
    for program in ("build/sonarsim", "bin/sonarsim"):
        (folder / program).parent.mkdir()
        (folder / program).symlink_to(SONARSIM)
    (folder / "build/python").symlink_to(pathlib.Path(SONARSIM).parent / "python")
    if PYTHON is not None:
        (folder / "bin/python3").symlink_to(PYTHON)
    (folder / "share").mkdir()
    (folder / "share/sonarsim").symlink_to(clone)
    for name, text in {"materials.csv": MATERIALS, "mission.yaml": MISSION.replace("  folder: out\n", ""), "box.gltf": box_gltf(),
                       "path.csv": path_csv(16), "hull.glb": box_gltf(material="Hull")}.items():
        (folder / name).write_text(text)


def run(command, folder):
    """What is wrong with a command, or nothing."""
    environment = dict(ENVIRONMENT)
    environment["PATH"] = f"{folder}/bin:{os.environ['PATH']}"
    result = subprocess.run(["bash", "-euc", command], cwd=folder, env=environment, text=True,
                            capture_output=True, stdin=subprocess.DEVNULL, timeout=300, check=False)
    return "" if result.returncode == 0 else f"{command}\n{result.stderr[-2000:]}"


class DocumentedCommands(Clone):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.commands = {page: commands_of((ROOT / page).read_text()) for page in PAGES}

    def run_page(self, page):
        """What is wrong with the commands of a page, in their order in a folder of its own."""
        folder = self.folder / pathlib.Path(page).stem
        folder.mkdir()
        fill(folder, self.clone)
        for name, text in re.findall(r"^<!-- file (\S+) -->\n```\w+\n(.*?)^```$", (self.clone / page).read_text(),
                                     re.MULTILINE | re.DOTALL):
            (folder / name).write_text(text)
        faults = [fault for command in BEFORE.get(page, ()) if (fault := run(command, folder))]
        for number, command in self.commands[page]:
            if command not in NOT_RUN and (fault := run(INSTEAD.get(command, command), folder)):
                faults.append(f"{page}:{number}: {fault}")
        return faults

    def test_each_runs(self):
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            faults = [fault for faults in pool.map(self.run_page, PAGES) for fault in faults]
        self.assertEqual(len(faults), 0, "\n".join(faults))

    def test_the_lists_name_commands_that_there_are(self):
        there = {command for commands in self.commands.values() for _, command in commands}
        self.assertGreater(len(there), 20)
        self.assertEqual((NOT_RUN.keys() | INSTEAD.keys()) - there, set())
        self.assertEqual(NOT_RUN.keys() & INSTEAD.keys(), set())

    def test_packages_are_installed_with_sudo(self):
        """Stand-ins for a user who is not root and lacks every package."""
        for name, text in (("dpkg-query", "exit 1"), ("id", "echo 1000"), ("sudo", 'echo "sudo $@"')):
            (self.folder / name).write_text(f"#!/bin/sh\n{text}\n")
            (self.folder / name).chmod(0o755)
        result = subprocess.run([self.clone / "scripts/setup.sh"], text=True, check=True, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, env={"SONARSIM_BUILD": "no", "PATH": f"{self.folder}:{os.environ['PATH']}"})
        self.assertRegex(result.stdout, r"\nsudo apt-get update .*\nsudo env .* apt-get install .* g\+\+ cmake ")


class Pages(Sandbox):
    def run_snippet(self, python, mark="", more="", folder=None):
        """What the snippet of docs/dataset.md with a mark, or the first one, prints."""
        page = (ROOT / "docs/dataset.md").read_text().split(f"<!-- {mark} -->" if mark else "# ", 1)[1]
        program = re.search(r"```python\n(.*?)```", page, re.DOTALL).group(1) + more
        return self.run_program(python, "-Bc", program, cwd=folder or self.folder,
                                env={**os.environ, "PYTHONPATH": PACKAGE, "OMP_NUM_THREADS": "1"}).stdout.splitlines()

    @unittest.skipIf(python_with("numpy") is None, "needs numpy")
    def test_every_kind(self):
        """The ranges of the columns of a waterfall are those of what it shows."""
        render = ("render", ROOT / "tests/four_sonars.yaml", "--out", "out/survey", "--set", "trajectory.rate_hz=0.5")
        self.succeeds(*render)
        lines = "\n".join(self.run_snippet(python_with("numpy")))
        for name in ("fls", "mbes", "sss", "sounder"):
            self.assertIn(name + " (", lines)
        self.succeeds(*render, "--overwrite", "--set", "output.polar=false")
        self.run_snippet(python_with("numpy"))
        # The side-scan is the last of the sensors, so its are what the loop leaves behind.
        self.edit("mission.yaml", "output:\n  folder: out\n", "  sss: {kind: sidescan, range_min_m: 0.5, range_max_m: 6.5, "
                  "range_bins: 60}\noutput:\n  folder: out/survey\n")
        self.assert_renders("--overwrite")
        more = "print(json.dumps([ranges.tolist(), pings[0].tolist()]))"
        ranges, row = json.loads(self.run_snippet(python_with("numpy"), more=more)[-1])
        self.assert_near((len(row), ranges[0], ranges[64], ranges[65], ranges[129]), (130, 6.45, 0.05, 0.05, 6.45))
        # The floor of the box is 1.5 m below, at the edge of a bin, so nothing is nearer.
        for side in (slice(0, 65), slice(65, 130)):
            self.assertAlmostEqual(min(r for r, value in zip(ranges[side], row[side]) if value > 0), 1.55, delta=0.101)

    @unittest.skipIf(not PACKAGE, "needs the compiled module")
    def test_pings_in_memory(self):
        lines = self.run_snippet(MODULE_PYTHON, "pings in memory", folder=ROOT)
        self.assertEqual((lines[0], len(lines)), ("(256, 256)", 4 + 90))

    @unittest.skipIf(not PACKAGE or subprocess.run([MODULE_PYTHON, "-c", "import torch"], capture_output=True,
                                                   check=False).returncode, "needs torch and the compiled module")
    def test_a_training_loop(self):
        lines = self.run_snippet(MODULE_PYTHON, "training loop", folder=ROOT)
        losses = [float(line.split()[-1]) for line in lines if "loss" in line]
        self.assertGreater(len(losses), 1, lines)
        self.assertLess(losses[-1], losses[0])

    def test_figures_of_the_readme(self):
        readme = (ROOT / "README.md").read_text()
        self.assertLessEqual(len(readme.split()), 850)
        self.assertIn("sixty random scenes", readme)
        self.assertIn("\nvariants: 60\n", (ROOT / "configs/detection.yaml").read_text())
        table = (ROOT / "docs/accuracy.md").read_text().split("<!-- report tank -->")[1]
        row = re.search(r"^\| strips \| relative_l1=0.03 \|(.*)$", table, re.MULTILINE).group(1)
        _, _, rate, error, *_ = [float(cell) for cell in re.findall(r"[\d.]+", row)]
        words = " ".join(readme.split())
        stated = re.search(r"on the test tank below ([\d.]+) % on average", words).group(1)
        self.assertLess(error, float(stated))
        stated = re.search(r"About ([\d,]+) images/s of 512 x 256 bins", words).group(1)
        self.assertGreater(rate, float(stated.replace(",", "")))
