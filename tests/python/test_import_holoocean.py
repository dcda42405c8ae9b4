"""`sonarsim import-holoocean`: the mission says what the scenario says and is valid; what is wrong or has no
counterpart is named with its path in the scenario."""
import json
import re

from tool import ROOT, ToolTest
from sonarsim import import_holoocean

SENSORS = [{"sensor_type": "DVLSensor"}, {"sensor_type": "ImagingSonar", "sensor_name": "fls", "socket": "SonarSocket", "Hz": 10,
     "location": [0.1, 0, 0], "rotation": [0, 10, 0], "configuration": {
         "Azimuth": 60, "Elevation": 12, "RangeMin": 0.5, "RangeMax": 6, "RangeBins": 48, "AzimuthBins": 32,
         "AddSigma": 0.1, "MultCov": 0.04, "RangeSigma": 0.05, "ScaleNoise": True, "MultiPath": True,
         "ClusterSize": 4, "AzimuthStreaks": -1, "WaterDensity": 1025, "InitOctreeRange": 40}},
    {"sensor_type": "SidescanSonar", "configuration": {"RangeMax": 8, "RangeRes": 0.05, "AddSigma": 0.02}},
    {"sensor_type": "SinglebeamSonar", "configuration": {"OpeningAngle": 20}},
    {"sensor_type": "ProfilingSonar", "configuration": {"Elevation": 2, "AzimuthRes": 0.5, "Azimuth": 60}}]
SCENARIO = {"name": "Dam Hovering", "main_agent": "auv0", "ticks_per_sec": 20, "octree_min": 0.02, "agents": [
    {"agent_name": "auv0", "location": [0.5, 0.25, -0.5], "rotation": [0, 0, 90], "sensors": SENSORS}]}
# What is spoilt in the text of the scenario, how, and what is said of it.
WRONG = (
    ('"Azimuth": 60, "El', '"Azimuth": 400, "El', "agents[0].sensors[1].configuration.Azimuth must be from 0.001 to 360, not 400"),
    ('"RangeMax": 6', '"RangeMax": 0.4', "configuration.RangeMax must be above RangeMin"),
    ('"RangeBins": 48', '"RangeBins": 48, "RangeRes": 1', "configuration.RangeBins and RangeRes exclude each other"),
    ('"Hz": 10', '"Hz": 100', "agents[0].sensors[1].Hz must be from 1e-06 to 20, not 100"),
    ('"RangeBins": 48', '"RangeBins": 4.8', "RangeBins must be a whole number, not 4.8"),
    ('"RangeRes": 0.05', '"RangeRes": 1e-6', "bins by RangeRes must be from 1 to 8192, not 7500000"),
    ('"rotation": [0, 0, 90]', '"rotation": [0, 90]', "agents[0].rotation must be a list of 3 numbers"),
    ('"main_agent": "auv0"', '"main_agent": "auv7"', "no agent is called 'auv7'"),
    ('"agents"', '"agent"', "a scenario needs a list of agents"),
    ('Sonar"', '"', "agents[0].sensors: no sonar of ImagingSonar, RaycastImagingSonar, "),
    ('"ticks_per_sec": 20,', '"ticks_per_sec": 20', "scenario.json is not JSON: Expecting ',' delimiter: line 1"))
# The sonars of HoloOcean 2.4 and what each becomes.
KINDS = {"imaging": ("ImagingSonar", "RaycastImagingSonar", "GPUImagingSonar"),
         "profiling": ("ProfilingSonar", "RaycastProfilingSonar", "GPUProfilingSonar"),
         "sidescan": ("SidescanSonar", "RaycastSidescanSonar", "GPUSidescanSonar"),
         "echosounder": ("SinglebeamSonar", "RaycastSinglebeamSonar", "SemanticRaycastSinglebeamSonar", "GPUSinglebeamSonar")}


class HoloOcean(ToolTest):
    def run_import(self, scenario, *more, code=0):
        (self.folder / "scenario.json").write_text(scenario if isinstance(scenario, str) else json.dumps(scenario))
        return self.sonarsim("import-holoocean", "scenario.json", "--scene", str(ROOT / "scenes/tank.glb"), "--materials",
                             str(ROOT / "scenes/materials.csv"), *more, code=code)

    def validated(self, mission):
        (self.folder / "imported.yaml").write_text(mission)
        return json.loads(self.sonarsim("validate", "imported.yaml", "--json").stdout.splitlines()[-1])

    def test_the_mission_says_what_the_scenario_says(self):
        result = self.run_import(SCENARIO, "--out", "mission.yaml")
        text = (self.folder / "mission.yaml").read_text()
        for line in ('name: "Dam_Hovering"', "  density_kg_m3: 1025", '    kind: "imaging"', "    every: 2",
                     "      translation_m: [0.1, 0, 0]", "      rpy_deg: [0, 10, 0]", "    azimuth_deg: 60",
                     "    range_bins: 48", "      add_sigma: 0.1", "      mult_sigma: 0.2",     # the root of 0.04
                     "      range_lambda_m: 0.05", "      scale_with_range: true", '      method: "cluster"',
                     "      epsilon_bins: 4", '      mode: "reduce"', "    range_bins: 75",    # 7.5 m in bins of 5 cm, every other on one side
                     "      scale_with_range: false", "    opening_deg: 20", "    azimuth_bins: 120", "  rate_hz: 20",
                     "    # 'InitOctreeRange' has no counterpart: there is no octree to prepare"):
            self.assertIn("\n" + line + "\n", "\n" + text)
        self.assertIn('{"position_m": [0.5, 10.25, -0.5], "rpy_deg": [0, 0, 90]}', text)  # yaw 90 turns the bow to y
        for reported in ("'octree_min' has no counterpart", "agents[0].sensors[0].sensor_type 'DVLSensor' is left out",
                         "agents[0].sensors[1]: 'InitOctreeRange' has no counterpart", "where its socket sits",
                         "agents[0].sensors[2]: another water than the mission, which has one: density_kg_m3 is 1025"):
            self.assertIn(reported, result.stderr)
        self.assertEqual(len(self.validated(text)["sensors"]), 4)
        again = self.run_import(SCENARIO, "--out", "mission.yaml", code=2)
        self.assertEqual(again.stdout, "")
        self.assertIn("mission.yaml is there already", again.stderr)
        self.assertEqual((self.folder / "mission.yaml").read_text(), text)

    def test_every_sonar_of_2_4(self):
        page = (ROOT / "docs/holoocean.md").read_text()
        for name in (*import_holoocean.PARAMETERS, *import_holoocean.NO_COUNTERPART):
            self.assertIn(f"`{name}`", page)
        configuration = {"RangeMin": 0.5, "RangeMax": 6, "RangeBins": 64, "AddSigma": 0.1, "WaterDensity": 1000,
                         "IgnorePlants": False}
        sensors = [{"sensor_type": one, "configuration": configuration} for types in KINDS.values() for one in types]
        result = self.run_import({"agents": [{"agent_name": "auv0", "sensors": sensors}]})
        for kind, types in KINDS.items():
            for sonar in types:
                self.assertRegex(result.stdout, rf'\n  {sonar}:\n    kind: "{kind}"\n')
                self.assertIn(f"`{sonar}`", page)
        self.assertEqual(result.stderr.count("'IgnorePlants' has no counterpart: leave the plants out of the scene"), 13)
        self.assertEqual(result.stderr.count("it looks to one side"), 2)
        self.assertEqual(result.stdout.count("azimuth_deg: 85"), 1)
        self.assertEqual(len(self.validated(result.stdout)["sensors"]), 13)

    def test_sonars_look_where_those_of_holoocean_do(self):
        def looks(kind, rotation, agent="HoveringAUV", socket=""):
            sensor = {"sensor_type": kind, "rotation": rotation, "socket": socket, "location": [1, 2, 3]}
            text = self.run_import({"agents": [{"agent_type": agent, "sensors": [sensor]}]}).stdout
            return text[text.index("translation_m: "):].splitlines()[:2]
        for kind in ("ProfilingSonar", "SidescanSonar", "SinglebeamSonar"):
            for rotation, rpy in (([0, 90, 0], [0, 0, 0]), ([0, 0, 0], [0, -90, 0]), ([0, 90, 30], [0, 0, 30]),
                                  ([0, 60, 0], [0, -30, 0]), ([90, 0, 0], [90, 0, -90])):
                self.assertEqual(looks(kind, rotation)[1].strip(), f"rpy_deg: {[float(one) for one in rpy]}", (kind, rotation))
            self.assertEqual(looks(kind, [0, 0, 0], "TorpedoAUV", "SonarSocket"),
                             ["translation_m: [3.0, 2.0, -1.0]", "      rpy_deg: [0.0, 0.0, 0.0]"])
        self.assertEqual(looks("ImagingSonar", [0, 0, 0], "TorpedoAUV", "SonarSocket")[1].strip(), "rpy_deg: [0.0, 90.0, 0.0]")

    def test_names_rates_and_unknown_sonars(self):
        names = ("fls", "fls", "fls_2", "fls", "fls 2")
        sensors = [{"sensor_type": "ImagingSonar", "sensor_name": name, "location": [k, 0, 0], "Hz": 8 if k else 20}
                   for k, name in enumerate(names)] + [{"sensor_type": "QuantumSonar"}]
        result = self.run_import({"agents": [{"sensors": sensors}, {"agent_name": "other"}]})
        found = re.findall(r"  (\w+):\n    kind: .*\n    mount:\n      translation_m: \[(\d)", result.stdout)
        self.assertEqual(found, [("fls", "0"), ("fls_2", "1"), ("fls_2_2", "2"), ("fls_3", "3"), ("fls_2_3", "4")])
        for words in ("8 Hz become 6.667 Hz", "other agents are left out",
                      "'QuantumSonar' is left out: sonarsim does not have it; it has ImagingSonar, "):
            self.assertIn(words, result.stderr)
        self.validated(result.stdout)

    def test_wrong_values_are_named_with_their_path(self):
        sound = json.dumps(SCENARIO)
        for right, wrong, message in WRONG:
            with self.subTest(wrong=wrong):
                self.assertIn(right, sound)
                result = self.run_import(sound.replace(right, wrong), "--out", "mission.yaml", code=2)
                self.assertEqual(result.stdout, "")
                self.assertIn(message, result.stderr)
                self.assertEqual([p.name for p in self.folder.iterdir()], ["scenario.json"])
        for text in ("", "[]", "{}", "[" * 100000, '{"agents": 7}', '{"agents": [7]}', '{"agents": [{"sensors": [7]}]}',
                     '{"agents": [{"sensors": [{"sensor_type": "ImagingSonar", "configuration": [1]}]}]}', "\0", "NaN",
                     '{"agents": [{"sensors": [{"sensor_type": "ImagingSonar", "location": [NaN, 0, true]}]}]}'):
            self.run_import(text, code=2)
