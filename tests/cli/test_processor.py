"""Processors: one that cannot run the program gets a sentence, all others get the same bytes. Needs
qemu-x86_64 (Debian: qemu-user)."""
import os
import shutil
import subprocess
import sys
import unittest

from sandbox import Sandbox, digest

SONARSIM = os.environ["SONARSIM"]
QEMU = shutil.which("qemu-x86_64")
TANK = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../scenes")

# What is written as floats shows a last bit that differs, where an image of integers may hide it.
MISSION = f"""\
name: two_processors
scene: {{file: {TANK}/tank.glb, materials: {TANK}/materials.csv}}
trajectory:
  waypoints: [{{position_m: [0, 0, 1.5], rpy_deg: [0, 15, 0]}},
              {{position_m: [0.1, 0.1, 1.5], rpy_deg: [0, 15, -3]}}]
  speed_m_s: 0.1
  rate_hz: 1
sensors:
  fls: {{kind: imaging, model: calibrated, azimuth_deg: 60, elevation_deg: 12, range_max_m: 10,
        range_bins: 128, azimuth_bins: 32, multipath: {{method: cluster}}}}
  sss: {{kind: sidescan, range_max_m: 8, range_bins: 200,
        noise: {{add_sigma: 0.08, mult_sigma: 0.15}}}}
  sounder: {{kind: echosounder, range_max_m: 4, range_bins: 200}}
output: {{folder: out}}
"""


def version_on(processor):
    return subprocess.run([QEMU, "-cpu", processor, SONARSIM, "--version"], text=True,
                          capture_output=True, timeout=300)


class Processor(unittest.TestCase):
    def test_without_avx2(self):
        for processor in ("Nehalem", "IvyBridge"):
            result = version_on(processor)
            self.assertEqual((result.returncode, result.stdout), (1, ""), processor)
            self.assertIn("this processor lacks AVX2", result.stderr)
            ours = [line for line in result.stderr.splitlines() if not line.startswith("qemu")]
            self.assertEqual(len(ours), 1, result.stderr)

    def test_with_all_that_the_emulator_has(self):
        result = version_on("max")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(result.stdout.startswith("sonarsim "), result.stdout)


class SameBytes(Sandbox):
    """The emulator is another make of processor: what the manual leaves open, above all the
    estimates of roots and reciprocals (rsqrtps, rcpps), it rounds in a way of its own."""

    def test_slices_and_rays(self):
        self.write("mission.yaml", MISSION)
        for engine in ("slices", "rays"):
            made = []
            for program in ([SONARSIM], [QEMU, "-cpu", "max", SONARSIM]):
                result = subprocess.run(
                    [*program, "render", "mission.yaml", "--quiet", "-j1", "--set",
                     f"engine={engine}"], cwd=self.folder, text=True, capture_output=True,
                    timeout=300)
                self.assertEqual(result.returncode, 0, result.stderr)
                made.append(digest(self.out))
                shutil.rmtree(self.out)
            self.assertEqual(made[0], made[1], engine)


if __name__ == "__main__":
    if QEMU is None or os.environ["SANITIZED"] == "1":
        print("skipped: needs qemu-x86_64 and a build without sanitizers")
        sys.exit(77)
    unittest.main()
