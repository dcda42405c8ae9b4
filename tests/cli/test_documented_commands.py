"""The commands of README.md, CONTRIBUTING.md and docs/*.md do what they say: every line of a code block
that is a command is run, with the program under test and on small input, or stands in NOT_RUN with the
reason."""
import concurrent.futures
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

import clean_clone
from sandbox import IN_MEMORY, MATERIALS, MISSION, SONARSIM, box_gltf, path_csv, python_with

PAGES = ("README.md", "CONTRIBUTING.md", *(f"docs/{path.name}" for path in sorted((clean_clone.ROOT / "docs").glob("*.md"))))

# How a command begins: variables, then a script of the repository or a program.
BEGINS = re.compile(r"""(?:[A-Z_]+=(?:"[^"]*"|\S+)\ )*
                    (?:\./|\.ci/|scripts/|build/|build-release/|for\ \w+\ in\ [^:;]*;\ do|
                    (?:sonarsim|/usr/bin/python3|make|parallel|mkdir|ln|cd|cp|sudo|apt|python3|cmake|git|ctest|yolo)\ )""", re.VERBOSE)

HOURS = "takes hours, or needs an idle machine"
CI = "CI runs it: builds the program anew"
NOT_RUN = {
    "./scripts/test.sh": "runs this test",
    "SONARSIM_PRESET=asan ./scripts/test.sh": CI,
    "SONARSIM_PRESET=tsan ./scripts/test.sh": CI,
    ".ci/run": "runs this test",
    "ctest --test-dir build-release -R cli.render": "runs another test",
    'build-release/tests/sonarsim_tests -tc="*part of a name*"': "names no test",
    "yolo detect train model=yolo11n.pt data=detection/data.yaml": "needs Ultralytics, which is not part of sonarsim",
    "./scripts/fuzz.sh 60": CI,
    "./scripts/tidy.sh": CI,
    "./scripts/compilers.sh": CI,
    "./scripts/debian13.sh": "makes a chroot, and builds the program there",
    "./scripts/package.sh": CI,
    "./scripts/package.sh && sudo apt install ./build-package/sonarsim_*.deb": CI,
    "./scripts/report.sh": HOURS,
    'SCENES="tank seafloor wreck lifeboat motorbike" ./scripts/report.sh': HOURS,
    "./scripts/same_sums.sh PROGRAM": "takes minutes; test_clusters.py and test_merge.py compare the same sums",
    "sonarsim calibrate out/real --preset gemini_720is --out mine.yaml --report mine.json":
        "needs pings of a real sonar",
    **{f"sonarsim calibrate out/{name} --out fit.yaml": "needs pings that belong to others"
       for name in ("oculus --preset oculus_m1200d_2100khz_10m --judge 0.34",
                    "oculus --preset oculus_m1200d_2100khz_10m --judge 0.34 --reverse",
                    "r2sonic --preset bathymetric_400khz")},
    "scripts/before_after.py build/sonarsim out/before_after":
        "writes pictures into docs, in a minute, and needs python3-pil",
    "scripts/stage_costs.py": HOURS,
    "build-release/tests/hard_cases": "takes minutes; tests/hard runs the same catalogue",
    "scripts/slurm/render.sh 64 mission.yaml out/big --time=60 --cpus-per-task=4":
        "needs Slurm; test_clusters.py runs it with a stand-in",
    "parallel sonarsim render mission.yaml --threads 1 --shard {}/4 --out part{} ::: $(seq 4)":
        "needs GNU parallel",
}
PYTHON = python_with("matplotlib")

# What is run in place of a command that is too large, has place-holders or would find its output there.
TINY = "--set sensors.fls.range_bins=64 --set sensors.fls.azimuth_bins=64"
QUICK = ("--quick --poses 1 --reference-rays 1000000 "
         "--set sensors.fls.range_bins=32 --set sensors.fls.azimuth_bins=16")
FEW = f"--set trajectory.rate_hz=1 {TINY}"
INSTEAD = {
    "./scripts/render.sh configs/tank_imaging.yaml": f"./scripts/render.sh configs/tank_imaging.yaml {FEW}",
    "./scripts/render.sh configs/sediment_maps.yaml":
        "./scripts/render.sh configs/sediment_maps.yaml --set trajectory.rate_hz=0.5",
    "./scripts/render.sh configs/detection.yaml":
        f"./scripts/render.sh configs/detection.yaml --set variants=2 --set trajectory.rate_hz=0.5 {TINY}"
        # Sixty fields of ten images.
        " && grep -q '^variants: 60$' configs/detection.yaml && sonarsim validate configs/detection.yaml "
        "--set variants=1 --out out/sixty --json | grep '\"pings\":10,'",
    "sonarsim report mission.yaml --out out/report":
        f"sonarsim report mission.yaml --engines slices {QUICK} --out out/report",
    "build/sonarsim validate hull.yaml && build/sonarsim render hull.yaml":
        f"build/sonarsim validate hull.yaml {FEW} && build/sonarsim render hull.yaml {FEW}",
    "sonarsim render /usr/share/sonarsim/configs/tank_imaging.yaml":
        f"sonarsim render share/sonarsim/configs/tank_imaging.yaml {FEW} --out out/installed",
    "sonarsim report configs/tank_calibrated.yaml --engines slices --quick":
        f"sonarsim report configs/tank_calibrated.yaml --engines slices {QUICK}",
    "sonarsim report configs/tank_calibrated.yaml --engines slices --quick "
    "--set sensors.fls.instrument.speckle.mode=ping":
        "sonarsim report configs/tank_calibrated.yaml --engines slices "
        f"--set sensors.fls.instrument.speckle.mode=ping {QUICK}",
    'make -f scripts/sweep.mk -j2 MISSION=configs/tank_imaging.yaml OUT=out/sweep '
    'sensors.fls.range_max_m="6 10" seed="1 2"':
        'make -f scripts/sweep.mk -j2 MISSION=configs/tank_imaging.yaml OUT=out/sweep '
        'sensors.fls.range_max_m="6 10" seed="1 2" trajectory.rate_hz=1 sensors.fls.range_bins=64',
    "RANDOM_MISSIONS=1000 RANDOM_SEED=7 SANITIZED=0 SONARSIM=$PWD/build/sonarsim /usr/bin/python3 -B "
    "tests/cli/test_random_missions.py":
        "RANDOM_MISSIONS=2 RANDOM_SEED=7 SANITIZED=0 SONARSIM=$PWD/build/sonarsim /usr/bin/python3 -B "
        "tests/cli/test_random_missions.py",
    "./scripts/same_bytes.py PROGRAM PROGRAM":
        "./scripts/same_bytes.py --mission mission.yaml build/sonarsim build/sonarsim",
    "sonarsim render configs/tank_detection.yaml --out OUT":
        f"sonarsim render configs/tank_detection.yaml --set trajectory.rate_hz=8 {TINY} --out OUT",
    "sonarsim inspect crane.glb --materials crane.csv":
        "cp scenes/materials.csv crane.csv; sonarsim inspect crane.glb --materials crane.csv",
    "for n in 0 1 2 3; do scripts/make_scenes.py lifeboat --quarterings $n --out out/lifeboat_$n; done":
        "for n in 0 3; do "
        "scripts/make_scenes.py lifeboat --quarterings $((n / 3)) --out out/lifeboat_$n; done",
    "sonarsim report configs/lifeboat_imaging.yaml --set scene.file=$PWD/out/lifeboat_3/lifeboat.glb "
    "--out out/report":
        "sonarsim report configs/lifeboat_imaging.yaml --set scene.file=$PWD/out/lifeboat_3/lifeboat.glb "
        f"--out out/report --engines slices {QUICK}",
    **{f"sonarsim render configs/tank_calibrated.yaml --set seed={seed} --out out/{name}":
       f"sonarsim render configs/tank_calibrated.yaml --set seed={seed} --out out/{name} --set trajectory.rate_hz=1 "
       "--set sensors.fls.range_bins=128 --set sensors.fls.azimuth_bins=64" for seed, name in ((1, "one"), (2, "two"))},
    "sonarsim preview mission.yaml [--ping N] [--out FILE.png]":
        "sonarsim preview mission.yaml --ping 1 --out FILE.png",
}

# What a page takes for granted.
SHARDS = "for i in $(seq {0}); do sonarsim render mission.yaml -q --shard $i/{0} --out {1}$i; done"
MINEFIELD = ("scripts/make_scenes.py --for configs/minefield_variants.yaml",
             "sonarsim render configs/minefield_variants.yaml -q --set variants=2 "
             f"--set trajectory.rate_hz=4 --set sensors.sss.range_bins=64 {TINY}")
BEFORE = {
    "README.md": (INSTEAD["build/sonarsim validate hull.yaml && build/sonarsim render hull.yaml"],
                  SHARDS.format(2, "PART")),
    "docs/dataset.md": (INSTEAD["sonarsim render configs/tank_detection.yaml --out OUT"],
                        "for name in tank wreck harbour; do "
                        "sonarsim render mission.yaml -q --set name=$name --out out/$name; done"),
    "docs/running.md": (SHARDS.format(4, "part"),),
    "docs/pictures.md": ("sonarsim render mission.yaml -q --out OUT",),
    "docs/scenes.md": MINEFIELD,
    "docs/export.md": MINEFIELD,
}

SCENARIO = '{"agents": [{"sensors": [{"sensor_type": "ImagingSonar", "configuration": {"RangeMax": 6}}]}]}'
LINKED = ("configs", "docs", "scenes", "scripts", "tests", "trajectories")


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
    (folder / "build-release").symlink_to(pathlib.Path(SONARSIM).parent)
    if PYTHON is not None:
        (folder / "bin/python3").symlink_to(PYTHON)
    (folder / "share").mkdir()
    (folder / "share/sonarsim").symlink_to(clone)
    readme = (clone / "README.md").read_text()
    (folder / "hull.yaml").write_text(re.search(r"```yaml\n(.*?)```", readme, re.DOTALL).group(1))
    (folder / "materials.csv").write_text(MATERIALS + re.search(r"\n    (Hull,.*\n)", readme).group(1))
    (folder / "mission.yaml").write_text(MISSION.replace("  folder: out\n", ""))
    (folder / "box.gltf").write_text(box_gltf())
    (folder / "hull.glb").write_text(box_gltf(material="Hull"))
    (folder / "path.csv").write_text(path_csv(16))
    for name in ("scene.glb", "crane.glb"):
        (folder / name).symlink_to(clone / "scenes/tank.glb")
    for name in ("S.json", "scenario.json"):
        (folder / name).write_text(SCENARIO)


def run(command, folder):
    """What is wrong with a command, or nothing. Tests of C++ run by themselves: their names are listed here."""
    if "build-release/tests/" in command:
        command += " --list-test-cases | grep 'filters: [1-9]'"
    environment = {name: value for name, value in os.environ.items()
                   if not name.startswith(("MAKE", "MFLAGS", "SLURM_"))}
    environment["PATH"] = f"{folder}/bin:{os.environ['PATH']}"
    result = subprocess.run(["bash", "-euc", command], cwd=folder, env=environment, text=True,
                            capture_output=True, stdin=subprocess.DEVNULL, timeout=300, check=False)
    return "" if result.returncode == 0 else f"{command}\n{result.stderr[-2000:]}"


class DocumentedCommands(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory(prefix="sonarsim-", dir=IN_MEMORY)
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = pathlib.Path(temporary.name)
        cls.clone = cls.folder / "clone"
        cls.clone.mkdir()
        if os.environ.get("SANITIZED") == "1":
            raise unittest.SkipTest("the sanitizers see in other tests what these commands run")
        if not clean_clone.clone_to(cls.clone):
            raise unittest.SkipTest("this is no checkout of git")
        cls.commands = {page: commands_of((clean_clone.ROOT / page).read_text()) for page in PAGES}

    def run_page(self, page):
        """What is wrong with the commands of a page, in their order in a folder of its own."""
        folder = self.folder / pathlib.Path(page).stem
        folder.mkdir()
        fill(folder, self.clone)
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
        self.assertGreater(len(there), 40)
        self.assertEqual((NOT_RUN.keys() | INSTEAD.keys()) - there, set())
        self.assertEqual(NOT_RUN.keys() & INSTEAD.keys(), set())

    def test_packages_are_installed_with_sudo(self):
        """Stand-ins for a user who is not root and lacks every package."""
        for name, text in (("dpkg-query", "exit 1"), ("id", "echo 1000"), ("sudo", 'echo "sudo $@"')):
            (self.folder / name).write_text(f"#!/bin/sh\n{text}\n")
            (self.folder / name).chmod(0o755)
        result = subprocess.run([self.clone / "scripts/setup.sh"], text=True, check=True, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, env={"SONARSIM_BUILD": "no",
                                                               "PATH": f"{self.folder}:{os.environ['PATH']}"})
        self.assertRegex(result.stdout, r"\nsudo apt-get update .*\nsudo env .* apt-get install .* g\+\+ cmake ")

    def test_what_is_a_command(self):
        self.assertEqual(commands_of("text\n\n    sonarsim keys     prints keys\n    A=1 ./x.sh # why\n    I = R\n"
                                     "```python\nfor a in b:\n```\n```sh\nmake -f x \\\n    b=1\n```\n"),
                         [(3, "sonarsim keys"), (4, "A=1 ./x.sh"), (10, "make -f x b=1")])


if __name__ == "__main__":
    unittest.main()
