"""The report of speed against error, from the command line."""
import json
import pathlib
import subprocess
import unittest

from sandbox import Sandbox, python_with

PLOT_REPORT = pathlib.Path(__file__).parents[2] / "scripts" / "plot_report.py"

ROW = {"sensor", "engine", "setting", "current", "on_front", "goal", "ms_per_ping", "pings_per_s",
       "times_131k_rays", "ms_131k_rays", "relative_l1", "worst_relative_l1", "miss_rate",
       "samples_per_ping"}


# A million rays show whether the figures are sound.
QUICK = ("--quick", "--reference-rays", "1000000")


class Report(Sandbox):
    def test_quick(self):
        result = self.run_sonarsim("report", "mission.yaml", *QUICK, "--out", "report", "--json",
                                   "elsewhere.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("fls: the reference settled to", result.stdout)
        report = json.loads((self.folder / "elsewhere.json").read_text())
        self.assertEqual(report, json.loads((self.folder / "report/report.json").read_text()))
        engines = {row["engine"] for row in report["rows"]}
        self.assertEqual(engines, {"rays", "slices", "octree", "auto"})
        for row in report["rows"]:
            self.assertEqual(set(row), ROW)
            self.assertGreater(row["ms_per_ping"], 0)
            self.assertGreater(row["pings_per_s"], 0)
            self.assertGreater(row["times_131k_rays"], 0)
            self.assertGreaterEqual(row["worst_relative_l1"], row["relative_l1"])
            self.assertIn(row["goal"], ("met", "missed")
                          if row["engine"] in ("rays", "slices", "auto") else ("-",))
        # Inside a plain box the rays have no trouble.
        finest = [r for r in report["rows"]
                  if (r["engine"], r["setting"]) == ("rays", "relative_l1=0.01")]
        self.assertLess(finest[0]["relative_l1"], 0.05)

        self.assertIn("| rays | relative_l1=0.01 |", (self.folder / "report/report.md").read_text())
        self.assertEqual(report["multipath_rows"], [])
        self.assertEqual({path.name for path in (self.folder / "report").iterdir()}, {"report.json", "report.md"})
        if python := python_with("matplotlib"):
            plotted = subprocess.run([python, PLOT_REPORT, self.folder / "elsewhere.json", self.out],
                                     text=True, capture_output=True, timeout=120, check=False)
            self.assertEqual(plotted.returncode, 0, plotted.stderr)
            self.assertEqual([path.name for path in self.out.iterdir()], ["error_fls.svg"])

    def test_multipath(self):
        # Wide enough to see the corners of the box, at 45 degrees.
        self.edit("mission.yaml", "azimuth_deg: 60", "azimuth_deg: 120")
        self.edit("mission.yaml", "    noise:", "    multipath: {method: cluster, delta_deg: 15}\n"
                  "    streaks: {mode: add}\n    noise:")
        result = self.run_sonarsim("report", "mission.yaml", *QUICK, "--out", "report")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, r"\n\| cluster \| 5.00 \| 15.0 \|.* the mission's own\n")
        report = json.loads((self.folder / "report/report.json").read_text())
        # The reference knows direct echoes only; multipath and streaks are no error against it.
        finest = [r for r in report["rows"]
                  if (r["engine"], r["setting"]) == ("rays", "relative_l1=0.01")]
        self.assertLess(finest[0]["relative_l1"], 0.05)

        rows = report["multipath_rows"]
        self.assertEqual([(r["epsilon_bins"], r["delta_deg"]) for r in rows],
                         [(0, 0)] + [(e, d) for e in (1, 3, 5, 9) for d in (5, 15, 30)])
        self.assertEqual([r["current"] for r in rows].count(True), 1)
        # Inside a plain box every cluster meets planes.
        for row in rows:
            self.assertGreater(row["exact_bins"], 10)
            self.assertGreater(row["recall"], 0.95)
            self.assertGreater(row["precision"], 0.95)
            self.assertGreater(row["times_without"], 0)

    def test_engines(self):
        result = self.run_sonarsim("report", "mission.yaml", *QUICK, "--quiet", "--engines",
                                   "slices,rays", "--json", "report.json")
        self.assertEqual(result.returncode, 0, result.stderr)
        rows = json.loads((self.folder / "report.json").read_text())["rows"]
        self.assertEqual([(r["engine"], r["setting"]) for r in rows],
                         [(engine, f"relative_l1={goal}") for engine in ("rays", "slices")
                          for goal in (0.1, 0.03, 0.01)])
        self.assertEqual(self.run_sonarsim("report", "mission.yaml", "--engines", "sonar").returncode,
                         2)

    def test_bad_input(self):
        self.assertEqual(self.run_sonarsim("report").returncode, 2)
        for option in ("--hard", "--scale"):
            self.assertIn("unknown option", self.run_sonarsim("report", "mission.yaml", option).stderr)
        coarse = ("--set", "sensors.fls.range_bins=8", "--engines", "octree", *QUICK)
        self.assert_refused(self.run_sonarsim("report", "mission.yaml", *coarse), "--engines: no setting")
        bent = ("--set", "scene.water_surface={height_m: 5}", "--set",
                "water.profile={named: summer}")
        self.assert_refused(self.run_sonarsim("report", "mission.yaml", *bent, *QUICK), "water.profile")
        self.assert_refused(self.run_sonarsim("report", "none.yaml"), "none.yaml")
        self.assertEqual(self.run_sonarsim("report", "mission.yaml", "--poses", "0").returncode, 2)


if __name__ == "__main__":
    unittest.main()
