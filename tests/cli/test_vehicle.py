"""A vehicle that waves move, and the poses that its navigation reports."""
import json
import unittest

from sandbox import Sandbox, digest

WAVES = """
vehicle:
  motion: {position_m: [0, 0, 0.2], turn_deg: [3, 2, 1], period_s: 4}
"""
NAVIGATION = """\
  navigation: {position_m: 0.5, heading_deg: 2}
"""


def positions(file):
    return [tuple(map(float, line.split()[1:4])) for line in file.read_text().splitlines()[1:]]


class Vehicle(Sandbox):
    def add(self, text):
        mission = self.folder / "mission.yaml"
        mission.write_text(mission.read_text() + text)

    def test_waves_move_the_vehicle(self):
        self.assert_renders()
        still = digest(self.out / "fls/polar")
        self.add(WAVES)
        self.assert_renders("--overwrite")
        self.assertNotEqual(still, digest(self.out / "fls/polar"))
        self.assertEqual(len({z for _, _, z in positions(self.out / "trajectory.tum")}), 6)
        self.assertFalse((self.out / "navigation.tum").exists())
        self.assertEqual(self.run_sonarsim("verify", "out").returncode, 0)

    def test_images_do_not_depend_on_navigation(self):
        self.add(WAVES)
        self.assert_renders()
        images = digest(self.out / "fls/polar")
        truth = (self.out / "trajectory.tum").read_text()
        self.add(NAVIGATION)
        self.assert_renders("--overwrite")
        self.assertEqual(images, digest(self.out / "fls/polar"))
        self.assertEqual(truth, (self.out / "trajectory.tum").read_text())
        reported = positions(self.out / "navigation.tum")
        self.assertNotEqual(reported, positions(self.out / "trajectory.tum"))
        for ping in range(6):
            meta = json.loads((self.out / f"fls/meta/{ping:06d}.json").read_text())
            self.assertEqual(tuple(meta["T_world_vehicle_reported"]["position_m"]), reported[ping])
        self.assertIn("navigation.tum", (self.out / "SHA256SUMS").read_text())
        self.assertEqual(self.run_sonarsim("verify", "out").returncode, 0)
        self.write("out/navigation.tum", "0 0 0 0 0 0 0 1\n")
        self.assertNotEqual(self.run_sonarsim("verify", "out").returncode, 0)

    def test_parts_are_merged(self):
        self.add(WAVES + NAVIGATION)
        self.assert_renders()
        whole = digest(self.out)
        for part in ("1", "2"):
            self.assert_renders("--shard", f"{part}/2", "--out", f"part{part}")
        result = self.run_sonarsim("merge", "part1", "part2", "merged")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assert_renders("--out", "merged")
        merged = digest(self.folder / "merged")
        self.assertEqual(merged["navigation.tum"], whole["navigation.tum"])

    def test_a_bad_deviation_is_refused(self):
        self.add(WAVES.replace("period_s: 4", "period_s: 0"))
        self.assert_refused(self.render(), "mission.yaml:", "period_s")


if __name__ == "__main__":
    unittest.main()
