"""Point targets in the water: places, strengths and labels of a dataset."""
import json
import unittest

from composed import Composed
from sandbox import digest

PARTICLES = ("  particles:\n"
             "    - {name: fish, kind: points, target_strength_db: -20, count: 1, position_m: [4, 0.5, 0.6], "
             "drift_m_s: [0, 0.5, 0]}\n")


class Particles(Composed):
    def setUp(self):
        super().setUp()
        self.objects([])
        self.edit("mission.yaml", "  objects:\n", PARTICLES)
        self.edit("mission.yaml", "output:\n", "output:\n  labels: [objects]\n")

    def calibrated(self):
        self.edit("mission.yaml", "    kind: imaging\n", "    kind: imaging\n    model: calibrated\n")
        self.edit("mission.yaml", "    noise:\n      add_sigma: 0.05\n      mult_sigma: 0.1\n"
                  "      range_lambda_m: 0.02\n", "")

    def test_places_labels_and_threads(self):
        self.calibrated()
        self.assert_renders("-j", "1")
        first = digest(self.out)
        self.assert_renders("--overwrite", "-j", "3")
        self.assertEqual(digest(self.out), first)
        for k in range(6):
            particles = json.loads((self.out / f"fls/meta/{k:06}.json").read_text())["particles"]
            self.assertEqual(list(particles), ["fish_1"])
            self.assertEqual(particles["fish_1"]["count"], 1)
            self.assertEqual(particles["fish_1"]["target_strength_db"], -20)
            for got, wanted in zip(particles["fish_1"]["position_m"], (4, 0.5 + 0.1 * k, 0.6)):
                self.assertAlmostEqual(got, wanted, places=9)
            objects = json.loads((self.out / f"fls/objects/{k:06}.json").read_text())["objects"]
            fish = [one for one in objects if one["name"] == "fish_1"]
            self.assertEqual(len(fish), 1)
            self.assertEqual(fish[0]["class"], "fish")
            # From (0, 0, 2) to the place.
            y = 0.5 + 0.1 * k
            self.assertAlmostEqual(fish[0]["range_m"], (16 + y * y + 1.96) ** 0.5, delta=0.1)

    def test_an_echosounder_annotates_them(self):
        """Targets have no visible share: it is not known."""
        self.calibrated()
        mission = (self.folder / "mission.yaml").read_text()
        sensors = mission[mission.index("sensors:\n"):]
        self.edit("mission.yaml", sensors, "sensors:\n  echo: {kind: echosounder, model: calibrated, range_max_m: 4}\n"
                  "output: {folder: out, labels: [objects]}\n")
        self.edit("mission.yaml", "position_m: [4, 0.5, 0.6], drift_m_s: [0, 0.5, 0]", "position_m: [-0.5, 0, 0.8]")
        self.assert_renders()
        found = json.loads((self.out / "echo/objects.json").read_text())["objects"]
        targets = [one for one in found if one["class"] == "fish"]
        self.assertEqual([one["visible_share"] for one in targets], [None])
        self.assertAlmostEqual(targets[0]["range_m"], 1.3, delta=0.05)

    def test_a_target_has_no_impedance_to_warn_of(self):
        self.calibrated()
        result = self.run_sonarsim("validate", str(self.folder / "mission.yaml"))
        self.assertNotIn("W09", result.stdout + result.stderr)

    def test_a_mount_that_is_drawn_sees_what_its_pings_see(self):
        """Astern and 20 degrees up, where the bow that points 20 degrees down turns the sonar."""
        self.calibrated()
        self.edit("mission.yaml", "position_m: [4, 0.5, 0.6]", "position_m: [-4, 0.5, 3.4]")
        turned = "\nvary: [{key: sensors.fls.mount.rpy_deg.2, uniform: [175, 185], per: ping}]\n"
        self.write("mission.yaml", (self.folder / "mission.yaml").read_text() + turned)
        self.assert_renders()
        meta = json.loads((self.out / "fls/meta/000003.json").read_text())
        self.assertEqual(list(meta["particles"]), ["fish_1"])

    def test_the_papers_model_refuses_them(self):
        result = self.render()
        self.assertEqual(result.returncode, 2)
        self.assertIn("model: calibrated", result.stderr)


if __name__ == "__main__":
    unittest.main()
