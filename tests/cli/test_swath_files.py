"""Files of a survey as other programs see them: waterfall.xtf as a reader that knows the published format alone
(Debian has no program that reads XTF), mosaic.tif and bathymetry.tif as GDAL, soundings.ply as meshio."""
import json
import math
import shutil
import struct
import unittest

from sandbox import Rendered, Sandbox, box_gltf, python_with, with_keys

# A flat sea floor at z = -10 of 60 x 60 m and a steel block on it, half a metre each way, at (6, -12).
MISSION = """\
name: swath
scene:
  materials: materials.csv
  water_surface: {height_m: 2}
  objects:
    - {name: floor, file: floor.gltf, position_m: [0, 0, -11]}
    - {name: block, file: block.gltf, position_m: [6, -12, -9.5]}
trajectory:
  waypoints:
    - {position_m: [-5, 0, 0], rpy_deg: [0, 0, 0]}
    - {position_m: [15, 0, 0], rpy_deg: [0, 0, 0]}
  speed_m_s: 1
  rate_hz: 4
sensors:
  sss: {kind: sidescan, elevation_deg: 1, range_max_m: 25, range_bins: 245, mount: {translation_m: [-1, 0, 0]}}
output: {folder: out, polar: false, fan: false, xtf: true, mosaic: true, full_scale: 0.5}
"""
MATERIALS = "material,density_kg_m3,sound_speed_m_s\nSand,1400,1520\nSteel,7850,5890\n"


def read_xtf(data):
    """The names of the channels, and of each ping its numbers and the samples of both sides."""
    assert (data[0], data[2:10]) == (123, b"sonarsim")
    pings, at = [], 1024
    while at < len(data):
        magic, kind, channels, size, *time, day = struct.unpack_from("<HBxHxxxxIHBBBBBBH", data, at)
        assert (magic, kind, channels, size % 64) == (0xFACE, 0, 2, 0)
        ping = {"time": time, "day": day, "number": struct.unpack_from("<I", data, at + 28)[0],
                "ship": struct.unpack_from("<f4xdd8xf", data, at + 120),
                "place": struct.unpack_from("<f124xdd16xff4xfff", data, at + 32), "sides": []}
        side = at + 256
        for _ in range(channels):
            count, = struct.unpack_from("<I", data, side + 42)
            ping["sides"].append((*struct.unpack_from("<H2xff4xff", data, side), struct.unpack_from(f"<{count}H", data, side + 64)))
            side += 64 + 2 * count
        pings.append(ping)
        at += size
    assert at == len(data)
    return [(data[at], struct.unpack_from("<H", data, at + 6)[0], data[at + 12:at + 28].rstrip(b"\0"),
             *struct.unpack_from("<4f", data, at + 32)) for at in (256, 384)], pings


class SwathFiles(Rendered):
    FILES = {"mission.yaml": MISSION, "materials.csv": MATERIALS, "floor.gltf": box_gltf((30, 1, 30), "Sand"),   # y is up
             "block.gltf": box_gltf((0.5, 0.5, 0.5), "Steel")}

    def test_xtf(self):
        channels, pings = read_xtf((self.out / "sss/waterfall.xtf").read_bytes())
        self.assertEqual(channels, [(1, 2, b"Port", 0, 1, 0, 85), (2, 2, b"Starboard", 0, 1, 0, 85)])
        self.assertEqual(len(pings), 81)
        for k, ping in enumerate(pings):
            self.assertEqual(ping["number"], k)
            # A quarter of a second and of a metre from ping to ping, from 1970 on, along x: east.
            self.assertEqual((ping["time"], ping["day"]), ([1970, 1, 1, 0, 0, k // 4, 25 * (k % 4)], 1))
            half_speed, y, x, depth, altitude, pitch, roll, heading = ping["place"]
            self.assert_near((x, y, depth, pitch, roll), (-6 + 0.25 * k, 0, 2, 0, 0))
            self.assert_near(ping["ship"], (3.6 / 1.852, 0, -5 + 0.25 * k, 3.6 / 1.852), 1e-6)   # 1 m/s in knots
            self.assert_near((heading, half_speed), (90, 740), 1e-3)
            self.assertAlmostEqual(altitude, 10, delta=0.2)
            for side, (number, slant_m, ground_m, duration_s, interval_s, samples) in enumerate(ping["sides"]):
                self.assertEqual((number, slant_m, interval_s), (side, 25, 0.25))
                self.assert_near((ground_m, 1000 * duration_s), (math.sqrt(25**2 - altitude**2), 2000 * 25 / 1480), 1e-3)
                # 24.5 m in 245 bins, and one blank one before. Nothing echoes before the bottom does: port ends at
                # nadir, starboard begins there.
                self.assertEqual(len(samples), 250)
                outwards = samples if side else samples[::-1]
                self.assertEqual(max(outwards[:90]), 0)
                self.assertGreater(max(outwards[110:]), 0)
        # The block is to starboard, 11.5 m off track and 9 to 10 m below, where x is 6.
        port, starboard = (side[-1] for side in pings[48]["sides"])
        self.assertAlmostEqual((starboard.index(max(starboard)) + 0.5) * 0.1, math.hypot(11.5, 9), delta=1.0)
        self.assertGreater(max(starboard), 3 * max(port))

    def test_xtf_of_an_instrument(self):
        """The header has frequency in kHz, beamwidth along track, tilt and beamwidth across track."""
        self.edit("mission.yaml", "kind: sidescan,", "kind: sidescan, model: calibrated, instrument: "
                  "{frequency_hz: 450000, beam: {width_deg: 0.5, tilt_deg: 25, across_width_deg: 40}},")
        self.assert_renders("--overwrite", "--set", "trajectory.rate_hz=0.2")
        channels, _ = read_xtf((self.out / "sss/waterfall.xtf").read_bytes())
        self.assertEqual([channel[3:] for channel in channels], 2 * [(450, 0.5, 25, 40)])

    def test_xtf_of_a_turned_mount(self):
        """The channels are port and starboard of the heading, that of the sonar: the block is to port of one that
        faces astern. A mount that rolls by 10 degrees rolls the sonar."""
        self.edit("mission.yaml", "translation_m: [-1, 0, 0]", "rpy_deg: [10, 0, 180]")
        self.assert_renders("--overwrite")
        _, pings = read_xtf((self.out / "sss/waterfall.xtf").read_bytes())
        for ping in pings:
            self.assert_near(ping["place"][-3:], (0, 10, 270), 1e-4)
        port, starboard = (side[-1] for side in pings[44]["sides"])
        self.assertGreater(max(port), 3 * max(starboard))

    @unittest.skipIf(shutil.which("gdalinfo") is None, "needs gdalinfo")
    def test_mosaic(self):
        pitched = (f"trajectory.waypoints.{k}.rpy_deg.1=5" for k in (0, 1))
        self.assert_renders("--overwrite", *with_keys("trajectory.rate_hz=8", *pitched))     # cells of 0.2 m
        path = self.out / "sss/mosaic.tif"
        place = self.json("out/sss/mosaic.json")
        cell = place["cell_m"]

        def echo(x, y):
            return float(self.run_program("gdallocationinfo", "-valonly", "-geoloc", path, x, y).stdout)

        # The side of the block that faces the sonar echoes before the floor below it: at the slant range
        # of its foot and of its top, (11.5, 10) and (11.5, 9), that is 11.5 and 10.7 m on level ground.
        block = max(echo(6, y / 10) for y in range(-120, -104, 2))
        self.assertGreater(block, 3 * echo(6, 11))
        self.assertGreater(block, 3 * echo(2, -11))
        self.assertGreater(block, 3 * echo(10, -11))
        # Behind it lies its shadow: from its top at (11.5..12.5, 9) the ray meets the floor at
        # 12.5 * 10 / 9 = 13.9 m.
        self.assertLess(echo(6, -13.2), 0.2 * echo(2, -13.2))
        # As long as the track, and as wide as 25 m of slant range reach on ground 10 m below.
        self.assertAlmostEqual(place["columns"] * cell, 20, delta=2 * cell)
        self.assertAlmostEqual(place["rows"] * cell, 2 * math.sqrt(25**2 - 10**2), delta=2 * cell)
        self.assertEqual((place["pings"], place["pings_left_out"]), (161, 0))
        self.assert_renders("--overwrite", *with_keys("trajectory.rate_hz=8", "sensors.sss.range_min_m=14"))
        self.assertTrue(math.isnan(echo(2, -5)) and echo(2, -11) > 0.0)

    @unittest.skipIf(shutil.which("gdal_translate") is None, "needs gdal-bin")
    def test_a_mosaic_of_lines_that_overlap(self):
        """Over a level floor no step lies where a swath begins or ends, and a turn leaves no comb of empty cells."""
        self.edit("mission.yaml", "    - {name: block, file: block.gltf, position_m: [6, -12, -9.5]}\n", "")
        self.edit("mission.yaml", "    - {position_m: [15, 0, 0], rpy_deg: [0, 0, 0]}\n", "".join(
            f"    - {{position_m: [15, {y}, 0], rpy_deg: [0, 0, {yaw}]}}\n" for y, yaw in ((0, 0), (7, 180)))
            + "    - {position_m: [-5, 7, 0], rpy_deg: [0, 0, 180]}\n")
        self.assert_renders("--overwrite")
        self.run_program("gdal_translate", "-q", "-of", "AAIGrid", "-co", "FORCE_CELLSIZE=YES", "out/sss/mosaic.tif", "mosaic.asc")
        lines = (self.folder / "mosaic.asc").read_text().splitlines()
        rows = [[float(word) for word in line.split()] for line in lines if len(line.split()) > 2]
        for above, below in zip(rows[2:-4], rows[3:-3]):
            one, other = (sum(row[12:28]) for row in (above, below))    # away from the ends of the lines
            self.assertAlmostEqual(one / other, 1, delta=0.08)
        for row in rows:
            filled = [k for k, value in enumerate(row) if not math.isnan(value)]
            self.assertEqual(len(filled), filled[-1] + 1 - filled[0])


class Others(Sandbox):
    @unittest.skipIf(python_with("meshio") is None, "needs python3-meshio")
    def test_ply(self):
        self.edit("mission.yaml", "output:\n", "  mbes: {kind: profiling, azimuth_deg: 60, range_max_m: 6, range_bins: 64, "
                  "azimuth_bins: 16}\noutput:\n")
        self.assert_renders("--set", "output.labels=[instance, class]")
        compare = """
import sys, meshio, numpy
cloud, rows = meshio.read(sys.argv[1]), numpy.load(sys.argv[2])
rows = rows.reshape(-1, rows.shape[-1])
rows = rows[~numpy.isnan(rows[:, 0])]
assert len(rows) > 0
numpy.testing.assert_array_equal(cloud.points, rows[:, 1:4])
numpy.testing.assert_array_equal(cloud.point_data["quality"], rows[:, 4].astype(numpy.float32))
for k, name in enumerate(("instance", "class"), start=5):
    numpy.testing.assert_array_equal(cloud.point_data[name], rows[:, k])
    assert rows[:, k].min() > 0
"""
        files = [self.out / "mbes" / name for name in ("soundings.ply", "soundings.npy")]
        self.run_program(python_with("meshio"), "-c", compare, *files)

    @unittest.skipIf(shutil.which("gdal_translate") is None, "needs gdal-bin")
    def test_utm(self):
        """Over a heightmap in UTM's zone 32, maps and pings have its coordinates, and GDAL finds its heights there."""
        self.write("materials.csv", MATERIALS)
        west, south = 505_000, 5_987_000
        slope = "\n".join(" ".join(f"{-12 + 0.1 * column:.1f}" for column in range(60)) for row in range(60))
        self.write("map.asc", f"ncols 60\nnrows 60\nxllcorner {west}\nyllcorner {south}\ncellsize 1\n{slope}\n")
        self.run_program("gdal_translate", "-q", "-a_srs", "EPSG:32632", "-ot", "Float32", "map.asc", "map.tif")
        objects = MISSION[MISSION.index("  objects:"):MISSION.index("trajectory:")]
        self.write("mission.yaml", MISSION.replace(
            objects, f"  heightmap: {{file: map.tif, origin_m: [{west + 20}, {south + 30}], material: Sand}}\n").replace(
            "output:", "  mbes: {kind: profiling, azimuth_deg: 90, range_max_m: 25, range_bins: 500}\noutput:"))
        self.assert_renders()
        for name in ("mbes/bathymetry", "sss/mosaic"):
            result, place = self.run_program("gdalinfo", "-json", f"out/{name}.tif"), self.json(f"out/{name}.json")
            self.assertEqual(result.stderr, "")
            info = json.loads(result.stdout)
            self.assertIn('ID["EPSG",32632]', info["coordinateSystem"]["wkt"])
            # x of the upper left corner, x by column, x by row; then y.
            cell, left, top = place["cell_m"], place["west_m"], place["north_m"]
            self.assertEqual((info["geoTransform"], info["size"]),
                             ([left, cell, 0, top, 0, -cell], [place["columns"], place["rows"]]))
            self.assertTrue(west < left < west + 60 and south < top - cell < south + 60)
            band = info["bands"][0]
            self.assertEqual((band["type"], math.isnan(float(band["noDataValue"]))), ("Float32", True))
        heights = [float(self.run_program("gdallocationinfo", "-valonly", "-geoloc", path, west + 25.5, south + 30.5).stdout)
                   for path in ("map.tif", self.out / "mbes/bathymetry.tif")]
        self.assertAlmostEqual(*heights, delta=0.1)
        pings = read_xtf((self.out / "sss/waterfall.xtf").read_bytes())[1]
        self.assertAlmostEqual(max(pings[0]["place"]), south + 30, delta=0.01)
