"""A signal is obeyed within about a second, whatever the program does when it comes. Each test brings
the program into a phase that lasts much longer than that."""
import os
import pathlib
import shutil
import signal
import subprocess
import time
import unittest

from sandbox import SONARSIM, Sandbox, copies_gltf, digest, path_csv

FAULTY_DISK = os.environ["FAULTY_DISK"]
SANITIZED = os.environ["SANITIZED"] == "1"

ALL_PRODUCTS = """\
name: products
seed: 7
scene: {file: box.gltf, materials: materials.csv}
trajectory: {file: path.csv}
sensors:
  mbes: {kind: profiling, range_max_m: 6, range_bins: 16, azimuth_bins: 8}
  sss: {kind: sidescan, range_max_m: 6, range_bins: 16}
output: {folder: out}
"""


def catches_sigterm(process):
    for line in pathlib.Path(f"/proc/{process.pid}/status").read_text().splitlines():
        if line.startswith("SigCgt:"):
            return int(line.split()[1], 16) >> (signal.SIGTERM - 1) & 1 == 1
    return False


def busy_s(pid):
    """The processor time that a process has had so far; 0 when it is gone."""
    try:
        fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    except (FileNotFoundError, ProcessLookupError):
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Signals(Sandbox):
    def wait_for(self, holds, process=None):
        for _ in range(6000):
            if holds():
                return
            if process is not None:
                self.assertIsNone(process.poll(), "ended before it came to the phase")
            time.sleep(0.02)
        self.fail("never came to the phase")

    def start(self, *arguments, **environment):
        return subprocess.Popen([SONARSIM, *arguments], cwd=self.folder, text=True,
                                env={**os.environ, **environment}, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE)

    def assert_ends_at_once(self, process, number):
        """The phase goes on for long, so that only the end at once can say these words."""
        process.send_signal(number)
        _, stderr = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 128 + number, stderr)
        self.assertIn("warning: stopped at once; written files are complete; run the same command "
                      "again to continue", stderr)

    def test_while_a_scene_is_loaded(self):
        # Triangles without area take time and no memory.
        self.write("box.gltf", copies_gltf(1000 if SANITIZED else 10000, 70, flat=0.0))
        for number in (signal.SIGTERM, signal.SIGINT):
            with self.subTest(number=number), self.start("render", "mission.yaml") as process:
                self.wait_for(lambda: catches_sigterm(process), process)
                self.assert_ends_at_once(process, number)
                self.assertFalse(self.out.exists())

    @unittest.skipIf(SANITIZED, "such a scene takes too much memory under a sanitizer")
    def test_while_the_engine_is_built(self):
        self.write("box.gltf", copies_gltf(600, 70))
        with self.start("render", "mission.yaml", "-j1", "--set", "engine=slices") as process:
            self.assertIn("5880000 triangles", process.stderr.readline())
            self.assert_ends_at_once(process, signal.SIGTERM)

    def test_during_a_long_ping(self):
        settings = ("azimuth_bins=3072", "azimuth_deg=360", "elevation_deg=160",
                    "multipath.method=exact")
        changed = [word for s in settings for word in ("--set", "sensors.fls." + s)]
        with self.start("render", "mission.yaml", "-j1", *changed,
                        "--set", "accuracy.relative_l1=1e-4", "--set", "output.fan=false",
                        "--set", "engine=rays") as process:
            self.wait_for(lambda: (self.out / "dataset.json").exists(), process)
            begun = busy_s(process.pid)
            self.wait_for(lambda: busy_s(process.pid) > begun + 0.5, process)
            self.assert_ends_at_once(process, signal.SIGTERM)
        self.assertFalse(self.dataset()["complete"])

    def test_during_the_products(self):
        self.write("mission.yaml", ALL_PRODUCTS)
        log = self.folder / "calls"
        disk = {"LD_PRELOAD": FAULTY_DISK, "FAULTY_DISK_BELOW": str(self.out),
                "FAULTY_DISK_LOG": str(log)}
        self.assert_renders("-j1", env={**os.environ, **disk, "FAULTY_DISK_MODE": "none",
                                        "FAULTY_DISK_CALL": "0"})
        whole = digest(self.out)
        calls = log.read_text().splitlines()
        for name in ("soundings.csv", "bathymetry.tif", "waterfall.png"):
            number = next(i for i, call in enumerate(calls, 1)
                          if call.split()[0] in ("fwrite", "write", "fopen") and name in call)
            with self.subTest(name=name):
                shutil.rmtree(self.out)
                log.unlink(missing_ok=True)
                with self.start("render", "mission.yaml", "-j1", FAULTY_DISK_MODE="stall",
                                FAULTY_DISK_CALL=str(number), **disk) as process:
                    self.wait_for(lambda: log.exists() and
                                  log.read_text().count("\n") >= number, process)
                    self.assert_ends_at_once(process, signal.SIGTERM)
                self.assertFalse(self.dataset()["complete"])
                self.assert_renders()
                self.assertEqual(digest(self.out), whole)

    def test_during_a_report(self):
        self.write("path.csv", path_csv(2))
        with self.start("report", "mission.yaml") as process:
            self.wait_for(lambda: busy_s(process.pid) > 0.5, process)
            process.send_signal(signal.SIGTERM)
            process.communicate(timeout=120)
            self.assertEqual(process.returncode, -signal.SIGTERM)


if __name__ == "__main__":
    unittest.main()
