"""The words of messages: each says where the mistake is and what would be right."""
import os
import pathlib
import subprocess
import unittest

import test_mistakes
from sandbox import Sandbox, python_with

SCRIPTS = pathlib.Path(__file__).parents[2] / "scripts"
MISSION = test_mistakes.MISSION.replace("{folder: out}", "{folder: out, labels: [coco]}")


class Messages(Sandbox):
    def setUp(self):
        super().setUp()
        self.make({})

    def make(self, files):
        for name, text in {"mission.yaml": MISSION, "materials.csv": test_mistakes.MATERIALS,
                           "bottom.gltf": test_mistakes.bottom(), "mine.gltf": test_mistakes.box(0.4),
                           "path.csv": test_mistakes.path(), **files}.items():
            (self.folder / name).write_bytes(text if isinstance(text, bytes) else text.encode())

    def test_scripts(self):
        python = python_with("PIL") and python_with("numpy")
        if not python:
            self.skipTest("no numpy or PIL")

        def draw(*arguments):
            return subprocess.run([python, SCRIPTS / "draw_labels.py", *arguments], cwd=self.folder,
                                  env={**os.environ, "PYTHONDONTWRITEBYTECODE": "1"}, text=True,
                                  capture_output=True, check=False)
        result = draw(".", "drawn")
        self.assertEqual(result.returncode, 2)
        self.assertIn(".: nothing to draw", result.stderr)
        self.assertFalse((self.folder / "drawn").exists())
        for pack in ("none", "tar"):
            self.assert_renders("--set", "output.pack=" + pack, "--out", pack)
            result = draw(pack, "drawn_" + pack)
            self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(len(list((self.folder / "drawn_none").iterdir())),
                         len(list((self.folder / "drawn_tar").iterdir())))


if __name__ == "__main__":
    unittest.main()
