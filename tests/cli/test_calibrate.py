"""sonarsim calibrate: a preset from pings that are speckle alone, and what is refused."""
import array
import json
import math
import random
import unittest

from sandbox import Sandbox

RANGES, BEAMS, PINGS = 240, 96, 4
GAMMA = 0.5
RECORDING = """\
kind: imaging
files: pings.npy
law: {kind: gamma, exponent: 0.5, full_value: 255}
sound_speed_m_s: 1480
first_range_m: 1.01
range_step_m: 0.02
bearing_first_deg: -24
bearing_last_deg: 24
spread: sine
rate_hz: 10
"""
START = """\
kind: imaging
model: calibrated
azimuth_deg: 48  # sheet
instrument:
  frequency_hz: 1e6  # sheet
  beam:
    width_deg: 1  # sheet
  receiver:
    gamma: 0.9  # rule
"""


def npy(values, shape):
    """The bytes of an array of uint8."""
    head = f"{{'descr': '|u1', 'fortran_order': False, 'shape': {shape}, }}"
    head += " " * (63 - (10 + len(head)) % 64) + "\n"
    return b"\x93NUMPY\x01\x00" + array.array("H", [len(head)]).tobytes() + head.encode() + bytes(values)


def speckle(seed):
    """A ping of noise behind TVG: complex normal numbers, each the mean of two neighbours along range."""
    draw = random.Random(seed)
    values = []
    before = [complex(draw.gauss(0, 1), draw.gauss(0, 1)) for _ in range(BEAMS)]
    for row in range(RANGES):
        now = [complex(draw.gauss(0, 1), draw.gauss(0, 1)) for _ in range(BEAMS)]
        level = 0.03 * (1.01 + 0.02 * row)  # 20 log r
        values += [min(255, int(255 * (level * abs(a + b) / 2) ** GAMMA + 0.5)) for a, b in zip(before, now)]
        before = now
    return values


class Calibrate(Sandbox):
    def write_pings(self, pings, count=PINGS):
        folder = self.folder / "real"
        folder.mkdir(exist_ok=True)
        (folder / "recording.yaml").write_text(RECORDING)
        (folder / "pings.npy").write_bytes(npy(pings, (count, RANGES, BEAMS)))
        self.write("start.yaml", START)

    def calibrate(self, *arguments, preset="start.yaml"):
        return self.run_sonarsim("calibrate", "real", "--preset", preset, "--out", "mine.yaml", *arguments)

    def test_a_preset_is_written_and_loads(self):
        self.write_pings([v for seed in range(PINGS) for v in speckle(seed)])
        result = self.calibrate("--report", "mine.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("real: 2 pings fitted, 2 judged", result.stdout)
        self.assertIn("cannot be separated here", result.stdout)
        reported = json.loads((self.folder / "mine.json").read_text())
        gamma = reported["estimates"]["receiver.gamma"]
        self.assertLess(abs(gamma["value"] - GAMMA), 0.03)
        self.assertLess(gamma["low"], gamma["value"])
        self.assertGreater(reported["agree"]["held_out"], reported["agree"]["start"])
        preset = (self.folder / "mine.yaml").read_text()
        self.assertRegex(preset, r"\n    gamma: 0\.\d+  # fit: 0\.\d+ to 0\.\d+\n")
        self.assertIn("\n  frequency_hz: 1e6  # sheet\n", preset)
        self.assertIn("\nrange_bins: 240  # file", preset)
        self.assertEqual(self.run_sonarsim("preset", "mine.yaml").returncode, 0)
        self.assertEqual(json.loads(self.calibrate("--json").stdout), reported)
        self.assertEqual(self.calibrate("-q").stdout, "")

    def test_what_is_refused(self):
        pings = speckle(1)
        self.write_pings(pings, 1)
        self.assert_refused(self.calibrate(), "1 ping:", "takes two or more")
        self.write_pings([0] * len(pings) * 2, 2)
        self.assert_refused(self.calibrate(), "it is empty")
        self.write_pings([min(255, 6 * v) for v in pings + speckle(2)], 2)
        self.assert_refused(self.calibrate(), "saturated")
        landscape = [int(120 + 60 * math.sin(0.05 * i) * math.cos(0.08 * j)) for i in range(RANGES) for j in range(BEAMS)]
        self.write_pings(landscape * 2, 2)
        self.assert_refused(self.calibrate(), "photograph")
        self.write_pings(pings * 2, 2)
        self.write("side.yaml", START.replace("imaging", "profiling"))
        self.assert_refused(self.calibrate(preset="side.yaml"), "another kind")
        self.assert_refused(self.calibrate(preset="nobody"), "no preset of this name")
        self.write("start.yaml", "kind: imaging\n")
        self.assert_refused(self.calibrate(), "only model: calibrated has an instrument")
        self.assertFalse((self.folder / "mine.yaml").exists())


if __name__ == "__main__":
    unittest.main()
