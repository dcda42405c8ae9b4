"""What a mission with multipath tells of what it misses."""
import json
import unittest

from sandbox import Sandbox


class Multipath(Sandbox):
    def estimates(self, *more):
        """The estimates of all pings in a closed box, and what the run warns of."""
        settings = []
        for setting in ("multipath.method=exact", "azimuth_deg=120", "range_bins=256", "azimuth_bins=128", *more):
            settings += ["--set", f"sensors.fls.{setting}"]
        result = self.assert_renders("--overwrite", *settings)
        pings = [json.loads(file.read_text()) for file in sorted((self.out / "fls/meta").glob("*.json"))]
        return [meta["estimated_missed_multipath"] for meta in pings], result.stderr

    def test_estimate_and_warning(self):
        one, warned = self.estimates()
        six, _ = self.estimates("multipath.columns_per_beam=6")
        self.assertGreater(max(one), 0.05)
        self.assertIn("W35 sensor 'fls': ", warned)
        self.assertIn("raise multipath.columns_per_beam", warned)
        for with_six, with_one in zip(six, one, strict=True):
            self.assertLess(0.0, with_six)
            self.assertLess(with_six, with_one)

    def test_no_estimate_without_multipath(self):
        result = self.assert_renders()
        self.assertNotIn("W35", result.stderr)
        meta = json.loads((self.out / "fls/meta/000000.json").read_text())
        self.assertNotIn("estimated_missed_multipath", meta)

    def test_columns_are_those_of_a_fan(self):
        for kind in ("sidescan", "echosounder"):
            self.write("mission.yaml", f"""\
scene: {{file: box.gltf, materials: materials.csv}}
trajectory: {{file: path.csv}}
sensors:
  one:
    kind: {kind}
    multipath: {{method: exact, columns_per_beam: 2}}
""")
            self.assert_refused(self.render(), "mission.yaml:6:", "columns_per_beam is for the beams of a fan")


if __name__ == "__main__":
    unittest.main()
