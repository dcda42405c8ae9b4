"""Legal values at the ends of their ranges: what they ask for is finite and done in time, or said."""
import array
import json
import math
import os
import re
import resource
import unittest

from sandbox import Sandbox


class Extremes(Sandbox):
    def sensor(self, text):
        mission = (self.folder / "mission.yaml").read_text()
        mission = re.sub(r"(?s)sensors:.*output:", f"sensors:\n  s: {text}\noutput:", mission)
        self.write("mission.yaml", mission.replace("image: true", "fan: false"))

    def values(self, name):
        data = (self.out / name).read_bytes()
        start = 10 + int.from_bytes(data[8:10], "little")
        return array.array("f", data[start:])

    def assert_finite(self):
        files = [path.relative_to(self.out) for path in self.out.rglob("*.npy")
                 if b"'<f4'" in path.read_bytes()[:100]]
        self.assertTrue(files)
        for file in files:
            self.assertTrue(all(map(math.isfinite, self.values(file))), file)

    def test_gain_for_500_m_at_1_mhz_is_finite(self):
        self.sensor("{kind: imaging, model: calibrated, range_max_m: 500, range_bins: 64, "
                    "azimuth_bins: 16}")
        self.assert_renders()
        self.assert_finite()

    def test_levels_at_their_ends_are_finite(self):
        self.sensor("{kind: echosounder, model: calibrated, range_max_m: 1000, range_bins: 64, "
                    "instrument: {frequency_hz: 1.0e+7, source_level_db: 300, receiver: "
                    "{tvg_from_m: 1000, full_scale_db: -300}}}")
        self.assert_renders()
        self.assert_finite()

    def test_a_narrow_beam_that_looks_far_along_track_is_done_in_time(self):
        self.sensor("{kind: sidescan, model: calibrated, elevation_deg: 160, range_max_m: 6, "
                    "range_bins: 64, instrument: {beam: {width_deg: 0.1}}}")
        self.assert_renders("--set", "trajectory.rate_hz=0.1")
        self.assert_finite()

    @unittest.skipIf(os.environ["SANITIZED"] == "1", "a sanitizer reserves more memory than that")
    def test_memory_that_is_not_there_is_named_with_its_key(self):
        self.sensor("{kind: imaging, azimuth_bins: 8192, range_bins: 4096}")
        found = self.run_sonarsim(
            "validate", "mission.yaml", "--json",
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (4 << 30, 4 << 30)))
        self.assertEqual(found.returncode, 0, found.stderr)
        self.assertRegex(found.stderr, "W26 sensor 's': a ping takes about .* lower azimuth_bins")
        self.assertIsNone(json.loads(found.stdout)["sensors"]["s"]["seconds_per_ping"])


if __name__ == "__main__":
    unittest.main()
