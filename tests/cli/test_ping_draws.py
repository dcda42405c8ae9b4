"""What `vary` draws for every ping: metadata, images, threads, shards, resume, and what is refused."""
import json
import math
import shutil
import unittest

from sandbox import Sandbox, digest

VARY = """
vary:
  - {key: sensors.fls.noise.add_sigma, log_uniform: [0.001, 0.2], per: ping}
  - {key: sensors.fls.mount.rpy_deg.2, normal: [0, 3], within: [-6, 6], per: ping}
  - {key: vehicle.offset_m.2, uniform: [-0.2, 0.2], per: ping}
  - {key: vehicle.turn_deg.0, choice: [-5, 5], per: ping}
"""
KEYS = ["vehicle.offset_m.2", "vehicle.turn_deg.0", "sensors.fls.noise.add_sigma",
        "sensors.fls.mount.rpy_deg.2"]


class PingDraws(Sandbox):
    def setUp(self):
        super().setUp()
        mission = (self.folder / "mission.yaml").read_text()
        self.write("mission.yaml", mission + VARY)

    def metas(self, folder=None):
        files = sorted((folder or self.out).glob("fls/meta/*.json"))
        return [json.loads(file.read_text()) for file in files]

    def test_every_ping_has_draws_of_its_own(self):
        self.assert_renders("-j", "1")
        metas = self.metas()
        self.assertTrue(all(list(meta["drawn"]) == KEYS for meta in metas))
        for key in KEYS[:1] + KEYS[2:]:
            self.assertEqual(len({meta["drawn"][key] for meta in metas}), len(metas), key)
        for meta in metas:
            self.assertTrue(0.001 <= meta["drawn"][KEYS[2]] <= 0.2)
            # The path lies in the plane z = 0, and the sonar in the middle of the vehicle.
            self.assertEqual(meta["T_world_vehicle"]["position_m"][2], meta["drawn"][KEYS[0]])
            # A mount that is turned about z by a: the scalar product of the two attitudes is
            # cos(a / 2), of whatever the vehicle's is.
            vehicle = meta["T_world_vehicle"]["quaternion_xyzw"]
            sensor = meta["T_world_sensor"]["quaternion_xyzw"]
            cosine = abs(sum(a * b for a, b in zip(vehicle, sensor)))
            angle = 2 * math.degrees(math.acos(min(1.0, cosine)))
            self.assertAlmostEqual(angle, abs(meta["drawn"][KEYS[3]]), places=4)
        whole = digest(self.out)
        # Any number of threads, shards, and what was missing.
        self.assert_renders("--overwrite", "-j", "2")
        self.assertEqual(digest(self.out), whole)
        shutil.rmtree(self.out)
        self.assert_renders("--shard", "2/2")
        self.assert_renders("--shard", "1/2")
        self.assertEqual(digest(self.out), whole)
        (self.out / "fls/polar/000002.npy").unlink()
        self.assert_renders()
        self.assertEqual(digest(self.out), whole)
        # The dataset's own mission draws the same.
        result = self.run_sonarsim("render", self.out / "mission.resolved.yaml", "--paths-from",
                                   ".", "--out", "again")
        self.assertEqual(result.returncode, 0, result.stderr)
        again = digest(self.folder / "again")
        images = {name: sum for name, sum in whole.items() if name.endswith((".npy", ".png"))}
        self.assertEqual({name: again[name] for name in images}, images)
        # Other seeds draw other values.
        self.assert_renders("--overwrite", "--seed", "8")
        self.assertNotEqual(self.metas()[0]["drawn"], metas[0]["drawn"])

    def test_a_drawn_mount_moves_as_a_fixed_one(self):
        mission = (self.folder / "mission.yaml").read_text().replace(VARY, "")
        moving = ("--set", "sensors.fls.moves_in_ping=true")
        self.write("mission.yaml", mission)
        self.assert_renders(*moving, "--set", "sensors.fls.mount.rpy_deg=[0, 0, 70]", "--out", "fixed")
        self.write("mission.yaml", mission + "\nvary:\n  - {key: sensors.fls.mount.rpy_deg.2, choice: [70, 70], "
                   "per: ping}\n")
        self.assert_renders(*moving, "--out", "drawn")
        images = [{name: sum for name, sum in digest(self.folder / out).items() if name.endswith(".npy")}
                  for out in ("fixed", "drawn")]
        self.assertTrue(images[0])
        self.assertEqual(*images)
        self.write("mission.yaml", mission + "\nvary:\n  - {key: vehicle.offset_m.2, uniform: [-0.2, 0.2], "
                   "per: ping}\n")
        self.assert_refused(self.run_sonarsim("validate", "mission.yaml", *moving), "moves_in_ping")

    def test_variants_draw_for_their_pings(self):
        self.edit("mission.yaml", "vary:\n",
                  "variants: 2\nvary:\n  - {key: water.density_kg_m3, uniform: [990, 1030]}\n")
        self.assert_renders()
        metas = [self.metas(self.out / f"variant_000{k}") for k in range(2)]
        for one in metas:
            self.assertEqual(list(one[0]["variant"]["drawn"]), ["water.density_kg_m3"])
            self.assertEqual(list(one[0]["drawn"]), KEYS)
        self.assertNotEqual(metas[0][0]["drawn"], metas[1][0]["drawn"])

    def test_what_is_refused(self):
        for old, new, fragments in (
                ("noise.add_sigma", "range_bins",
                 ("mission.yaml:25:5", "'sensors.fls.range_bins' cannot be drawn for every ping",
                  "noise.add_sigma", "vehicle.offset_m.0")),
                ("sensors.fls.noise.add_sigma", "sensors.sss.noise.add_sigma",
                 ("mission.yaml:25:5", "cannot be drawn for every ping")),
                ("log_uniform: [0.001, 0.2]", "uniform: [-0.1, 0.2]",
                 ("mission.yaml:25:5", "'sensors.fls.noise.add_sigma' must be at least 0, not -0.1")),
                ("within: [-6, 6]", "within: [40, 41]",
                 ("mission.yaml:26:5", "less than 5 % of the normal draws", "make it wider")),
                ("within: [-6, 6], ", "",
                 ("mission.yaml:26:", "a normal draw for every ping needs 'within'")),
                ("choice: [-5, 5]", "choice: [left, 5]",
                 ("mission.yaml:28:5", "takes numbers"))):
            with self.subTest(new=new):
                mission = (self.folder / "mission.yaml").read_text()
                self.edit("mission.yaml", old, new)
                try:
                    self.assert_refused(self.run_sonarsim("validate", "mission.yaml"), *fragments)
                finally:
                    self.write("mission.yaml", mission)


if __name__ == "__main__":
    unittest.main()
