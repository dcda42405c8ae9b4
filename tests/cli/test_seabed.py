"""Beds that are made from numbers and the mission's seed."""
import json
import unittest

from composed import Composed
from sandbox import digest

MISSION = """\
seed: 5
scene:
  materials: materials.csv
  seabed:
    cell_m: 0.1
    z_m: -2.5
    material: Concrete
    class: bottom
    roughness: {spectral_strength_cm4: 0.003}
    ripples: {height_m: 0.1, length_m: 0.8, direction_deg: 20}
  objects:
    - {name: crate, file: crate.gltf, position_m: [4, 0.5, 9], place: on_bottom}
trajectory:
  waypoints: [{position_m: [0, 0, 0]}, {position_m: [1, 0, 0]}]
  speed_m_s: 1
  rate_hz: 2
sensors:
  fls: {kind: imaging, mount: {rpy_deg: [0, 25, 0]}, azimuth_deg: 60, elevation_deg: 20, range_max_m: 8,
        range_bins: 96, azimuth_bins: 48}
output:
  folder: out
  labels: true
"""


class TestSeabed(Composed):
    def setUp(self):
        super().setUp()
        self.write("mission.yaml", MISSION)

    def names(self, folder="out"):
        return [one["name"] for one in self.dataset(self.folder / folder)["labels"]["instances"]]

    def test_a_bed(self):
        """The same seed makes the same bed, another seed another; objects rest on it."""
        self.assert_renders()
        self.assertEqual(self.names(), ["seabed", "crate"])
        crate = self.dataset()["labels"]["instances"][1]["box_world_m"]
        self.assertTrue(-2.6 < crate["min"][2] < -2.4, crate)
        self.assert_renders("--set", "output.folder=again", "--threads", "1")
        self.assertEqual(digest(self.out / "fls"), digest(self.folder / "again/fls"))
        self.assert_renders("--set", "output.folder=other", "--set", "seed=6")
        self.assertNotEqual(digest(self.out / "fls/polar"), digest(self.folder / "other/fls/polar"))

    def test_variants(self):
        """Each variant has a bed of its own, by its seed and by what is drawn."""
        self.edit("mission.yaml", "output:\n", "variants: 3\nvary:\n"
                  "  - {key: scene.seabed.ripples.length_m, uniform: [0.4, 1.2]}\n"
                  "  - {key: scene.seabed.roughness.spectral_exponent, uniform: [2.5, 3.5]}\noutput:\n")
        self.assert_renders()
        told = json.loads((self.out / "variants.json").read_text())
        self.assertEqual(len({json.dumps(one["drawn"]) for one in told["variants"]}), 3)
        images = [digest(self.out / f"variant_000{k}/fls/polar")["000000.npy"] for k in range(3)]
        self.assertEqual(len(set(images)), 3)

    def test_refused(self):
        for old, new, fragments in (
                ("cell_m: 0.1", "cell_m: 0", ("mission.yaml:5:", "cell_m", "0.001")),
                ("    cell_m: 0.1\n", "", ("lacks the key 'cell_m'",)),
                ("cell_m: 0.1", "cell_m: 0.002", ("mission.yaml:5:5: the mission needs", "raise cell_m")),
                ("cell_m: 0.1", "cell_m: 0.1\n    size_m: [0.05, 3]", ("fewer than 2 x 2 cells",)),
                ("length_m: 0.8", "length_m: 0", ("length_m", "above 0")),
                (", length_m: 0.8", "", ("lacks the key 'length_m'",)),
                ("{spectral_strength_cm4: 0.003}", "{spectral_exponent: 2}", ("spectral_exponent", "above 2")),
                ("cell_m: 0.1", "cell_m: 0.1\n    colour: red", ("unknown key 'colour'",)),
                ("    material: Concrete\n", "", ("the seabed has no material; write scene.seabed.material",)),
                ("material: Concrete", "material: Concret", ("Concret",)),
                ("  seabed:\n", "  heightmap: {file: bed.png}\n  seabed:\n", ("are both the bottom",))):
            with self.subTest(new=new):
                self.write("mission.yaml", MISSION)
                self.edit("mission.yaml", old, new)
                self.refused(*fragments)
                self.assertFalse(self.out.exists())


if __name__ == "__main__":
    unittest.main()
