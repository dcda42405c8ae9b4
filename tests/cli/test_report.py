"""The report of speed against error, from the command line, and its plot. Its figures: tests/report."""
import json
import unittest
import xml.etree.ElementTree

from sandbox import ROOT, Sandbox, python_with

ROW = {"sensor", "engine", "setting", "current", "on_front", "goal", "ms_per_ping", "pings_per_s", "times_131k_rays",
       "ms_131k_rays", "relative_l1", "worst_relative_l1", "miss_rate", "samples_per_ping"}
# A million rays show whether the figures are sound.
QUICK = ("--quick", "-j1", "--reference-rays", "1000000")
PYTHON = python_with("matplotlib")


class Report(Sandbox):
    def test_quick(self):
        """Multipath and streaks are no error against the reference, which knows direct echoes only."""
        self.edit("mission.yaml", "    noise:", "    multipath: {method: cluster, delta_deg: 15}\n"
                  "    streaks: {mode: add}\n    noise:")
        result = self.succeeds("report", "mission.yaml", *QUICK, "--out", "report", "--json", "elsewhere.json")
        self.assertIn("fls: the reference settled to", result.stdout)
        self.assertRegex(result.stdout, r"\n\| cluster \| 5.00 \| 15.0 \|.* the mission's own\n")
        report = json.loads((self.folder / "elsewhere.json").read_text())
        self.assertEqual(report, json.loads((self.folder / "report/report.json").read_text()))
        self.assertEqual({row["engine"] for row in report["rows"]}, {"rays", "slices", "octree", "auto"})
        for row in report["rows"]:
            self.assertEqual(set(row), ROW)
            self.assertGreater(row["ms_per_ping"], 0)
            self.assertIn(row["goal"], ("met", "missed") if row["engine"] in ("rays", "slices", "auto") else ("-",))
        # Inside a plain box the rays have no trouble.
        finest = [r for r in report["rows"] if (r["engine"], r["setting"]) == ("rays", "relative_l1=0.01")]
        self.assertLess(finest[0]["relative_l1"], 0.05)
        self.assertGreater(len(report["multipath_rows"]), 10)
        self.assertIn("| rays | relative_l1=0.01 |", (self.folder / "report/report.md").read_text())
        self.assertEqual({path.name for path in (self.folder / "report").iterdir()}, {"report.json", "report.md"})
        if PYTHON:
            self.plot("elsewhere.json")
            self.assertEqual([path.name for path in self.out.iterdir()], ["error_fls.svg"])

    def test_bad_input(self):
        octree = ("--set", "sensors.fls.range_bins=8", "--engines", "octree")
        profile = ("--set", "scene.water_surface={height_m: 5}", "--set", "water.profile={named: summer}")
        for arguments, words in (
                ((), ""), (("mission.yaml", "--hard"), "unknown option"), (("none.yaml",), "none.yaml"),
                (("mission.yaml", "--engines", "sonar"), ""),
                (("mission.yaml", "--set", "variants=2", *QUICK), "this mission has variants"),
                (("mission.yaml", *octree, *QUICK), "--engines: no setting"),
                (("mission.yaml", *profile, *QUICK), "water.profile")):
            with self.subTest(arguments=arguments):
                self.assert_refused(self.run_sonarsim("report", *arguments), words)

    def plot(self, name, code=0):
        said = self.run_program(PYTHON, ROOT / "scripts/plot_report.py", name, self.out, code=code).stderr
        self.assertNotIn("Traceback", said)
        return said

    @unittest.skipIf(PYTHON is None, "needs matplotlib")
    def test_plot(self):
        def row(setting, ms, error, engine="rays", sensor="fls"):
            return {"sensor": sensor, "engine": engine, "setting": setting, "ms_per_ping": ms, "relative_l1": error,
                    "on_front": setting.endswith("0.01"), "current": setting.endswith("0.01")}
        self.write("report.json", json.dumps({
            "mission": "a < b & c", "reference": [{"sensor": "fls"}, {"sensor": "sss"}],
            "rows": [row("relative_l1=0.1", 1.0, 0.08), row("relative_l1=0.01", 10.0, 0.009),
                     row("leaf_m=0.04", 20.0, 0.02, "octree"), row("leaf_m=0.017", 20.0, 0.0, "octree"),
                     row("relative_l1=0.37", 1.0, 0.2, sensor="sss")]}))
        self.plot("report.json")
        tree = xml.etree.ElementTree.parse(self.out / "error_fls.svg")
        texts = ["".join(text.itertext()).strip() for text in tree.iter("{http://www.w3.org/2000/svg}text")]
        for label in ("a < b & c, fls", "0.1", "0.01", "0.04", "the mission's own setting"):
            self.assertIn(label, texts)
        # A logarithmic axis has no place for an error of 0, and other sonars have their own plot.
        self.assertFalse({"0.017", "0.37"} & set(texts))
        self.assertTrue((self.out / "error_sss.svg").exists())
        self.write("none.json", "[]")
        self.assertIn("none.json: not a report", self.plot("none.json", code=2))


if __name__ == "__main__":
    unittest.main()
