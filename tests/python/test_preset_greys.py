"""The greys of raw/ by every preset over sand: as instruments deliver them, neither black nor white."""
import re

import numpy as np
from tool import ROOT, ToolTest
from sonarsim.data import open_dataset

MISSION = """\
name: greys
seed: 3
scene:
  materials: {materials}
  seabed: {{material: sand, size_m: [{size}, {size}], cell_m: {cell}, z_m: -{height},
           roughness: {{spectral_strength_cm4: 0.0044, spectral_exponent: 3.25, corner_m: 2}}}}
  objects: {objects}
trajectory: {{waypoints: [{{position_m: [{middle}, {middle}, 0]}}, {{position_m: [{end}, {middle}, 0]}}],
             speed_m_s: 1, rate_hz: {rate}}}
sensors: {{s: {{preset: sensors/{preset}.yaml{mount}}}}}
output: {{raw: true, fan: false, polar: false}}
variants: 2
"""
# By kind: the height above the sand over the range, and pings in a hundredth of the range.
SCENES = {"imaging": (0.15, 1), "profiling": (0.3, 1), "sidescan": (0.15, 10), "echosounder": (0.5, 10), "scanning": (0.1, 40)}


class PresetGreys(ToolTest):
    def test_sand_is_neither_black_nor_white(self):
        for path in sorted((ROOT / "configs/sensors").glob("*.yaml")):
            with self.subTest(path.stem):
                grey = self.greys(path)
                self.assertLess(np.mean(grey == 0), 0.2)
                self.assertLess(np.mean(grey == 1), 0.05)
                self.assertTrue(6 < 255 * np.mean(grey) < 140, 255 * np.mean(grey))

    def test_cameras_have_the_greys_of_their_fans(self):
        """In fans of an ARIS 3000 a tenth is below 39, the median is 71, and highlights are 42 dB above the dark."""
        for name in ("aris_3000", "didson_1800khz"):
            with self.subTest(name):
                path = ROOT / f"configs/sensors/{name}.yaml"
                grey = 255 * self.greys(path, has_anchor=True)
                grey = grey[:, grey.shape[1] // 4:]     # without the ring
                dark, median = np.quantile(grey, [0.1, 0.5])
                highlight_db = (grey.max() - dark) / 255 * float(re.search(r"dynamic_range_db: (\d+)", path.read_text())[1])
                self.assertLess(np.mean(grey == 0), 0.01)
                self.assertTrue(25 < dark < 50 and 50 < median < 95 and 33 < highlight_db < 50, (dark, median, highlight_db))

    def greys(self, preset, has_anchor=False):
        """raw/ of all pings over its largest value. The anchor, of steel, lies in the beam of a fan."""
        keys = dict(line.split("  #")[0].split(": ") for line in preset.read_text().splitlines()
                    if line.startswith(("kind:", "range_max_m:")))
        range_m = float(keys["range_max_m"])
        near = range_m < 2.2  # recorded half a metre above the bottom
        height, pings = SCENES[keys["kind"]]
        anchor = (f"[{{name: anchor, file: {ROOT}/scenes/anchor.obj, units: mm, up: z, material: steel, place: on_bottom, "
                  f"position_m: [{1.67 * range_m}, {1.25 * range_m}, 0], rpy_deg: [0, 70, 30]}}]")
        mount = f", mount: {{rpy_deg: [0, {50 if near else 20}, 0]}}" if keys["kind"] == "imaging" else ""
        (self.folder / "mission.yaml").write_text(MISSION.format(
            materials=ROOT / "scenes/materials.csv", size=2.5 * range_m, cell=max(range_m / 200, 0.05),
            height=(0.4 if near else height) * range_m, middle=1.25 * range_m, end=1.26 * range_m, preset=preset.stem,
            mount=mount, objects=anchor if has_anchor else [], rate=100 * pings / range_m))
        # The error is measured in the first variant alone, which takes longer than the pings.
        self.sonarsim("render", "mission.yaml", "--quiet", "--out", preset.stem, "--shard", "2/2")
        values = np.stack([sample["raw"] for sample in open_dataset(self.folder / preset.stem / "variant_0001")])
        return values / np.iinfo(values.dtype).max
