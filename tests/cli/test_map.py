"""bathymetry.tif as GDAL, and so QGIS, sees it, and soundings.ply as meshio does: Debian's gdal-bin and
python3-meshio. What is not installed is not asked."""
import json
import math
import shutil
import subprocess
import sys
import unittest

from sandbox import Sandbox, python_with

PYTHON = python_with("meshio")
# Compares soundings.ply with soundings.npy: argv has both.
COMPARE = """\
import sys
import meshio
import numpy

cloud = meshio.read(sys.argv[1])
rows = numpy.load(sys.argv[2]).reshape(-1, 5)
rows = rows[~numpy.isnan(rows[:, 0])]
assert len(rows) > 0
numpy.testing.assert_array_equal(cloud.points, rows[:, 1:4])
numpy.testing.assert_array_equal(cloud.point_data["quality"], rows[:, 4].astype(numpy.float32))
"""

PROFILER = """\
  mbes: {kind: profiling, azimuth_deg: 60, range_max_m: 6, range_bins: 64, azimuth_bins: 16}
output:
"""


class Map(Sandbox):
    @unittest.skipIf(PYTHON is None, "needs python3-meshio")
    def test_ply(self):
        self.edit("mission.yaml", "output:\n", PROFILER)
        self.assert_renders()
        read = subprocess.run([PYTHON, "-c", COMPARE, self.out / "mbes/soundings.ply",
                               self.out / "mbes/soundings.npy"],
                              text=True, capture_output=True, timeout=120, check=False)
        self.assertEqual(read.returncode, 0, read.stderr)

    @unittest.skipIf(shutil.which("gdalinfo") is None, "needs gdal-bin")
    def test_gdal(self):
        self.edit("mission.yaml", "output:\n", PROFILER)
        self.assert_renders()
        folder = self.out / "mbes"
        map_place = json.loads((folder / "bathymetry.json").read_text())
        result = subprocess.run(["gdalinfo", "-json", "-stats", folder / "bathymetry.tif"],
                                capture_output=True, text=True, timeout=60, check=True)
        self.assertEqual(result.stderr, "")
        info = json.loads(result.stdout)
        cell = map_place["cell_m"]
        self.assertEqual(info["size"], [map_place["columns"], map_place["rows"]])
        # x of the upper left corner, x by column, x by row; then y.
        self.assertEqual(info["geoTransform"],
                         [map_place["west_m"], cell, 0, map_place["north_m"], 0, -cell])
        band = info["bands"][0]
        self.assertEqual(band["type"], "Float32")
        self.assertTrue(math.isnan(float(band["noDataValue"])))
        # The floor of the box is 1.5 m below the sonar.
        self.assertAlmostEqual(band["mean"], -1.5, delta=0.1)

        # Every sounding of the text lies in the cell that GDAL finds at its place.
        lines = (folder / "soundings.csv").read_text().splitlines()[1:]
        points = [[float(x) for x in line.split(",")][4:7] for line in lines]
        for x, y, z in points[::7]:
            found = subprocess.run(["gdallocationinfo", "-valonly", "-geoloc",
                                    folder / "bathymetry.tif", str(x), str(y)],
                                   capture_output=True, text=True, timeout=60, check=True)
            self.assertAlmostEqual(float(found.stdout), z, delta=0.2)


if __name__ == "__main__":
    if shutil.which("gdalinfo") is None and PYTHON is None:
        sys.exit(77)
    unittest.main()
