"""Runs a tool of the package, and makes what several tests read."""
import contextlib
import json
import multiprocessing
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest
import warnings

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGE = ROOT / "apps/python"
sys.path.insert(0, str(PACKAGE))
from sonarsim.export import runs    # noqa: E402


def run(name, *words, setup=""):
    """`python3 -m sonarsim.NAME WORDS`, after the Python of `setup`, in a fork of this process, which has loaded the
    libraries."""
    program = (f"import runpy, sys\n{setup}\nsys.argv = {[name, *map(str, words)]!r}\n"
               f"runpy.run_module('sonarsim.{name}', run_name='__main__', alter_sys=True)")
    with tempfile.TemporaryFile("w+") as out, tempfile.TemporaryFile("w+") as err:
        fork = multiprocessing.get_context("fork").Process(target=become, args=(program, out, err))
        fork.start()
        fork.join()
        return subprocess.CompletedProcess(words, fork.exitcode, *(file.seek(0) or file.read() for file in (out, err)))


def become(program, out, err):
    """Runs a program with the package as it is on disk."""
    for file, number in ((out, 1), (err, 2)):
        os.dup2(file.fileno(), number)
    sys.stdout, sys.stderr = open(1, "w", closefd=False), open(2, "w", closefd=False)
    warnings.simplefilter("ignore", ResourceWarning)    # as a new process does
    for module in [one for one in sys.modules if one.partition(".")[0] == "sonarsim"]:
        del sys.modules[module]
    exec(program, {})


class ToolTest(unittest.TestCase):
    """With an empty folder of its own."""

    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory(prefix="sonarsim-")))
        self.out = self.folder / "out"

    def sonarsim(self, *words, code=0):
        result = subprocess.run([os.environ["SONARSIM"], *words], cwd=self.folder, text=True, capture_output=True, check=False)
        self.assertEqual((result.returncode, "Traceback" in result.stderr), (code, False), result.stderr)
        return result

    def render_tank(self, out, *settings):
        """Renders a fan and the records of other sonars in the tank, with objects."""
        fls = "{kind: imaging, azimuth_deg: 60, elevation_deg: 12, range_max_m: 8, range_bins: 64, azimuth_bins: 32, every: 2}"
        settings = f"sensors.fls={fls}", "labels.background=[none]", "output={labels: [objects]}", *settings
        self.sonarsim("render", ROOT / "tests/golden/missions/records.yaml", "--paths-from", ROOT / "configs", "-q", "--out",
                      out, *(f"--set={setting}" for setting in settings))

    def succeeds(self, name, *words):
        """What it prints; it has nothing to warn of."""
        result = run(name, *words)
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        return result.stdout

    def assert_refused(self, name, text, *words, code=2, setup=""):
        """One sentence, the exit code, and nothing written."""
        before = sorted(self.folder.rglob("*"))
        result = run(name, *words, setup=setup)
        self.assertEqual((result.returncode, result.stdout), (code, ""), result.stderr)
        self.assertRegex(result.stderr, f"^sonarsim {name.replace('_', '-')}: [^\n]*{text}[^\n]*\n$")
        self.assertEqual(sorted(self.folder.rglob("*")), before)


@contextlib.contextmanager
def edited(path):
    """The content of a JSON file, to be changed."""
    content = json.loads(path.read_text())
    yield content
    path.write_text(json.dumps(content))


@contextlib.contextmanager
def replaced(path, text):
    """A file has other content meanwhile."""
    sound = path.read_text()
    path.write_text(text)
    yield
    path.write_text(sound)


def write_recording(folder, values, law, **keys):
    """The array of a fan's pings and its recording.yaml."""
    np.save(folder / "pings.npy", values)
    (folder / "recording.yaml").write_text(json.dumps({
        "kind": "imaging", "files": "pings.npy", "law": law, "sound_speed_m_s": 1500, "first_range_m": 1, "range_step_m": 0.01,
        "bearing_first_deg": -30, "bearing_last_deg": 30, "rate_hz": 10, **keys}))


def sensor(name, kind, pings, **more):
    """The description of a sensor in dataset.json."""
    return {"name": name, "kind": kind, "every": 1, "pings": pings, "range_edges_m": [], "full_scale": 1.0, "files": {}, **more}


def write_description(folder, poses, sensors, **more):
    """dataset.json and trajectory.tum of a complete dataset; returns what dataset.json holds."""
    description = {"format": "sonarsim dataset", "format_version": 3, "program_version": "0", "complete": True, "poses": poses,
                   "sensors": sensors, **more}
    (folder / "dataset.json").write_text(json.dumps(description))
    (folder / "trajectory.tum").write_text("0 0 0 0 0 0 0 1\n" * poses)
    return description


def disc(width, height, x, y, radius):
    rows, columns = np.mgrid[:height, :width]
    return (columns - x) ** 2 + (rows - y) ** 2 <= radius ** 2


def counts_of(mask):
    """COCO's compressed text of a mask [row, column]."""
    return runs.counts_of(np.flatnonzero(mask.T), *mask.shape[::-1])


def mask_of(counts, width, height):
    """The mask of such a text, by a reader of its own."""
    runs, at = [], 0
    while at < len(counts):
        value, shift, more = 0, 0, True
        while more:
            code = ord(counts[at]) - 48
            at, more = at + 1, code & 32
            value |= (code & 31) << shift
            shift += 5
            if not more and code & 16:
                value -= 1 << shift
        runs.append(value + (runs[-2] if len(runs) > 2 else 0))
    assert sum(runs) == width * height and min(runs[1:], default=1) > 0, counts
    flat = np.repeat(np.arange(len(runs)) % 2, runs)
    return flat.reshape(width, height).T.astype(bool)
