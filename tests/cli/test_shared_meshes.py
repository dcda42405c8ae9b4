"""Copies of a mesh that is kept once."""
import json
import struct
import unittest

from composed import Composed
from sandbox import digest

try:
    from PIL import Image
except ImportError:
    Image = None


class Shared(Composed):
    def setUp(self):
        super().setUp()
        self.objects(["{name: a, class: crate, file: crate.gltf, position_m: [4.25, 1.5, 0.5]}",
                      "{name: b, class: crate, file: crate.gltf, position_m: [6.5, -0.5, 0.75], "
                      "scale: 1.5}",
                      "{name: c, class: crate, file: crate.gltf, position_m: [5, -2.5, 0.625], "
                      "rpy_deg: [0, 0, 30]}"])
        self.edit("mission.yaml", "output:\n", "output:\n  labels: [instance]\n")

    def test_shared_is_what_copied_is(self):
        """One mesh and three transforms: within rounding the picture of three crates."""
        reported, images = {}, {}
        for repeats in ("copied", "shared"):
            self.assert_renders("--overwrite", "--set", "engine=rays", "--set",
                                f"scene.repeats={repeats}")
            reported[repeats] = self.dataset()
            images[repeats] = struct.unpack(
                f"<{48 * 32}f", (self.out / "fls/polar/000000.npy").read_bytes()[-4 * 48 * 32:])
        first = digest(self.out)
        self.assert_renders("--overwrite", "-j", "3", "--set", "scene.repeats=shared")
        self.assertEqual({k: v for k, v in digest(self.out).items() if "/polar/" in k},
                         {k: v for k, v in first.items() if "/polar/" in k})
        a, b = images["shared"], images["copied"]
        self.assertNotEqual(a, b)
        self.assertLess(sum(abs(x - y) for x, y in zip(a, b)) / sum(b), 1e-3)
        self.assertEqual(reported["copied"]["scene"]["triangles"], 128 + 3 * 12)
        self.assertNotIn("copies", reported["copied"]["scene"])
        use = reported["shared"]["scene"]
        self.assertEqual((use["triangles"], use["shared_meshes"], use["copies"]), (128, 1, 3))
        for one, other in zip(reported["shared"]["labels"]["instances"],
                              reported["copied"]["labels"]["instances"]):
            for end in ("min", "max"):
                for x, y in zip(one["box_world_m"].pop(end), other["box_world_m"].pop(end)):
                    self.assertAlmostEqual(x, y, places=5)
            self.assertEqual(one, other)

    @unittest.skipIf(Image is None, "needs python3-pil")
    def test_preview_and_validate_know_copies(self):
        """The plan and the cuts show three crates, and nothing that validate judges changes."""
        lines, pictures = {}, {}
        for repeats in ("copied", "shared"):
            chosen = ("--set", "engine=rays", "--set", f"scene.repeats={repeats}")
            done = self.run_sonarsim("preview", "mission.yaml", "--out", f"{repeats}.png", *chosen)
            self.assertEqual(done.returncode, 0, done.stderr)
            picture = Image.open(self.folder / f"{repeats}.png").convert("RGB")
            # The tiles behind that of the only sonar: plan on its right, cuts below.
            tile = 612, 450
            pictures[repeats] = [picture.crop((x, y, x + tile[0], y + tile[1])).tobytes()
                                 for x, y in ((624, 30), (12, 480), (624, 480))]
            done = self.run_sonarsim("validate", "mission.yaml", *chosen)
            self.assertEqual(done.returncode, 0, done.stderr)
            lines[repeats] = [line for line in (done.stdout + done.stderr).splitlines() if "W" in line]
        self.assertEqual(lines["shared"], lines["copied"])
        for shared, copied in zip(pictures["shared"], pictures["copied"]):
            changed = sum(a != b for a, b in zip(shared, copied))
            self.assertLess(changed, len(copied) / 1000)

    def test_small_scenes_are_copied(self):
        self.assert_renders("--set", "scene.repeats=copied")
        copied = self.images()
        self.assert_renders("--overwrite")
        self.assertEqual(self.images(), copied)

    def test_report_knows_copies(self):
        chosen = "--set", "scene.repeats=shared", "--poses", "1", "--quick"
        result = self.run_sonarsim("report", "mission.yaml", *chosen, "--json", "report.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("left out: engine: octree does not support copies", result.stderr)
        report = json.loads((self.folder / "report.json").read_text())
        self.assertEqual(report["triangles"], 128 + 3 * 12)
        self.assertEqual({row["engine"] for row in report["rows"]}, {"rays", "auto"})
        self.assertLess(report["rows"][-1]["relative_l1"], 0.02)
        self.assert_refused(self.run_sonarsim("report", "mission.yaml", *chosen, "--quiet",
                                              "--engines", "slices"),
                            "mission.yaml: engine: slices does not support copies of shared meshes")

    def test_other_engines_refuse(self):
        for engine in ("octree", "slices"):
            self.refused(f"engine: {engine} does not support copies of shared meshes",
                         "scene.repeats: copied",
                         arguments=["--set", f"engine={engine}", "--set", "scene.repeats=shared"])


if __name__ == "__main__":
    unittest.main()
