"""Objects that move while a mission runs."""
import json
import math
import struct
import unittest

from composed import Composed
from sandbox import digest


class Moving(Composed):
    def setUp(self):
        super().setUp()
        self.objects(["{name: fish, file: crate.gltf, material: steel, trajectory: {waypoints: "
                      "[{position_m: [4, -2, 1]}, {position_m: [4, 2, 1]}], speed_m_s: 4, "
                      "rate_hz: 5}}"])

    def test_poses_and_threads(self):
        self.assert_renders("-j", "1")
        first = digest(self.out)
        self.assert_renders("--overwrite", "-j", "3")
        self.assertEqual(digest(self.out), first)
        for k in range(6):
            meta = json.loads((self.out / f"fls/meta/{k:06}.json").read_text())
            position = meta["T_world_object"]["fish"]["position_m"]
            for got, wanted in zip(position, (4, -2 + 0.8 * k, 1)):
                self.assertAlmostEqual(got, wanted, places=9)
        self.assertEqual(len({v for k, v in first.items() if "polar" in k}), 6)

    def test_objects_that_float_need_no_bottom(self):
        """The first object moves, so there is no bottom, and none of the others rests on one."""
        fish = ("{name: fish, file: crate.gltf, material: steel, trajectory: {waypoints: [{position_m: "
                "[4, -2, 1]}, {position_m: [4, 2, 1]}], speed_m_s: 4, rate_hz: 5}}")
        crate = "{name: crate, file: crate.gltf, position_m: [6, 0, 0]%s}"
        self.objects([fish, crate % ""], "  materials: materials.csv\n")
        self.assert_renders()
        self.objects([fish, crate % ", place: on_bottom"], "  materials: materials.csv\n")
        self.assert_refused(self.run_sonarsim("validate", "mission.yaml"),
                            "must neither move nor rest on the bottom")

    def test_large_coordinates_lose_nothing_where_all_moves(self):
        def images(x, y):
            path = f"0 {x + 4} {y - 1} 0 0 0 0 1\n2 {x + 4} {y + 1} 0 0 0 0 1\n"
            self.write("fish.txt", path)
            self.write("mission.yaml", "scene: {materials: materials.csv, objects: [{name: fish, file: crate.gltf, "
                       "material: steel, trajectory: {file: fish.txt}}]}\n"
                       f"trajectory: {{waypoints: [{{position_m: [{x}, {y}, 0]}}, {{position_m: [{x + 0.3}, {y}, 0]}}], "
                       "rate_hz: 3, speed_m_s: 0.5}\nengine: rays\n"
                       "sensors: {fls: {kind: imaging, azimuth_bins: 32, range_max_m: 8, range_bins: 100}}\n"
                       "output: {folder: out, fan: false, labels: [clean]}\n")
            result = self.run_sonarsim("render", "mission.yaml", "--overwrite")
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertNotIn("W01", result.stderr)
            data = (self.out / "fls/clean/000001.npy").read_bytes()
            return struct.unpack(f"<{100 * 32}f", data[-4 * 100 * 32:])
        near, far = images(0, 0), images(500000, 6000000)
        self.assertGreater(sum(near), 0)
        self.assertLess(sum(abs(a - b) for a, b in zip(near, far)), 1e-3 * sum(near))

    def test_labels_have_its_box_at_every_ping(self):
        self.edit("mission.yaml", "output:\n", "output:\n  labels: [objects]\n")
        self.assert_renders()
        fish = self.dataset()["labels"]["instances"][1]
        self.assertEqual((fish["name"], fish["box_world_m"]), ("fish", None))
        seen = 0
        for k in range(6):
            meta = json.loads((self.out / f"fls/meta/{k:06}.json").read_text())
            objects = json.loads((self.out / f"fls/objects/{k:06}.json").read_text())["objects"]
            for one in objects:
                if one["name"] != "fish":
                    self.assertNotIn("T_world_object", one)
                    continue
                seen += 1
                self.assertEqual(one["T_world_object"], meta["T_world_object"]["fish"])
                # A cube of 1 m that is not turned: its centre is where its pose is, and it is turned
                # against the sonar as the world is.
                box = one["box_sensor"]
                for size in box["size_m"]:
                    self.assertAlmostEqual(size, 1.0, places=6)
                at = [a - b for a, b in zip(one["T_world_object"]["position_m"],
                                            meta["T_world_sensor"]["position_m"])]
                self.assertAlmostEqual(math.dist(box["position_m"], (0, 0, 0)),
                                       math.dist(at, (0, 0, 0)), places=9)
                x, y, z, w = meta["T_world_sensor"]["quaternion_xyzw"]
                for got, wanted in zip(box["quaternion_xyzw"], (-x, -y, -z, w)):
                    self.assertAlmostEqual(got, wanted, places=9)
        self.assertGreater(seen, 1)

    def test_where_it_stands_still_it_is_like_any_other(self):
        """Moving to where it is: within rounding the picture of the still object."""
        self.objects(["{name: fish, file: crate.gltf, material: steel, trajectory: {waypoints: "
                      "[{position_m: [4, 1, 1]}, {position_m: [4, 1.0000001, 1]}], "
                      "speed_m_s: 1.0e-7, rate_hz: 5}}"])
        self.assert_renders("--set", "engine=rays")
        moving = (self.out / "fls/polar/000000.npy").read_bytes()
        self.objects(["{name: fish, file: crate.gltf, material: steel, position_m: [4, 1, 1]}"])
        self.assert_renders("--overwrite", "--set", "engine=rays")
        still = (self.out / "fls/polar/000000.npy").read_bytes()
        a, b = (struct.unpack(f"<{48 * 32}f", bytes_[-4 * 48 * 32:]) for bytes_ in (moving, still))
        self.assertLess(sum(abs(x - y) for x, y in zip(a, b)) / sum(b), 1e-3)

    def test_other_engines_refuse(self):
        for engine in ("octree", "slices"):
            self.refused(f"engine: {engine} does not support moving objects; use engine: auto or engine: rays",
                         arguments=["--set", f"engine={engine}"])

    def test_too_short(self):
        self.edit("mission.yaml", "speed_m_s: 4", "speed_m_s: 8")
        self.refused("mission.yaml:7:7", "'fish' moves from 0 s to", "ping from 0 s to 1 s",
                     "let its trajectory last as long")

    def test_without_times(self):
        self.write("fish.csv", "x_m,y_m,z_m,roll_deg,pitch_deg,yaw_deg\n0,0,0,0,0,0\n")
        self.objects(["{name: fish, file: crate.gltf, trajectory: {file: fish.csv}}"])
        self.refused("fish.csv:1", "t_s")

    def test_without_a_name(self):
        self.edit("mission.yaml", "{name: fish, file", "{file")
        self.refused("mission.yaml:7:", "an object that moves needs a name")

    def test_not_on_the_bottom(self):
        self.edit("mission.yaml", "name: fish,", "name: fish, place: on_bottom,")
        self.refused("mission.yaml:7:", "an object that moves cannot rest on the bottom")


if __name__ == "__main__":
    unittest.main()
