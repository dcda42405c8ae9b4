"""The surface of the water, which multipath alone knows."""
import unittest

from sandbox import Sandbox, digest


class WaterSurface(Sandbox):
    def test_invisible_but_for_multipath(self):
        self.assert_renders()
        plain = digest(self.out, ["dataset.json", "mission.resolved.yaml", "SHA256SUMS",
                                  "journal.txt"])
        self.edit("mission.yaml", "materials: materials.csv\n",
                  "materials: materials.csv\n  water_surface: {height_m: 0.1}\n")
        result = self.assert_renders("--overwrite")
        self.assertIn("scene.water_surface has no effect", result.stderr)
        self.assertEqual(digest(self.out, ["dataset.json", "mission.resolved.yaml", "SHA256SUMS",
                                           "journal.txt"]), plain)
        multipath = "--set", "sensors.fls.multipath.method=exact"
        self.assert_renders("--overwrite", *multipath)
        with_surface = digest(self.out)
        self.edit("mission.yaml", "  water_surface: {height_m: 0.1}\n", "")
        self.assert_renders("--overwrite", *multipath)
        self.assertNotEqual(digest(self.out)["fls/polar/000000.npy"],
                            with_surface["fls/polar/000000.npy"])

    def test_without_effect(self):
        """The sonar is at 0 m, the box around it from -2 to 2 m."""
        multipath = "--set", "sensors.fls.multipath.method=exact", "--set"
        for surface, doubt in (
                ("{height_m: -1}", "at -1 m lies below the sonar in 6 of 6 pings"),
                ("{height_m: -3}", "at -3 m lies below all of the scene: raise height_m"),
                ("{height_m: 1, roughness: 1}", "has no effect because a roughness of 1")):
            result = self.run_sonarsim("validate", "mission.yaml", *multipath,
                                       f"scene.water_surface={surface}")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn(f"scene.water_surface {doubt}", result.stderr)
        result = self.run_sonarsim("validate", "mission.yaml", *multipath,
                                   "scene.water_surface={height_m: 1}")
        self.assertNotIn("water_surface", result.stderr)

    def test_roughness(self):
        self.edit("mission.yaml", "materials: materials.csv\n",
                  "materials: materials.csv\n  water_surface: {height_m: 1, roughness: 2}\n")
        self.assert_refused(self.render(), "mission.yaml:6:", "'roughness' must be at most 1")


if __name__ == "__main__":
    unittest.main()
