"""`sonarsim import-holoocean`: the mission says what the scenario says, is valid, and what is wrong or has
no counterpart is reported with its place. Presets that come with the program are found from anywhere."""
import json
import pathlib
import re
import unittest

from sandbox import Sandbox

ROOT = pathlib.Path(__file__).parents[2]

SCENARIO = """\
{
  "name": "Dam Hovering",
  "main_agent": "auv0",
  "ticks_per_sec": 20, "octree_min": 0.02,
  "agents": [
    {"agent_name": "auv0", "location": [0.5, 0.25, -0.5], "rotation": [0, 0, 90],
     "sensors": [
      {"sensor_type": "DVLSensor"},
      {"sensor_type": "ImagingSonar", "sensor_name": "fls", "socket": "SonarSocket", "Hz": 10,
       "location": [0.1, 0, 0], "rotation": [0, 10, 0],
       "configuration": {
        "Azimuth": 60, "Elevation": 12, "RangeMin": 0.5, "RangeMax": 6, "RangeBins": 48, "AzimuthBins": 32,
        "AddSigma": 0.1, "MultCov": 0.04, "RangeSigma": 0.05, "ScaleNoise": true, "MultiPath": true,
        "ClusterSize": 4, "AzimuthStreaks": -1, "WaterDensity": 1025,
        "InitOctreeRange": 40}},
      {"sensor_type": "SidescanSonar",
       "configuration": {"RangeMin": 0.5, "RangeMax": 8, "RangeRes": 0.05, "AddSigma": 0.02}},
      {"sensor_type": "SinglebeamSonar", "configuration": {"OpeningAngle": 20}},
      {"sensor_type": "ProfilingSonar", "configuration": {"Elevation": 2, "AzimuthRes": 0.5, "Azimuth": 60}}
     ]}
  ]
}
"""

# What is spoilt, how, and what is said of it and where.
WRONG = (
    ('"Azimuth": 60,', '"Azimuth": 400,', "12:20: 'Azimuth' must be from 0.001 to 360, not 400"),
    ('"Azimuth": 60,', '"Azimuth": "60",', "12:20: 'Azimuth' must be a number"),
    ('"RangeMax": 6,', '"RangeMax": 0.4,', "'RangeMax' must be above RangeMin"),
    ('"RangeBins": 48', '"RangeBins": 4.8', "'RangeBins' must be a whole number, not 4.8"),
    ('"MultiPath": true', '"MultiPath": 1', "'MultiPath' must be true or false"),
    ('"AzimuthStreaks": -1', '"AzimuthStreaks": 2', "'AzimuthStreaks' must be from -1 to 1, not 2"),
    ('"RangeRes": 0.05', '"RangeRes": 1e-6', "'RangeRes' gives 7500000 bins"),
    ('"rotation": [0, 0, 90]', '"rotation": [0, 90]', "6:71: 'rotation' must be a list of 3 numbers"),
    ('"Hz": 10', '"Hz": 0', "'Hz' must be above 0"),
    ('"main_agent": "auv0"', '"main_agent": "auv7"', "3:17: no agent is called 'auv7'"),
    ('"agents"', '"agent"', "a scenario needs a list of 'agents'"),
    ('Sonar"', '"', "none of the sensors is a sonar: ImagingSonar, RaycastImagingSonar, "),
    ('"ticks_per_sec": 20,', '"ticks_per_sec": 20', "scenario.json:4:"),
)


# The sonars of HoloOcean 2.4 and what each becomes.
KINDS = {"imaging": ("ImagingSonar", "RaycastImagingSonar", "GPUImagingSonar"),
         "profiling": ("ProfilingSonar", "RaycastProfilingSonar", "GPUProfilingSonar"),
         "sidescan": ("SidescanSonar", "RaycastSidescanSonar", "GPUSidescanSonar"),
         "echosounder": ("SinglebeamSonar", "RaycastSinglebeamSonar", "SemanticRaycastSinglebeamSonar",
                         "GPUSinglebeamSonar")}


class HoloOcean(Sandbox):
    def setUp(self):
        super().setUp()
        self.write("scenario.json", SCENARIO)

    def run_import(self, *more):
        return self.run_sonarsim("import-holoocean", "scenario.json", "--scene", "box.gltf",
                                 "--materials", "materials.csv", *more)

    def test_the_mission_says_what_the_scenario_says(self):
        result = self.run_import("--out", "imported.yaml")
        self.assertEqual(result.returncode, 0, result.stderr)
        text = (self.folder / "imported.yaml").read_text()
        for line in ("name: \"Dam_Hovering\"", "  density_kg_m3: 1025", "    kind: imaging", "    every: 2",
                     "    mount: {translation_m: [0.1, 0, 0], rpy_deg: [0, 10, 0]}",
                     "    azimuth_deg: 60", "    range_bins: 48", "      add_sigma: 0.1",
                     "      mult_sigma: 0.2",  # the root of 0.04
                     "      range_lambda_m: 0.05", "      scale_with_range: true",
                     "      method: cluster", "      epsilon_bins: 4", "      mode: reduce",
                     "    range_bins: 150",  # 7.5 m in bins of 5 cm
                     "    opening_deg: 20", "    azimuth_bins: 120", "  rate_hz: 20",
                     # Yaw 90 turns the bow to y.
                     "    - {position_m: [0.5, 10.25, -0.5], rpy_deg: [0, 0, 90]}"):
            self.assertIn("\n" + line + "\n", text)
        self.assertIn("# without a counterpart: InitOctreeRange", text)
        warnings = result.stderr
        for reported in ("4:24: 'octree_min' has no counterpart", "8:23: 'DVLSensor' is left out", "15:9: 'InitOctreeRange' has no counterpart",
                     "where the socket 'SonarSocket' sits"):
            self.assertIn("scenario.json:" + reported if reported[0].isdigit() else reported, warnings)
        result = self.run_sonarsim("validate", "imported.yaml", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        sensors = json.loads(result.stdout.splitlines()[-1])["sensors"]
        self.assertEqual(len(sensors), 4)
        # What is there already stays.
        again = self.run_import("--out", "imported.yaml")
        self.assertEqual(again.returncode, 2)
        self.assertIn("imported.yaml: is there already", again.stderr)
        self.assertEqual((self.folder / "imported.yaml").read_text(), text)

    def import_sensors(self, sensors):
        """The sensors of an agent, through the importer."""
        self.write("scenario.json", json.dumps({"agents": [{"agent_name": "auv0", "sensors": sensors}]}))
        return self.run_import()

    def test_every_sonar_of_2_4(self):
        page = (ROOT / "docs/holoocean.md").read_text()
        for kind, types in KINDS.items():
            for sonar in types:
                with self.subTest(sonar=sonar):
                    result = self.import_sensors([{"sensor_type": sonar, "configuration": {
                        "RangeMin": 0.5, "RangeMax": 6, "RangeBins": 64, "AddSigma": 0.1,
                        "WaterDensity": 1000, "IgnorePlants": False}}])
                    self.assertEqual(result.returncode, 0, result.stderr)
                    self.assertIn(f"  {sonar}:\n    kind: {kind}\n", result.stdout)
                    self.assertIn("    range_bins: 64\n", result.stdout)
                    self.assertIn("'IgnorePlants' has no counterpart: leave the plants out of the scene",
                                  result.stderr)
                    one_sided = kind == "sidescan" and sonar != "SidescanSonar"
                    self.assertEqual("looks to one side" in result.stderr, one_sided)
                    self.assertEqual("azimuth_deg: 85" in result.stdout, sonar == "GPUSidescanSonar")
                    self.assertIn(f"`{sonar}`", page)
                    self.write("imported.yaml", result.stdout)
                    result = self.run_sonarsim("validate", "imported.yaml")
                    self.assertEqual(result.returncode, 0, result.stderr)

    def test_sonars_of_one_name_stay_apart(self):
        """Also where a sensor has the name that another one of two gets."""
        names = ("fls", "fls", "fls_2", "fls", "fls 2")
        result = self.import_sensors([
            {"sensor_type": "ImagingSonar", "sensor_name": name, "location": [k, 0, 0]}
            for k, name in enumerate(names)])
        self.assertEqual(result.returncode, 0, result.stderr)
        found = re.findall(r"  (\w+):\n    kind: imaging\n(?:    mount: {translation_m: \[(\d))?", result.stdout)
        self.assertEqual(found, [("fls", ""), ("fls_2", "1"), ("fls_2_2", "2"), ("fls_3", "3"),
                                 ("fls_2_3", "4")])
        self.write("imported.yaml", result.stdout)
        result = self.run_sonarsim("validate", "imported.yaml")
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_a_sonar_that_is_not_known_is_told_with_the_list(self):
        result = self.import_sensors([{"sensor_type": "QuantumSonar"}, {"sensor_type": "IMUSensor"},
                                      {"sensor_type": "GPUImagingSonar"}])
        self.assertEqual(result.returncode, 0, result.stderr)
        reported = [line for line in result.stderr.splitlines() if "QuantumSonar" in line]
        self.assertEqual(len(reported), 1)
        for types in KINDS.values():
            for sonar in types:
                self.assertIn(sonar, reported[0])
        self.assertNotIn("RaycastImagingSonar", next(line for line in result.stderr.splitlines()
                                                     if "IMUSensor" in line))

    def test_wrong_values_are_told_with_their_place(self):
        for right, wrong, message in WRONG:
            with self.subTest(wrong=wrong):
                self.assertIn(right, SCENARIO)
                self.write("scenario.json", SCENARIO.replace(right, wrong))
                result = self.run_import()
                self.assertEqual(result.returncode, 2, result.stdout)
                self.assertIn(message, result.stderr)
                self.assertRegex(result.stderr, r"error: scenario\.json:\d+:\d+: ")

    def test_a_rate_that_does_not_divide_the_fastest(self):
        self.write("scenario.json", SCENARIO.replace('"Hz": 10', '"Hz": 8'))
        result = self.run_import()
        self.assertIn("every: 3", result.stdout)
        self.assertIn("scenario.json:9:92: 8 Hz become 6.667 Hz", result.stderr)

    def test_every_parameter_is_in_the_page(self):
        code = "".join(p.read_text() for p in (ROOT / "lib/mission").glob("holoocean*.cpp"))
        page = (ROOT / "docs/holoocean.md").read_text()
        names = re.findall(r'Parameter\{"(\w+)"', code)
        self.assertGreater(len(names), 25)
        for name in names:
            self.assertIn(f"`{name}`", page)

    def test_presets_of_the_program_are_found_from_anywhere(self):
        self.edit("mission.yaml", "    kind: imaging\n", "    preset: sensors/micron.yaml\n")
        text = (self.folder / "mission.yaml").read_text()
        self.write("mission.yaml", text[:text.index("    azimuth_deg")])
        result = self.run_sonarsim("validate", "mission.yaml")
        self.assertEqual(result.returncode, 0, result.stderr)


if __name__ == "__main__":
    unittest.main()
