"""What README.md and docs/dataset.md tell a reader to type, the first mission and the Python
snippets, and figures that README.md states. The snippets need numpy; they are skipped without."""
import json
import pathlib
import re
import subprocess
import unittest

from sandbox import Sandbox, box_gltf, python_with

ROOT = pathlib.Path(__file__).parents[2]
README = (ROOT / "README.md").read_text()
DATASET_PAGE = (ROOT / "docs" / "dataset.md").read_text()
PYTHON = python_with("numpy")


def block(page, language):
    return re.search(rf"```{language}\n(.*?)```", page, re.DOTALL).group(1)


class Documents(Sandbox):
    def run_snippet(self, page, more=""):
        program = block(page, "python") + more
        result = subprocess.run([PYTHON, "-c", program], cwd=self.folder, text=True,
                                capture_output=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def render_all_kinds(self, out, *options):
        """Every kind of sonar, small."""
        result = self.run_sonarsim("render", ROOT / "tests" / "four_sonars.yaml", "--out", out,
                                   "--set", "trajectory.rate_hz=0.5", *options)
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_figures_of_the_readme(self):
        self.assertLessEqual(len(README.split()), 850)
        self.assertIn("sixty random fields", README)
        self.assertIn("\nvariants: 60\n", (ROOT / "configs/detection.yaml").read_text())

    def test_error_and_speed_of_the_readme_are_those_of_the_table(self):
        table = (ROOT / "docs/accuracy.md").read_text().split("<!-- report tank -->")[1]
        row = re.search(r"^\| slices \| relative_l1=0.03 \|(.*)$", table, re.MULTILINE).group(1)
        _, _, rate, error, *_ = [float(cell) for cell in re.findall(r"[\d.]+", row)]
        words = " ".join(README.split())
        stated = re.search(r"On the test tank the default leads to ([\d.]+) % against", words).group(1)
        self.assertLess(error, float(stated))
        stated = re.search(r"About ([\d,]+) images/s of 512 x 256 bins", words).group(1)
        self.assertGreater(rate, float(stated.replace(",", "")))

    def first_mission(self):
        csv = re.search(r"\n    (material,.*)\n    (Hull,.*)\n", README)
        self.write("materials.csv", csv.group(1) + "\n" + csv.group(2) + "\n")
        self.write("hull.gltf", box_gltf(material="Hull"))
        self.write("hull.yaml", block(README, "yaml").replace("hull.glb", "hull.gltf"))

    def test_first_mission_sees_the_mesh(self):
        self.first_mission()
        small = ["--set", "trajectory.rate_hz=0.2", "--set", "sensors.fls.range_bins=64",
                 "--set", "sensors.fls.azimuth_bins=64"]
        for command in ("validate", "render"):
            result = self.run_sonarsim(command, "hull.yaml", *small)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertNotIn("warning", result.stderr)
        self.assertTrue(self.dataset(self.folder / "out" / "hull")["complete"])

    @unittest.skipIf(PYTHON is None, "needs numpy")
    def test_snippet_of_the_page_opens_every_kind(self):
        self.render_all_kinds("out/survey")
        lines = self.run_snippet(DATASET_PAGE)
        for name in ("fls", "mbes", "sss", "sounder"):
            self.assertIn(name + " (", lines)

    @unittest.skipIf(PYTHON is None, "needs numpy")
    def test_snippets_open_what_little_was_asked_for(self):
        self.render_all_kinds("out/survey", "--set", "output.polar=false")
        self.run_snippet(DATASET_PAGE)

    @unittest.skipIf(PYTHON is None, "needs numpy")
    def test_snippet_of_the_page_places_the_columns_of_a_waterfall(self):
        """Slant range is linear in the column, through nadir; nothing echoes before range_min."""
        self.edit("mission.yaml", "output:\n  folder: out\n",
                  "  sss: {kind: sidescan, range_min_m: 0.5, range_max_m: 6.5, range_bins: 60}\n"
                  "output:\n  folder: out/survey\n")
        self.assert_renders()
        # The side-scan is the last of the sensors, so its are what the loop leaves behind.
        printed = self.run_snippet(DATASET_PAGE, "print(json.dumps([ranges.tolist(), "
                                                 "pings.tolist()]))")
        ranges, rows = json.loads(printed.splitlines()[-1])
        self.assertEqual((len(rows), len(rows[0])), (6, 130))
        for column, expected in ((0, 6.45), (64, 0.05), (65, 0.05), (129, 6.45)):
            self.assertAlmostEqual(ranges[column], expected)
        # The floor of the box is 1.5 m below, at the edge of a bin, so nothing is nearer.
        for side in (slice(0, 65), slice(65, 130)):
            nearest = min(r for r, value in zip(ranges[side], rows[0][side]) if value > 0)
            self.assertAlmostEqual(nearest, 1.55, delta=0.101)
        # Here range_min is 2.6 bins: the first column that the sonar hears is not 3.5 bins away.
        self.edit("mission.yaml", "range_max_m: 6.5, range_bins: 60", "range_max_m: 6.5, range_bins: 31")
        self.assert_renders("--overwrite")
        printed = self.run_snippet(DATASET_PAGE, "print(json.dumps(ranges.tolist()))")
        ranges = json.loads(printed.splitlines()[-1])
        for column, expected in ((34 + 3, 0.5 + 3 / 31), (67, 6.5 - 3 / 31), (0, 6.5 - 3 / 31)):
            self.assertAlmostEqual(ranges[column], expected)


if __name__ == "__main__":
    unittest.main()
