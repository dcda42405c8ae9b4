"""Copies of a mesh that is kept once."""
import unittest

from composed import Composed, floor_mesh, gltf


class Shared(Composed):
    def test_many_triangles_are_kept_once(self):
        """Forty-five plates of 100,000 triangles each; few triangles are copied."""
        self.write("plate.gltf", gltf([{"name": "plate", "mesh": 0}], [floor_mesh(half=0.2, cells=224)]))
        self.objects([f"{{name: p{k}, class: plate, file: plate.gltf, position_m: [{3 + k % 5}, {k // 5 - 4}, 0.5]}}"
                      for k in range(45)])
        self.edit("mission.yaml", "output:\n", "output:\n  labels: [instance]\n")
        self.assert_renders("--set", "engine=rays")
        use = self.dataset()["scene"]
        self.assertEqual((use["triangles"], use["shared_meshes"], use["copies"]), (128, 1, 45))
        boxes = {one["name"]: one["box_world_m"] for one in self.dataset()["labels"]["instances"]}
        for x, y in zip(boxes["p7"]["min"] + boxes["p7"]["max"], (4.8, -3.2, 0.5, 5.2, -2.8, 0.5)):
            self.assertAlmostEqual(x, y, places=5)
        self.objects(["{name: a, file: crate.gltf, position_m: [5, 0, 0.5]}",
                      "{name: b, file: crate.gltf, position_m: [5, 2, 0.5]}"])
        self.assert_renders("--overwrite", "--set", "engine=rays")
        self.assertNotIn("copies", self.dataset()["scene"])
        self.assertEqual(self.dataset()["scene"]["triangles"], 128 + 2 * 12)


if __name__ == "__main__":
    unittest.main()
