"""The program under valgrind and on other processors. Memcheck finds values that are used and not set, which the sanitizers
do not: an image once held what the stack had in bins without an echo. Needs valgrind and qemu-x86_64 (Debian: qemu-user)."""
import shutil
import sys
import unittest

from sandbox import ROOT, SANITIZED, SONARSIM, Sandbox, box_mesh, digest, gltf, sheet_mesh

VALGRIND, QEMU = shutil.which("valgrind"), shutil.which("qemu-x86_64")
if SANITIZED or not (VALGRIND or QEMU):
    sys.exit(77)

SCENE = f"""\
trajectory:
  waypoints: [{{position_m: [0, 0, 1.5], rpy_deg: [0, 15, 0]}}, {{position_m: [0.1, 0.1, 1.5], rpy_deg: [0, 15, -3]}}]
  speed_m_s: 0.1
  rate_hz: 1
output: {{folder: out, labels: true}}
scene:
  file: {ROOT}/scenes/tank.glb
  materials: {ROOT}/scenes/materials.csv
"""
PAPER = """\
sensors:
  fls: {kind: imaging, azimuth_deg: 60, elevation_deg: 12, range_max_m: 10, range_bins: 61,
        azimuth_bins: 19, noise: {add_sigma: 0.08, mult_sigma: 0.15, range_lambda_m: 0.04},
        multipath: {method: cluster}}
  mbes: {kind: profiling, azimuth_deg: 60, elevation_deg: 1, range_max_m: 10, range_bins: 61, azimuth_bins: 19}
  sss: {kind: sidescan, range_max_m: 8, range_bins: 53, noise: {add_sigma: 0.08}}
"""
# 19 of the fish are in the fan, so their last vector is not full.
CALIBRATED = """\
  particles:
    - {name: school, class: fish, length_m: [0.2, 0.3], count: 25, region: ellipsoid,
       position_m: [3, 0, 1], size_m: [2, 2, 1]}
sensors:
  fls: {kind: imaging, model: calibrated, azimuth_deg: 60, elevation_deg: 12, range_max_m: 10,
        range_bins: 61, azimuth_bins: 19, multipath: {method: exact}}
  sounder: {kind: echosounder, model: calibrated, range_max_m: 4, range_bins: 61}
  head: {kind: scanning, model: calibrated, range_max_m: 6, range_bins: 37, moves_in_ping: true}
"""


@unittest.skipIf(VALGRIND is None, "needs valgrind")
class Memcheck(Sandbox):
    def test_memcheck(self):
        """The first ping is rendered without valgrind, and with it the error, which the second run then reads."""
        for engine, text in (("octree", PAPER), ("strips", PAPER), ("rays", CALIBRATED)):
            with self.subTest(engine=engine, text=text):
                self.write("mission.yaml", SCENE + text)
                shutil.rmtree(self.out, ignore_errors=True)
                self.assert_renders("--shard", "1/2", "--set", f"engine={engine}")
                self.run_program(VALGRIND, "-q", "--error-exitcode=99", "--fair-sched=yes", SONARSIM, "render",
                                 "mission.yaml", "--quiet", "-j1", "--shard", "2/2", "--set", f"engine={engine}", timeout=500)
                self.assertTrue(self.dataset()["complete"])


@unittest.skipIf(QEMU is None, "needs qemu-x86_64")
class Processor(Sandbox):
    """The emulator is another make of processor: what the manual leaves open, above all the
    estimates of roots and reciprocals (rsqrtps, rcpps), it rounds in a way of its own."""

    def test_without_avx2(self):
        result = self.run_program(QEMU, "-cpu", "IvyBridge", SONARSIM, "--version", code=1)
        self.assertEqual(result.stdout, "")
        self.assertIn("this processor lacks AVX2", result.stderr)

    def test_the_same_bytes(self):
        """A shard by the processor and the rest by the emulator make the dataset of one run, arrays of floats included, whose
        last bit an image of integers may hide; also where faces coincide: two boxes in one place stand on a floor."""
        nodes = [{"name": "floor", "mesh": 0}] + [{"name": name, "mesh": 1, "translation": [x, 0.5, y]}
            for name, x, y in (("box", 4.03, 0.07), ("twin", 4.03, 0.07), ("other", 2.5, 1))]
        self.write("box.gltf", gltf(nodes, [sheet_mesh(), (*box_mesh()[:2], 1)], ("Concrete", "steel")))
        head = SCENE.split("scene:")[0] + "scene: {file: box.gltf, materials: materials.csv}\n"
        echo = "  echo: {kind: echosounder, model: calibrated, range_max_m: 4, range_bins: 61}\n"
        for engine, sensors in (("strips", PAPER + echo), ("rays", PAPER + echo), ("octree", PAPER)):
            self.write("mission.yaml", head + sensors)
            setting = ("-j1", "--set", f"engine={engine}")
            whole = self.render_whole("--overwrite", *setting)
            self.assert_renders("--shard", "1/2", *setting)
            self.run_program(QEMU, "-cpu", "max", SONARSIM, "render", "mission.yaml", "--quiet", *setting, timeout=500)
            self.assertEqual(digest(self.out), whole, engine)
