"""sonarsim.data: opens what sonarsim writes, with numpy alone and without the compiled module. That every
kind of file is read: test_python.py."""
import json
import os
import re
import shutil
import sys
import tempfile

from sandbox import (IN_MEMORY, ROOT, Sandbox, box_gltf, box_mesh, csv_of, gltf, grid_mesh, mission_of, path_csv, run_with, sheet_mesh)

run_with("numpy")
PACKAGES = ROOT / "apps/python"
sys.path.insert(0, str(PACKAGES))
import numpy as np
from sonarsim import data as sonarsim_data

MISSION = mission_of("""\
  fls: {kind: imaging, azimuth_deg: 60, range_max_m: 6, range_bins: 40, azimuth_bins: 24,
        noise: {add_sigma: 0.05}}
  round: {kind: imaging, azimuth_deg: 200, range_max_m: 6, range_bins: 16, azimuth_bins: 90}
  full: {kind: imaging, azimuth_deg: 360, range_max_m: 6, range_bins: 16, azimuth_bins: 90}
  mbes: {kind: profiling, range_max_m: 6, range_bins: 16, azimuth_bins: 8, every: 2}
  sss: {kind: sidescan, range_max_m: 6, range_bins: 16}
  sounder: {kind: echosounder, range_max_m: 6, range_bins: 16}
  head: {kind: scanning, range_max_m: 6, range_bins: 16}
""", "image: true, stages: true, labels: [instance, share, class, elevation, objects]")
POSES = 7


class Reader(Sandbox):
    """All tests read copies of one dataset."""

    @classmethod
    def setUpClass(cls):
        cls.rendered = tempfile.mkdtemp(prefix="sonarsim-", dir=IN_MEMORY)
        cls.addClassCleanup(shutil.rmtree, cls.rendered)
        maker = Sandbox()
        maker.FILES = {"box.gltf": box_gltf().replace('"walls"', '"W\\u00e4nde"'), "mission.yaml": MISSION,
                       "path.csv": path_csv(POSES)}
        maker.setUp()
        maker.assert_renders("--out", cls.rendered + "/out")
        maker.doCleanups()

    def setUp(self):
        super().setUp()
        shutil.copytree(self.rendered + "/out", self.out)

    def open(self, name="out"):
        return sonarsim_data.open_dataset(self.folder / name)

    def test_what_a_sample_holds(self):
        dataset = self.open()
        self.assertTrue(dataset.complete)
        self.assertEqual(dataset.poses().shape, (POSES, 8))
        fls = dataset["fls"]
        sample = fls[3]
        self.assertEqual((fls.kind, sample["meta"]["ping"], len(fls[1:4])), ("imaging", sample.ping, 3))
        polar = sample["polar"]
        self.assertEqual((polar.dtype, polar.shape), (np.float32, (40, 24)))
        # The fan that sonarsim draws; the programs differ in how they mix bins, and not in where.
        fan = sample["fan"].astype(float)
        own = np.sqrt(fls.to_fan(polar, fan.shape[1]).clip(0, 1))
        self.assertEqual(own.shape, fan.shape)
        self.assertGreater(np.corrcoef(fan.ravel(), own.ravel())[0, 1], 0.8)
        # image is 65535 polar / full_scale, clipped at 1 and rounded.
        expected = np.floor(65535 * (polar.astype(np.float64) / fls.description["full_scale"]).clip(0, 1) + 0.5)
        self.assertLessEqual(np.abs(sample["image"] - expected).max(), 1)
        self.assertGreater(sample["image"].max(), 1000)
        # The box is the one instance, and has the whole of every bin that is occupied.
        self.assertEqual(list(dataset.instances.values()), ["W\u00e4nde"])
        self.assertEqual(set(np.unique(sample["instance"])), {0, 1})
        np.testing.assert_array_equal(65535 * sample["instance"], sample["share"])
        # range, x, y, z, quality, and the instance and class of the box, which all beams meet.
        self.assertEqual(dataset["mbes"][1]["soundings"][:, 5:].tolist(), 8 * [[1, 1]])
        self.assertEqual(fls.raw(-1, "polar"), fls.raw(len(fls) - 1, "polar"))

    def test_to_fan_and_back(self):
        """A fine fan and back is the same picture, but for bins next to the apex, which are smaller
        than any pixel; and a ramp in azimuth rises from starboard (right) to port (left)."""
        for name in ("fls", "round"):
            sensor = self.open()[name]
            polar = np.random.default_rng(1).random((len(sensor.range_edges_m) - 1, len(sensor.azimuth_edges_rad) - 1))
            back = sensor.from_fan(sensor.to_fan(polar, width=2000))
            # A pixel is reach / 1000 wide or less, and a bin of the row r about r * azimuth wide.
            np.testing.assert_array_equal(back[2:], polar[2:])
            ids = sensor.to_fan(np.ones(polar.shape, np.uint16), width=101)
            self.assertEqual((ids.dtype, set(np.unique(ids))), (np.uint16, {0, 1}))
            np.testing.assert_array_equal(ids, ids[:, ::-1])
            ramp = sensor.to_fan(np.broadcast_to(np.arange(polar.shape[1]), polar.shape), 101, -1)
            row = ramp[len(ramp) // 4]
            self.assertTrue((np.diff(row[row >= 0]) <= 0).all())
        # A full turn ends straight astern, on the middle column of an odd width.
        fan = self.open()["full"].to_fan(np.ones((16, 90)), 65)
        self.assertEqual(fan[3 * len(fan) // 4, 32], 1)

    def test_names_do_not_depend_on_the_locale(self):
        # A locale of ASCII alone reads UTF-8 wrongly, as that of Windows or Latin-1 does.
        ascii_only = {"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0", "PYTHONIOENCODING": "utf-8"}
        result = self.run_program(sys.executable, "-B", "-c", "import sys, sonarsim.data as data; "
                                  "print(data.open_dataset(sys.argv[1]).instances)", self.out, encoding="utf-8",
                                  env={**os.environ, **ascii_only, "PYTHONPATH": str(PACKAGES)})
        self.assertIn("1: 'W\u00e4nde'", result.stdout)

    def test_variants(self):
        for k in range(2):
            shutil.copytree(self.out, self.folder / f"many/variant_{k:04}")
        names = ["variant_0000", "variant_0001"]
        self.write("many/variants.json", json.dumps({"variants": [{"folder": name} for name in names]}))
        self.assertEqual([one.folder.name for one in sonarsim_data.open_datasets(self.folder / "many")], names)
        self.write("many/variants.json", '{"variants": [{"folder": "../many/variant_0000"}]}')
        with self.assertRaisesRegex(ValueError, "is not a name that sonarsim gives"):
            sonarsim_data.open_datasets(self.folder / "many")
        self.assertEqual(len(sonarsim_data.open_datasets(self.out)), 1)

    def test_mistakes(self):
        with self.assertRaisesRegex(ValueError, "no dataset.json"):
            self.open("nowhere")
        self.write("old/dataset.json", '{"format": "sonarsim dataset", "format_version": 1}')
        with self.assertRaisesRegex(ValueError, "format_version 1"):
            self.open("old")
        with self.assertRaisesRegex(KeyError, "'polar'"):
            self.open()["sss"][0]["polar"]
        with self.assertRaises(IndexError):
            self.open()["fls"][POSES]

    def test_hostile_datasets(self):
        """Every fault is a ValueError, and nothing outside the folder is read."""
        sound = (self.out / "dataset.json").read_text()
        self.write("secret/000000.json", '{"secret": 1}')
        for right, wrong in (('"fls/meta/%06d.json"', '"../secret/%06d.json"'), ('"fls/meta/%06d.json"', '"/etc/%06d.json"'),
                             ('"fls/meta/%06d.json"', '"fls/meta/%(x)d.json"'), ('"name": "fls"', '"name": "../secret"'),
                             ('"every": 2', '"every": -1'), ('"pings": 7', '"pings": 1e300'),
                             ('"mbes/soundings.npy"', '"../secret/x.npy"'), (sound, "[" * 200000)):
            self.assertIn(right, sound)
            self.write("out/dataset.json", sound.replace(right, wrong, 1))
            with self.subTest(wrong=wrong[:40]), self.assertRaises(ValueError):
                self.open()
        self.write("out/dataset.json", sound)
        (self.out / "fls/meta/000000.json").unlink()
        (self.out / "fls/meta/000000.json").symlink_to(self.folder / "secret/000000.json")
        with self.assertRaisesRegex(ValueError, "lies behind a link"):
            self.open()["fls"][0]["meta"]
        with self.assertRaisesRegex(TypeError, "takes a sensor"):
            sonarsim_data.torch_dataset(self.open())
        image = (self.out / "fls/image/000000.png").read_bytes()
        polar = (self.out / "fls/polar/000000.npy").read_bytes()
        for read, data in ((sonarsim_data.read_png, image[:16] + (1 << 30).to_bytes(4, "big") + image[20:]),
                           (sonarsim_data.read_png, image[:40]), (sonarsim_data.read_png, image[:-200]),
                           (sonarsim_data.read_png, b"no PNG at all"),
                           (sonarsim_data.read_npy, polar.replace(b"(40, 24)", b"(99, 99)")),
                           (sonarsim_data.read_npy, polar[:-1]), (sonarsim_data.read_npy, polar[:20])):
            with self.assertRaises(ValueError):
                read(data)


CALIBRATED = "range_max_m: 6, range_bins: 16, model: calibrated, instrument: {frequency_hz: 4.0e+5}"
KEYS = mission_of(f"""\
  fls: {{kind: imaging, azimuth_deg: 60, azimuth_bins: 8, {CALIBRATED}}}
  mbes: {{kind: profiling, azimuth_bins: 8, {CALIBRATED}}}
  sss: {{kind: sidescan, {CALIBRATED}}}
  sounder: {{kind: echosounder, {CALIBRATED}}}
  head: {{kind: scanning, {CALIBRATED}}}
""", "image: true, labels: [instance]", """\
variants: 1
vary: [{key: sensors.fls.mount.rpy_deg.0, uniform: [-2, 2], per: ping}]
vehicle: {navigation: {position_m: 0.1}}
""", """file: box.gltf, objects: [{name: crate, file: crate.gltf, trajectory: {file: crate.csv}}],
  particles: [{name: school, count: 5, length_m: 0.2, position_m: [1, 0, 0], size_m: [1, 1, 1]}]""")


class DrawnScene:
    """A floor with boxes and balls at random, and the distance of a point from each of them."""

    def __init__(self, seed):
        draw = np.random.default_rng(seed)
        self.surfaces = {"floor": lambda p: np.abs(p[:, 2] + 2)}
        self.nodes, self.meshes = [{"name": "floor", "mesh": 0, "translation": [0, -2, 0]}], [sheet_mesh(20.0)]
        for k in range(8):
            azimuth, r, size = draw.uniform(-0.9, 0.9), draw.uniform(3, 7), draw.uniform(0.3, 0.9, 3)
            centre = np.array([r * np.cos(azimuth), r * np.sin(azimuth), draw.uniform(-2, 2)])
            self.add(f"box_{k}", centre, box_mesh(size[[0, 2, 1]]), lambda p, c=centre, h=size: self.of_box(p, c, h))
            centre = centre + draw.uniform(-1.5, 1.5, 3) * [1, 1, 0.5]
            self.add(f"ball_{k}", centre, self.ball(size[0]), lambda p, c=centre, h=size[0]: np.abs(np.linalg.norm(p - c, axis=1) - h))

    def add(self, name, centre, mesh, distance):
        x, y, z = centre
        self.nodes.append({"name": name, "mesh": len(self.meshes), "translation": [x, z, -y]})
        self.meshes.append(mesh)
        self.surfaces[name] = distance

    @staticmethod
    def of_box(points, centre, half):
        beyond = np.abs(points - centre) - half
        return np.abs(np.linalg.norm(np.maximum(beyond, 0), axis=1) + np.minimum(beyond.max(axis=1), 0))

    @staticmethod
    def ball(radius, n=48):
        """A sphere of n x 2 n quads, whose facets lie within 0.002 of the radius."""
        rows, columns = np.mgrid[:n + 1, :2 * n + 1] * np.pi / n
        points = radius * np.stack([np.sin(rows) * np.cos(columns), np.cos(rows), np.sin(rows) * np.sin(columns)], -1)
        return grid_mesh(points.reshape(-1, 3).tolist(), 2 * n + 1)


FAN = """kind: imaging, azimuth_deg: 110, elevation_deg: 60, range_min_m: 1, range_max_m: 9, range_bins: 250,
        azimuth_bins: 200, mount: {translation_m: [0.5, 0.2, -0.1], rpy_deg: [4, 15, 0]}"""
POINTS = mission_of(f"""\
  angles: {{{FAN}}}
  cones: {{{FAN}, model: calibrated, instrument: {{frequency_hz: 1.0e+6}}}}
  mbes: {{kind: profiling, range_max_m: 6, range_bins: 200, azimuth_bins: 120}}
  sss: {{kind: sidescan, range_max_m: 6, range_bins: 16}}
""", "fan: false, labels: [instance, class, elevation]", 'classes: [{nodes: "ball*", class: ball}]\n', "file: drawn.gltf")


class Others(Sandbox):
    def rows_below(self, heading):
        """The keys of the first table below a heading of docs/dataset.md."""
        text = (ROOT / "docs/dataset.md").read_text().split(heading + "\n", 1)[1].split("\n#", 1)[0]
        rows = [line.split("|")[1] for line in text.splitlines() if line.startswith("| `")]
        return {key for row in rows for key in re.findall("`([^`]+)`", row)}

    def test_the_tables_of_the_page_have_the_keys_of_a_dataset(self):
        """A key stands in its table, or all keys below it do; and a dataset has every key of the tables."""
        self.write("crate.gltf", gltf([{"name": "crate", "mesh": 0}], [box_mesh((0.1, 0.1, 0.1))]))
        self.write("crate.csv", path_csv(6, "1.5,0,0,0,0"))     # not around the sonars
        self.write("mission.yaml", KEYS)
        self.assert_renders()
        blocks = self.dataset("out/variant_0000")["sensors"]
        metas = [self.json(f"out/variant_0000/{one['name']}/meta/000000.json") for one in blocks]
        for heading, found in (("### The description of a sensor", blocks), ("### The metadata of a ping", metas)):
            rows, keys = self.rows_below(heading), set()
            for block in found:
                for key, value in block.items():
                    keys |= {key} if key in rows or not isinstance(value, dict) else {f"{key}.{inner}" for inner in value}
            self.assertEqual(keys, rows)

    def test_points_lie_on_the_surfaces_of_the_scene(self):
        """By each model, and in each frame: a column of the calibrated model is a cone, not an azimuth."""
        drawn = DrawnScene(3)
        self.write("drawn.gltf", gltf(drawn.nodes, drawn.meshes))
        self.write("path.csv", csv_of("0,0,0,0,0,0,0", "1,0.5,-0.2,0.1,5,-3,20"))
        self.write("mission.yaml", POINTS)
        self.assert_renders()
        dataset = sonarsim_data.open_dataset(self.out)
        floor = next(k for k, name in dataset.classes.items() if name == "floor")
        # The bins are 0.03 m deep, and up to 0.09 m wide; those of mbes 0.03 and 0.13 m. The floor tells nothing.
        for name, least, median, most in (("angles", 2000, 0.005, 0.1), ("cones", 2000, 0.005, 0.1), ("mbes", 100, 0.02, 0.1)):
            sensor = dataset[name]
            for sample in sensor:
                points = sensor.points(sample, spread_rad=0.03)
                self.assertEqual(points.position_m.shape, (len(points.instance), 3))
                np.testing.assert_array_equal(sample["instance"][tuple(points.bins.T)], points.instance)
                np.testing.assert_array_equal([dataset.class_of[k] for k in points.instance], points.class_id)
                off = np.full(len(points.instance), np.nan)
                for number, instance in dataset.instances.items():
                    own = points.instance == number
                    off[own] = drawn.surfaces[instance](points.position_m[own])
                off = off[points.class_id != floor] if name != "mbes" else off
                self.assertGreater(len(off), least)
                self.assertLess(np.median(off), median, name)
                self.assertLess(off.max(), most, name)
                inner, vehicle = (sensor.points(sample, frame, 0.03).position_m for frame in ("sensor", "vehicle"))
                ranges = sonarsim_data.middles(sensor.range_edges_m)[points.bins[:, 0]]
                self.assert_near(np.linalg.norm(inner, axis=1), ranges)
                meta = sample["meta"]
                for found, pose, expected in ((vehicle, meta["T_world_vehicle"], points.position_m),
                                              (inner, sensor.description["T_vehicle_sensor"], vehicle)):
                    np.testing.assert_allclose(sonarsim_data.moved(found, pose), expected, atol=1e-9)
        for name, words in (("sss", "sidescan sonars have no fan"), ("angles", "there is no frame 'ship'")):
            with self.assertRaisesRegex(ValueError, words):
                dataset[name].points(dataset[name][0], "ship")
