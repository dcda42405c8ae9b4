"""Every value that a run uses has been set: memcheck looks on, which the sanitizers do not replace. An
image once held what the stack had in bins without an echo. Needs valgrind."""
import os
import shutil
import subprocess
import sys
import unittest

from sandbox import Sandbox

SONARSIM = os.environ["SONARSIM"]
VALGRIND = shutil.which("valgrind")
SCENES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../scenes")
FOUND = 99

COMMON = f"""\
trajectory:
  waypoints: [{{position_m: [0, 0, 1.5], rpy_deg: [0, 15, 0]}},
              {{position_m: [0.1, 0.1, 1.5], rpy_deg: [0, 15, -3]}}]
  speed_m_s: 0.1
  rate_hz: 1
output: {{folder: out, labels: true}}
scene:
  file: {SCENES}/tank.glb
  materials: {SCENES}/materials.csv
"""

PAPER = """\
sensors:
  fls: {kind: imaging, azimuth_deg: 60, elevation_deg: 12, range_max_m: 10, range_bins: 61,
        azimuth_bins: 19, noise: {add_sigma: 0.08, mult_sigma: 0.15, range_lambda_m: 0.04},
        multipath: {method: cluster}}
  mbes: {kind: profiling, azimuth_deg: 60, elevation_deg: 1, range_max_m: 10, range_bins: 61, azimuth_bins: 19}
  sss: {kind: sidescan, range_max_m: 8, range_bins: 53, noise: {add_sigma: 0.08}}
  sounder: {kind: echosounder, range_max_m: 4, range_bins: 61}
  head: {kind: scanning, range_max_m: 6, range_bins: 37}
"""

# 19 of the fish are in the fan, so their last vector is not full.
CALIBRATED = """\
  particles:
    - {name: school, class: fish, kind: fish, length_m: [0.2, 0.3], count: 25, region: ellipsoid,
       position_m: [3, 0, 1], size_m: [2, 2, 1]}
sensors:
  fls: {kind: imaging, model: calibrated, azimuth_deg: 60, elevation_deg: 12, range_max_m: 10,
        range_bins: 61, azimuth_bins: 19, multipath: {method: exact}}
  sss: {kind: sidescan, model: calibrated, range_max_m: 8, range_bins: 53, moves_in_ping: true}
  sounder: {kind: echosounder, model: calibrated, range_max_m: 4, range_bins: 61}
  head: {kind: scanning, model: calibrated, range_max_m: 6, range_bins: 37}
"""


class Memcheck(Sandbox):
    def check(self, sensors, engine):
        self.write("mission.yaml", COMMON + sensors)
        result = subprocess.run(
            [VALGRIND, "-q", f"--error-exitcode={FOUND}", "--fair-sched=yes", SONARSIM, "render", "mission.yaml",
             "--quiet", "-j1", "--overwrite", "--set", f"engine={engine}"],
            cwd=self.folder, text=True, capture_output=True, timeout=500)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_paper(self):
        for engine in ("slices", "rays", "octree"):
            self.check(PAPER, engine)

    def test_calibrated(self):
        for engine in ("slices", "rays"):
            self.check(CALIBRATED, engine)


if __name__ == "__main__":
    if VALGRIND is None or os.environ["SANITIZED"] == "1":
        print("skipped: needs valgrind and a build without sanitizers")
        sys.exit(77)
    unittest.main()
