"""`sonarsim keys`, `sonarsim warnings` and `sonarsim preset`, and the tables of the docs that they print."""
import json
import os
import pathlib
import re
import subprocess
import unittest

SONARSIM = os.environ["SONARSIM"]
DOCS = pathlib.Path(__file__).parents[2] / "docs"


def printed(*arguments):
    return subprocess.run([SONARSIM, *arguments], text=True, capture_output=True, timeout=60,
                          check=True).stdout


class Keys(unittest.TestCase):
    maxDiff = None

    def test_the_pages_show_the_tables_of_the_program(self):
        for page, table, command in (("mission.md", "keys", "keys"),
                                     ("warnings.md", "warnings", "warnings"),
                                     ("calibrated.md", "presets", "preset")):
            marks = rf"<!-- begin {table} -->\n\n(.*)\n<!-- end {table} -->"
            found = re.search(marks, (DOCS / page).read_text(), re.DOTALL)
            self.assertEqual(found.group(1), printed(command), "run ./scripts/write_keys.sh")

    def test_json(self):
        sections = {(s["path"], s["form"]): {k["name"]: k for k in s["keys"]}
                    for s in json.loads(printed("keys", "--json"))["sections"]}
        bins = sections["sensors.NAME", ""]["range_bins"]
        self.assertEqual((bins["low"], bins["high"]), (1, 8192))
        self.assertEqual(bins["default_by_kind"]["echosounder"], 200)
        self.assertEqual(sections["trajectory", "waypoints"]["speed_m_s"]["default"], 1)
        self.assertFalse(sections["trajectory", "waypoints"]["speed_m_s"]["low_allowed"])
        self.assertIs(sections["output", ""]["fan"]["default"], True)
        self.assertEqual(sections["octree", ""]["leaf_m"]["default"], 0.02)


if __name__ == "__main__":
    unittest.main()
