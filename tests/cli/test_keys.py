"""`sonarsim keys`, and the tables of docs/mission.md that are made from it."""
import json
import os
import pathlib
import re
import subprocess
import unittest

SONARSIM = os.environ["SONARSIM"]
PAGE = pathlib.Path(__file__).parents[2] / "docs" / "mission.md"


def keys(*options):
    return subprocess.run([SONARSIM, "keys", *options], text=True, capture_output=True, timeout=60,
                          check=True).stdout


class Keys(unittest.TestCase):
    maxDiff = None

    def test_the_page_shows_what_the_program_knows(self):
        page = re.search(r"<!-- begin keys -->\n\n(.*)\n<!-- end keys -->", PAGE.read_text(), re.DOTALL)
        self.assertEqual(page.group(1), keys(), "run ./scripts/write_keys.sh")

    def test_json(self):
        sections = {(s["path"], s["form"]): {k["name"]: k for k in s["keys"]}
                    for s in json.loads(keys("--json"))}
        bins = sections["sensors.NAME", ""]["range_bins"]
        self.assertEqual((bins["low"], bins["high"]), (1, 8192))
        self.assertEqual(bins["default_by_kind"]["echosounder"], 200)
        self.assertEqual(sections["trajectory", "waypoints"]["speed_m_s"]["default"], 1)
        self.assertFalse(sections["trajectory", "waypoints"]["speed_m_s"]["low_allowed"])
        self.assertIs(sections["output", ""]["fan"]["default"], True)
        self.assertEqual(sections["octree", ""]["leaf_m"]["choices"], ["auto"])


if __name__ == "__main__":
    unittest.main()
