"""scripts/plot_report.py, on small reports made by hand. Needs matplotlib; skipped without."""
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

from sandbox import python_with

SCRIPT = pathlib.Path(__file__).parents[2] / "scripts" / "plot_report.py"
SVG = "{http://www.w3.org/2000/svg}"


PYTHON = python_with("matplotlib")


def setting(name, ms, error, front=False, current=False, engine="rays", sensor="fls"):
    return {"sensor": sensor, "engine": engine, "setting": name, "ms_per_ping": ms, "relative_l1": error,
            "on_front": front, "current": current}


def report(settings):
    return {"mission": "a < b & c", "rows": settings,
            "reference": [{"sensor": s} for s in dict.fromkeys(row["sensor"] for row in settings)]}


class PlotReport(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory(prefix="sonarsim-")
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def plot(self, content, *options):
        (self.folder / "report.json").write_text(content)
        return subprocess.run([PYTHON, SCRIPT, self.folder / "report.json", self.folder, *options],
                              text=True, capture_output=True, timeout=120, check=False)

    def assert_plots(self, content, *options):
        result = self.plot(json.dumps(content), *options)
        self.assertEqual(result.returncode, 0, result.stderr)

    def texts(self, name):
        tree = xml.etree.ElementTree.parse(self.folder / name)
        return ["".join(text.itertext()).strip() for text in tree.iter(SVG + "text")]

    def test_error(self):
        self.assert_plots(report([setting("relative_l1=0.1", 1.0, 0.08, front=True),
                                  setting("relative_l1=0.01", 10.0, 0.009, True, True),
                                  setting("leaf_m=0.04", 20.0, 0.02, engine="octree"),
                                  setting("leaf_m=0.017", 20.0, 0.0, engine="octree"),
                                  setting("relative_l1=0.37", 1.0, 0.2, sensor="sss")]))
        texts = self.texts("error_fls.svg")
        self.assertIn("a < b & c, fls", texts)
        for label in ("0.1", "0.01", "0.04", "the mission's own setting"):
            self.assertIn(label, texts)
        # A logarithmic axis has no place for an error of 0, and other sonars have their own plot.
        self.assertNotIn("0.017", texts)
        self.assertNotIn("0.37", texts)
        self.assertIn("0.37", self.texts("error_sss.svg"))
        first = (self.folder / "error_fls.svg").read_bytes()
        self.assert_plots(json.loads((self.folder / "report.json").read_text()))
        self.assertEqual((self.folder / "error_fls.svg").read_bytes(), first)

    def test_png(self):
        self.assert_plots(report([setting("relative_l1=0.1", 1.0, 0.08)]), "--format", "png")
        self.assertEqual((self.folder / "error_fls.png").read_bytes()[:4], b"\x89PNG")

    def test_no_report(self):
        for content in ("{", "{}", "[]"):
            result = self.plot(content)
            self.assertEqual(result.returncode, 2, content)
            self.assertIn("report.json: not a report", result.stderr)
            self.assertNotIn("Traceback", result.stderr)


if __name__ == "__main__":
    if PYTHON is None:
        sys.exit(77)
    unittest.main()
