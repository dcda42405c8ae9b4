"""raw.npy of side-scans, echosounders and scanning sonars: what the instrument of the calibrated model
delivers, the same from shards, and its pictures."""
import os
import sys
import unittest

from sandbox import Sandbox, digest, path_csv, python_with

try:
    import numpy as np
    sys.path.insert(0, os.path.join(os.path.dirname(__file__), "../../apps/python"))
    from sonarsim import data as sonarsim_data
except ImportError:
    # Debian's numpy belongs to Debian's Python.
    python = python_with("numpy")
    if python is None or python == sys.executable:
        print("needs numpy")
        sys.exit(77)
    os.execv(python, [python, "-B", __file__])

POSES = 7
STEPS = 4       # of the head, so that its second sweep is not finished
MISSION = f"""\
name: raw
seed: 7
scene: {{file: box.gltf, materials: materials.csv}}
trajectory: {{file: path.csv}}
sensors:
  sss: {{kind: sidescan, model: calibrated, elevation_deg: 4, range_min_m: 1, range_max_m: 6,
        range_bins: 20, instrument: {{receiver: {{noise_db: -100, full_scale_db: -20,
        companding: gamma}}}}}}
  sounder: {{kind: echosounder, model: calibrated, range_max_m: 6, range_bins: 16, instrument:
            {{receiver: {{noise_db: -100, full_scale_db: -5, companding: linear, bits: 16}}}}}}
  head: {{kind: scanning, model: calibrated, azimuth_deg: 10, step_deg: {360 // STEPS},
         range_max_m: 6, range_bins: 16, instrument: {{beam: {{width_deg: 3}}, receiver:
         {{noise_db: -100, full_scale_db: -20, companding: log, dynamic_range_db: 90,
         bits: 12}}}}}}
output: {{folder: out}}
"""


def companded(power, receiver, bits):
    """What lib/calibrated/companding.h says, before it is rounded."""
    amplitude = np.sqrt(np.minimum(power.astype(np.float64), 1))
    with np.errstate(divide="ignore"):
        value = {"gamma": lambda: amplitude ** 0.5, "linear": lambda: amplitude,
                 "log": lambda: np.maximum(0, 1 + 20 * np.log10(amplitude) / 90)}[receiver]()
    return (2 ** bits - 1) * value


class RawRecords(Sandbox):
    def setUp(self):
        super().setUp()
        self.write("mission.yaml", MISSION)
        self.write("path.csv", path_csv(POSES))

    def test_records_and_pictures(self):
        self.assert_renders()
        dataset = sonarsim_data.open_dataset(self.out)
        for name, echoes, law, bits in (("sss", "waterfall", "gamma", 8),
                                        ("sounder", "echogram", "linear", 16),
                                        ("head", "scan", "log", 12)):
            with self.subTest(sensor=name):
                sensor = dataset[name]
                raw, power = sensor.records("raw"), sensor.records(echoes)
                self.assertEqual(raw.dtype, np.uint16 if bits > 8 else np.uint8)
                self.assertEqual(raw.shape, power.shape)
                self.assertEqual(sensor.axes("raw")[0], sensor.axes(echoes)[0])
                self.assertLessEqual(np.abs(raw - companded(power, law, bits)).max(), 0.51)
                self.assertGreater(raw.max(), 2 ** bits // 10)
                self.assertGreater(len(np.unique(raw)), 20)
                np.testing.assert_array_equal(sensor[2]["raw"],
                                              raw[:, 2] if name == "sounder" else raw[2])

        def picture(name):
            return sonarsim_data.read_png((self.out / name).read_bytes())

        for name in ("sss", "sounder"):
            np.testing.assert_array_equal(picture(f"{name}/raw.png"), dataset[name].records("raw"))
        # As the display of the head does, a step shows the last ping that fell on it.
        pings = dataset["head"].records("raw")
        np.testing.assert_array_equal(picture("head/raw_0000.png"), pings[:STEPS].T)
        second = np.concatenate([pings[STEPS:], pings[POSES - STEPS:STEPS]]).T
        np.testing.assert_array_equal(picture("head/raw_0001.png"), second)

        sums = (self.out / "SHA256SUMS").read_text()
        for name in ("sss/raw.npy", "sounder/raw.png", "head/raw_0001.png"):
            self.assertIn(f"  {name}\n", sums)
        self.assertEqual(self.run_sonarsim("verify", "out").returncode, 0)
        before = digest(self.out)
        (self.out / "sss/raw.npy").unlink()
        missing = self.run_sonarsim("verify", "out")
        self.assertEqual(missing.returncode, 1)
        self.assertIn("sss/raw.npy: is missing", missing.stderr)
        # Rendered again, what is missing is made anew.
        self.assert_renders()
        self.assertEqual(digest(self.out), before)

    def test_shards_and_off(self):
        self.assert_renders()
        for part in ("1", "2"):
            self.assert_renders("--shard", f"{part}/2", "--out", f"part{part}")
        merged = self.run_sonarsim("merge", "part1", "part2", "all")
        self.assertEqual(merged.returncode, 0, merged.stderr)
        self.assert_renders("--out", "all")
        self.assertEqual(digest(self.folder / "all"), digest(self.out))
        self.assert_renders("--out", "off", "--set", "output.raw=false")
        names = digest(self.folder / "off")
        self.assertIn("sss/waterfall.npy", names)
        self.assertFalse([name for name in names if "raw" in name])


if __name__ == "__main__":
    unittest.main()
