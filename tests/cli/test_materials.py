"""Materials: a CSV to fill in, what `inspect` says of them, and units that are not ours."""
import json
import pathlib
import subprocess
import unittest

from sandbox import SONARSIM, Sandbox, box_gltf, python_with

ROOT = pathlib.Path(__file__).resolve().parents[2]


class Inspect(Sandbox):
    def test_a_csv_to_fill_in(self):
        self.write("box.gltf", box_gltf(material="Con, crete"))
        result = self.run_sonarsim("inspect", "box.gltf", "--materials-csv")
        self.assertEqual(result.stdout,
                         'material,density_kg_m3,sound_speed_m_s\n"Con, crete",,\n')
        self.write("materials.csv", result.stdout)
        self.assert_refused(self.render(), "materials.csv:2: density '' is not a number")
        self.write("materials.csv", result.stdout.replace(",,", ",2400,3200"))
        self.assert_renders()
        again = self.run_sonarsim("inspect", "box.gltf", "--materials-csv", "--materials",
                                  "materials.csv")
        self.assertEqual(again.stdout, result.stdout.replace(",,", ",2400,3200"))

    def test_reflection_coefficients(self):
        """((2400 * 3200 - 997 * 1480) / (2400 * 3200 + 997 * 1480))^2 = 0.459."""
        z, water = 2400 * 3200, 997 * 1480
        reflection = ((z - water) / (z + water)) ** 2
        result = self.run_sonarsim("inspect", "box.gltf", "--materials", "materials.csv")
        row = result.stdout.split("reflection\n")[1].splitlines()[0].split()
        self.assertEqual(row, ["Concrete", "2400", "3200", f"{reflection:.3f}"])
        reported = json.loads(self.run_sonarsim("inspect", "box.gltf", "--materials", "materials.csv",
                                            "--json").stdout)
        self.assertAlmostEqual(reported["acoustics"]["Concrete"]["reflection"], reflection, places=12)
        self.write("box.gltf", box_gltf(material="Granite"))
        result = self.run_sonarsim("inspect", "box.gltf", "--materials", "materials.csv")
        self.assertIn("Granite   not in materials.csv", result.stdout)

    def test_other_units(self):
        self.write("materials.csv", "material,density_kg_m3,sound_speed_m_s\nConcrete,2.4,3.2\n")
        for arguments in (["inspect", "box.gltf", "--materials", "materials.csv"],
                          ["validate", "mission.yaml"]):
            result = self.run_sonarsim(*arguments)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("'Concrete': a density of 2.4 looks like g/cm^3", result.stderr)
            self.assertIn("a speed of sound of 3.2 looks like km/s", result.stderr)
        # Air is a gas, and says nothing of units.
        self.write("materials.csv", "material,density_kg_m3,sound_speed_m_s\nConcrete,1.2,343\n")
        self.assertNotIn("looks like", self.run_sonarsim("validate", "mission.yaml").stderr)


class Scattering(Sandbox):
    """`sonarsim inspect FILE.csv`. At 20 degrees of grazing the model has -24.6 dB for medium sand at 400 kHz,
    Lambert's rule -30 + 20 log sin 20 = -39.3 dB."""

    def setUp(self):
        super().setUp()
        self.write("beds.csv", "material,density_kg_m3,sound_speed_m_s,grain_phi,lambert_db,slope_rms_deg\n"
                               "sand,1900,1650,1.5,,\nplain,1900,1650,,-30,0\n")

    def test_a_table(self):
        result = self.run_sonarsim("inspect", "beds.csv")
        self.assertEqual(result.returncode, 0, result.stderr)
        title, degrees, *rows = result.stdout.splitlines()
        self.assertIn("400 kHz", title)
        at_20 = degrees.split().index("20") + 1
        self.assertEqual({row.split()[0]: row.split()[at_20] for row in rows},
                         {"sand": "-24.6", "plain": "-39.3"})

    def test_json(self):
        for khz, strength in ((400, -24.6), (100, -25.0)):
            reported = json.loads(self.run_sonarsim("inspect", "beds.csv", "--json", "--frequency-khz",
                                                str(khz)).stdout)
            self.assertEqual(reported["grazing_deg"], list(range(1, 91)))
            self.assertAlmostEqual(reported["strength_db"]["sand"][19], strength, delta=0.1)
            self.assertAlmostEqual(reported["strength_db"]["plain"][89], -30, delta=0.001)

    def test_the_tables_in_the_docs(self):
        """Every row of docs/calibrated.md under `| 100 kHz |` and `| 400 kHz |` is what is printed."""
        rows = [[cell.strip() for cell in line.strip("|").split("|")]
                for line in (ROOT / "docs" / "calibrated.md").read_text().splitlines()
                if line.startswith("|")]
        for khz in (100, 400):
            start = [row[0] for row in rows].index(f"{khz} kHz")
            printed = self.run_sonarsim("inspect", str(ROOT / "scenes" / "materials.csv"),
                                        "--frequency-khz", str(khz)).stdout.splitlines()
            self.assertEqual(printed[1].split(), rows[start][1:])
            reported = {line.split()[0]: line.split()[1:] for line in printed[2:]}
            for name, *strengths in rows[start + 2:start + 7]:
                self.assertEqual(reported[name], strengths, f"{name} at {khz} kHz")

    @unittest.skipUnless(python_with("matplotlib"), "needs matplotlib")
    def test_the_picture_in_the_docs(self):
        script = ROOT / "scripts" / "plot_scattering.py"
        done = subprocess.run([python_with("matplotlib"), script, SONARSIM,
                               ROOT / "scenes" / "materials.csv", self.folder / "picture.svg"],
                              text=True, capture_output=True, timeout=120, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        picture = (self.folder / "picture.svg").read_text()
        for name in ("mud", "silt", "sand", "gravel", "rock", "100 kHz"):
            self.assertIn(name, picture)
        self.assertLess(len(picture), 60000)

    def test_what_is_refused(self):
        self.write("beds.csv", "material,density_kg_m3,sound_speed_m_s,grain_phi\nsand,1900,1650,12\n")
        self.assert_refused(self.run_sonarsim("inspect", "beds.csv"),
                            "beds.csv:2: grain_phi is 12; expected a number from -10 to 9")
        self.assertEqual(self.run_sonarsim("inspect", "beds.csv", "--frequency-khz", "0").returncode, 2)


if __name__ == "__main__":
    unittest.main()
