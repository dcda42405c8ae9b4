"""sonarsim compare: arrays and datasets against each other, what is written, and what is refused."""
import json
import os
import unittest

from sandbox import Sandbox, path_csv

CALIBRATED = """\
sensors:
  fls:
    kind: imaging
    model: calibrated
    azimuth_deg: 60
    elevation_deg: 12
    range_max_m: 6
    range_bins: 128
    azimuth_bins: 64
    instrument: {frequency_hz: 1.2e6, beam: {width_deg: 1}, receiver: {companding: log,
      dynamic_range_db: 160, bits: 16}}
output:
  folder: out
  raw: true
"""
KINDS = """\
sensors:
  fls: {kind: imaging, azimuth_deg: 60, range_max_m: 6, range_bins: 96, azimuth_bins: 32}
  sss: {kind: sidescan, range_max_m: 6, range_bins: 96, mount: {translation_m: [0, 0, 0]}}
  sounder: {kind: echosounder, range_max_m: 6, range_bins: 96}
  head: {kind: scanning, range_max_m: 6, range_bins: 96}
  mbes: {kind: profiling, range_max_m: 9, range_bins: 96, azimuth_bins: 128}
output:
  folder: out
"""
RECORDING = """\
kind: imaging
files: [fls/polar/000000.npy]
law: {kind: amplitude, full_value: 0}
sound_speed_m_s: 1480
first_range_m: 0.0625
range_step_m: 0.125
"""


class Compare(Sandbox):
    def compare(self, *arguments):
        return self.run_sonarsim("compare", *arguments)

    def assert_compares(self, *arguments):
        result = self.compare(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result

    def test_two_seeds_are_the_same_and_another_gain_is_not(self):
        text = (self.folder / "mission.yaml").read_text()
        self.write("mission.yaml", text[:text.index("sensors:")] + CALIBRATED)
        for seed in (1, 2):
            self.assert_renders("--set", f"seed={seed}", "--out", f"out{seed}")
        result = self.assert_compares("out1", "out2", "--out", "compared")
        self.assertIn("figures agree", result.stdout)
        reported = json.loads((self.folder / "compared/compare.json").read_text())
        self.assertEqual(reported["format"], "sonarsim comparison")
        self.assertTrue(reported["same"], result.stdout)
        self.assertEqual(reported["figures_agreeing"], sum(one["agrees"] for one in reported["figures"]))
        self.assertTrue((self.folder / "compared/compare.svg").read_text().startswith("<svg"))
        self.assertEqual(json.loads(self.assert_compares("out1", "out2", "--json").stdout), reported)
        self.assertEqual(self.assert_compares("out1", "out2", "-q").stdout, "")
        self.assert_refused(self.compare("out1", "out2", "--out", "compared"), "holds a comparison already")
        # The levels of an instrument are in dataset.json: less at full scale is more of everything.
        scale = json.loads((self.folder / "out1/dataset.json").read_text())["sensors"][0]["instrument"]
        self.assert_renders("--set", "seed=3", "--out", "out3", "--set", "sensors.fls.instrument.receiver.noise_db="
                            f"{scale['noise_db']}", "--set", "sensors.fls.instrument.receiver.full_scale_db="
                            f"{scale['full_scale_db'] - 2}")
        reported = json.loads(self.assert_compares("out1", "out3", "--json").stdout)
        self.assertFalse(reported["same"])
        self.assertTrue(any(one["differs"] for one in reported["figures"] if "level" in one["name"]), reported["figures"])
        self.assertTrue(reported["change_first"]["keys"])

    def test_a_recording_of_arrays(self):
        self.assert_renders()
        self.write("out/recording.yaml", RECORDING + "bearing_first_deg: -29\nbearing_last_deg: 29\n")
        reported = json.loads(self.assert_compares("out", "out", "--json", "--pings", "1").stdout)
        self.assertEqual(reported["agreement"], 1.0)
        self.assertEqual(reported["real"]["pings"], 1)

    def test_every_kind_of_sonar(self):
        self.write("path.csv", path_csv(72))
        text = (self.folder / "mission.yaml").read_text()
        self.write("mission.yaml", text[:text.index("sensors:")] + KINDS)
        self.assert_renders()
        self.assert_renders("--out", "packed")
        self.assert_refused(self.compare("out", "packed"), "several sensors", "fls, sss, sounder, head, mbes")
        for sensor in ("fls", "sss", "sounder", "head", "mbes"):
            reported = json.loads(self.assert_compares("out", "packed", "--sensor", sensor, "--real-sensor", sensor,
                                                   "--json").stdout)
            self.assertEqual((reported["agreement"], reported["same"]), (1.0, True), sensor)
            self.assertEqual(reported["real"]["pings"], 72)
        self.assert_refused(self.compare("out", "out", "--sensor", "fls", "--real-sensor", "sss"), "one kind")

    def test_a_folder_whose_name_is_no_utf_8(self):
        self.assert_renders()
        folder = os.fsdecode(b"o\xffut")
        self.out.rename(self.folder / folder)
        self.assert_compares(folder, folder, "--out", "compared")
        reported = json.loads((self.folder / "compared/compare.json").read_text())
        self.assertEqual(reported["real"]["name"], "o\\xffut")

    def test_what_is_refused(self):
        self.assert_renders()
        self.assert_refused(self.compare("out", "nowhere"), "nowhere", "No such file")
        self.assert_refused(self.compare("out", "."), "neither recording.yaml", "nor dataset.json")
        self.assert_refused(self.compare("out", "out", "--sensor", "flss"), "did you mean 'fls'")
        self.write("out/recording.yaml", RECORDING.replace("imaging", "imagin"))
        self.assert_refused(self.compare("out", "out"), "recording.yaml:1:7", "did you mean 'imaging'")
        self.write("out/recording.yaml", RECORDING.replace("000000.npy", "../../../box.gltf"))
        self.assert_refused(self.compare("out", "out"), "box.gltf", "is no .npy file")
        self.write("out/recording.yaml", RECORDING + "bearings_deg: [1, 2]\n")
        self.assert_refused(self.compare("out", "out"), "2 bearings for 32 beams")


if __name__ == "__main__":
    unittest.main()
