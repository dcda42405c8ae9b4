"""Materials: a CSV to fill in, what `inspect` says of them, and units that are not ours."""
import json
import unittest

from sandbox import Sandbox, box_gltf


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
        told = json.loads(self.run_sonarsim("inspect", "box.gltf", "--materials", "materials.csv",
                                            "--json").stdout)
        self.assertAlmostEqual(told["acoustics"]["Concrete"]["reflection"], reflection, places=12)
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


if __name__ == "__main__":
    unittest.main()
