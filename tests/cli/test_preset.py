"""`sonarsim preset`: levels of an instrument, and how far it sees; levels that are `auto` in missions."""
import json
import math
import pathlib
import unittest

from sandbox import Sandbox

ROOT = pathlib.Path(__file__).parents[2]
SENSOR = "    kind: imaging\n"


class Preset(Sandbox):
    def reported(self, *arguments):
        result = self.run_sonarsim("preset", *arguments, "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        return json.loads(result.stdout)

    def test_a_preset_that_came_with_the_program(self):
        text = self.run_sonarsim("preset", "gemini_720is").stdout
        for line in ("preset      gemini_720is\n", "source      ", " dB re 1 uPa, auto\n",
                     "Mean echo and noise are equal at (bottoms at 20 degrees of grazing)", "sphere "):
            self.assertIn(line, text)
        reported = self.reported("gemini_720is")
        self.assertEqual(reported["level_unit"], "dB re 1 uPa")
        self.assertEqual((reported["source_level"], reported["noise"], reported["full_scale"]), ("auto",) * 3)
        ranges = reported["noise_range_m"]
        self.assertLess(ranges["mud"], ranges["sand"])
        self.assertLess(ranges["sand"], ranges["rock"])

    def test_the_range_of_a_sphere_is_the_sonar_equation(self):
        reported = self.reported("gemini_720is")
        r = reported["noise_range_m"]["sphere"]
        echo = reported["source_level_db"] - 20 - 40 * math.log10(r) - 2 * reported["absorption_db_per_m"] * r
        self.assertAlmostEqual(echo, reported["noise_db"], places=6)

    def test_more_source_level_and_less_noise_reach_farther(self):
        base = self.reported("gemini_720is")
        for key, name, by in (("source_level_db", "source_level_db", 10.0), ("noise_db", "receiver.noise_db", -3.0)):
            setting = f"instrument.{name}={base[key] + by}"
            other = self.reported("gemini_720is", "--set", f"sensors.sonar.{setting}")
            self.assertAlmostEqual(other[key] - base[key], by, places=1)
            self.assertGreater(other["noise_range_m"]["sand"], base["noise_range_m"]["sand"])

    def test_a_file(self):
        self.write("mine.yaml", "kind: echosounder\nmodel: calibrated\n")
        self.assertEqual(self.reported("mine.yaml")["grazing_angle_deg"], 90)
        self.write("mine.yaml", "kind: echosounder\n")
        self.assert_refused(self.run_sonarsim("preset", "mine.yaml"), "mine.yaml", "model: calibrated")
        self.write("mine.yaml", "kind: echosounder\nmodel: calibrated\nazimut_bins: 3\n")
        self.assert_refused(self.run_sonarsim("preset", "mine.yaml"), "mine.yaml:3:1", "azimut_bins")

    def test_an_unknown_name(self):
        self.assert_refused(self.run_sonarsim("preset", "gemini_720"), "did you mean 'gemini_720is'?",
                            "there are: aris_3000")

    def test_all_of_them(self):
        names = [one["preset"] for one in self.reported()]
        self.assertEqual(names, sorted(p.stem for p in (ROOT / "configs" / "sensors").glob("*.yaml")))
        table = self.run_sonarsim("preset").stdout.splitlines()
        self.assertEqual(len(table), len(names) + 2)

    def calibrated(self, instrument):
        self.edit("mission.yaml", SENSOR, f"{SENSOR}    model: calibrated\n    instrument: {instrument}\n")
        text = (self.folder / "mission.yaml").read_text()
        noise = text[text.index("    noise:"):text.index("output:")]
        self.edit("mission.yaml", noise, "")

    def test_a_dataset_has_the_numbers_that_auto_came_to(self):
        self.calibrated("{frequency_hz: 9e5}")
        self.assertEqual(self.run_sonarsim("render", "mission.yaml").returncode, 0)
        reported = json.loads((self.folder / "out" / "dataset.json").read_text())["sensors"][0]["instrument"]
        self.assertEqual(reported["echo_level_unit"], "dB re 1 uPa")
        self.assertIn("tvg_log log10(range_m)", reported["echo_level"])
        self.assertNotIn("tvg_from_m", reported)
        self.assertGreater(reported["source_level_db"], 150)
        self.assertGreater(reported["noise_db"], 0)
        self.assertGreater(reported["full_scale_db"], reported["noise_db"])
        self.assertIn("noise_db: auto", (self.folder / "out" / "mission.resolved.yaml").read_text())

    def test_the_echo_level_has_the_start_of_the_gain(self):
        self.calibrated("{frequency_hz: 9e5, receiver: {tvg_from_m: 1.5}}")
        self.assertEqual(self.run_sonarsim("render", "mission.yaml").returncode, 0)
        reported = json.loads((self.folder / "out" / "dataset.json").read_text())["sensors"][0]["instrument"]
        self.assertEqual(reported["tvg_from_m"], 1.5)
        self.assertIn("tvg_log log10(max(range_m, tvg_from_m))", reported["echo_level"])

    def test_levels_in_two_units_are_refused(self):
        self.calibrated("{source_level_db: 210, receiver: {noise_db: -100}}")
        self.assert_refused(self.run_sonarsim("validate", "mission.yaml"), "mission.yaml:12:",
                            "source_level_db: 0")

    def test_echoes_below_the_noise_name_the_level_to_change(self):
        self.calibrated("{source_level_db: 0, receiver: {noise_db: -20}}")
        text = self.run_sonarsim("validate", "mission.yaml").stderr
        self.assertRegex(text, r"W18.*lower instrument.receiver.noise_db \(-20\) by \d+ dB")

    def test_with_auto_it_is_the_source(self):
        self.calibrated("{source_level_db: 120, frequency_hz: 2.5e6}")
        text = self.run_sonarsim("validate", "mission.yaml").stderr
        self.assertRegex(text, r"W18.*raise instrument.source_level_db by \d+ dB")


if __name__ == "__main__":
    unittest.main()
