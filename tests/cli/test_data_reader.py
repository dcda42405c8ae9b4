"""sonarsim.data: opens what sonarsim writes, with numpy alone and without the compiled module."""
import json
import os
import pathlib
import subprocess
import sys
import unittest

from sandbox import Sandbox, path_csv, python_with

PACKAGES = pathlib.Path(__file__).resolve().parents[2] / "apps/python"
sys.path.insert(0, str(PACKAGES))

try:
    import numpy as np
    from sonarsim import data as sonarsim_data
except ImportError:
    # Debian's numpy belongs to Debian's Python.
    python = python_with("numpy")
    if python is None or python == sys.executable:
        print("needs numpy")
        sys.exit(77)
    os.execv(python, [python, "-B", __file__])

MISSION = """\
name: reader
seed: 7
scene: {file: box.gltf, materials: materials.csv}
trajectory: {file: path.csv}
sensors:
  fls: {kind: imaging, azimuth_deg: 60, range_max_m: 6, range_bins: 40, azimuth_bins: 24,
        noise: {add_sigma: 0.05}}
  round: {kind: imaging, azimuth_deg: 200, range_max_m: 6, range_bins: 16, azimuth_bins: 90}
  mbes: {kind: profiling, range_max_m: 6, range_bins: 16, azimuth_bins: 8, every: 2}
  sss: {kind: sidescan, range_max_m: 6, range_bins: 16}
  sounder: {kind: echosounder, range_max_m: 6, range_bins: 16}
  head: {kind: scanning, range_max_m: 6, range_bins: 16}
output: {folder: out, image: true, stages: true, labels: [instance, share, class, elevation, objects]}
"""
POSES = 7


class Reader(Sandbox):
    def setUp(self):
        super().setUp()
        self.write("mission.yaml", MISSION)
        self.write("path.csv", path_csv(POSES))
        self.assert_renders()

    def open(self, name="out"):
        return sonarsim_data.open_dataset(self.folder / name)

    def test_every_content_is_read(self):
        looked_at = set()
        for one in self.open():
            for name in one:
                with self.subTest(sample=one, name=name):
                    self.assertIsNotNone(one[name])
                    looked_at.add(name)
        self.assertLessEqual({"polar", "image", "fan", "stages", "meta", "objects", "instance",
                              "elevation", "waterfall", "echogram", "scan", "soundings"}, looked_at)

    def test_what_a_sample_holds(self):
        dataset = self.open()
        self.assertTrue(dataset.complete)
        self.assertEqual(dataset.poses().shape, (POSES, 8))
        fls = dataset["fls"]
        self.assertEqual(fls.kind, "imaging")
        sample = fls[3]
        self.assertEqual(sample["meta"]["ping"], sample.ping)
        polar = sample["polar"]
        self.assertEqual((polar.dtype, polar.shape), (np.float32, (40, 24)))
        # image is 65535 polar / full_scale, clipped at 1 and rounded.
        white = fls.description["full_scale"]
        expected = np.floor(65535 * (polar.astype(np.float64) / white).clip(0, 1) + 0.5)
        self.assertLessEqual(np.abs(sample["image"] - expected).max(), 1)
        self.assertGreater(sample["image"].max(), 1000)
        # The box is the one instance, and lights every bin that is lit.
        self.assertEqual(list(dataset.instances.values()), ["walls"])
        self.assertEqual(set(np.unique(sample["instance"])), {0, 1})
        self.assertEqual(dataset.class_of[1], 1)
        np.testing.assert_array_equal(sample["instance"] > 0, sample["share"] > 0)
        self.assertEqual(sample["stages"].shape[:2], sample["stages"].shape)
        self.assertEqual([s.ping for s in dataset["mbes"]], [0, 2, 4, 6])
        self.assertEqual(dataset["mbes"][1]["soundings"].shape, (8, 5))
        row = dataset["sss"][2]
        self.assertEqual(row["waterfall"].shape, row["instance"].shape)
        self.assertEqual(dataset["sounder"][2]["echogram"].shape, (16,))
        np.testing.assert_array_equal(dataset["sounder"][2]["echogram"],
                                      np.load(self.out / "sounder/echogram.npy")[:, 2])
        self.assertEqual(dataset["head"][-1]["scan"].shape, (16,))
        self.assertEqual(len(fls[1:4]), 3)

    def test_to_fan_and_back(self):
        """A fine fan and back is the same picture, but for bins next to the apex, which are smaller
        than any pixel; and a ramp in azimuth rises from starboard (right) to port (left)."""
        for name in ("fls", "round"):
            sensor = self.open()[name]
            polar = np.random.default_rng(1).random((len(sensor.range_edges_m) - 1,
                                                     len(sensor.azimuth_edges_rad) - 1))
            back = sensor.from_fan(sensor.to_fan(polar, width=4000))
            # A pixel is reach / 2000 wide or less, and a bin of the row r about r * azimuth wide.
            np.testing.assert_array_equal(back[2:], polar[2:])
            self.assertGreater((back == polar).mean(), 0.97)
            ids = sensor.to_fan(np.ones(polar.shape, np.uint16), width=101)
            self.assertEqual(ids.dtype, np.uint16)
            self.assertEqual(set(np.unique(ids)), {0, 1})
            np.testing.assert_array_equal(ids, ids[:, ::-1])
            ramp = sensor.to_fan(np.broadcast_to(np.arange(polar.shape[1]), polar.shape), 101, -1)
            row = ramp[len(ramp) // 4]
            self.assertTrue((np.diff(row[row >= 0]) <= 0).all())

    def test_to_fan_straight_astern(self):
        """A full turn ends straight astern, on the middle column of an odd width."""
        self.assert_renders("--out", "full", "--set", "sensors.round.azimuth_deg=360")
        sensor = self.open("full")["round"]
        shape = (len(sensor.range_edges_m) - 1, len(sensor.azimuth_edges_rad) - 1)
        height, _, _ = sensor.fan_shape(65)
        fan = sensor.to_fan(np.ones(shape), 65)
        self.assertEqual(fan[3 * height // 4, 32], 1)

    def test_negative_indices_count_from_the_end(self):
        sensor = self.open()["fls"]
        self.assertEqual(sensor.raw(-1, "polar"), sensor.raw(len(sensor) - 1, "polar"))

    def test_the_fan_is_that_of_sonarsim(self):
        """Same frame, same place: the programs differ in how they mix bins, and not in where."""
        sensor = self.open()["fls"]
        sample = sensor[6]      # the walls stand askew
        fan = sample["fan"].astype(float)
        self.assertEqual(sensor.fan_shape(fan.shape[1])[0], fan.shape[0])
        ours = 255 * np.sqrt(sensor.to_fan(sample["polar"], fan.shape[1]).clip(0, 1))

        def likeness(other):
            return np.corrcoef(fan.ravel(), other.ravel())[0, 1]

        self.assertGreater(likeness(ours), 0.8)
        self.assertGreater(likeness(ours), likeness(ours[:, ::-1]) + 0.05)
        self.assertGreater(likeness(ours), likeness(ours[::-1]) + 0.3)

    def describe(self, folder="out", **variables):
        """What the command prints of the dataset."""
        result = subprocess.run([sys.executable, "-B", PACKAGES / "sonarsim/data.py", self.folder / folder],
                                capture_output=True, text=True, check=False, encoding="utf-8",
                                env={**os.environ, **variables})
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def test_names_in_any_locale(self):
        gltf = self.folder / "box.gltf"
        self.write("box.gltf", gltf.read_text().replace('"walls"', '"W\\u00e4nde"'))
        self.assert_renders("--overwrite")
        # A locale of ASCII alone, as that of Windows or Latin-1 reads UTF-8 wrongly, too.
        ascii_only = {"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0", "PYTHONIOENCODING": "utf-8"}
        self.assertIn("instances: 1 W\u00e4nde", self.describe(**ascii_only))

    def test_many_datasets(self):
        variants = [str(self.folder / "many" / f"variant_{k:04}") for k in range(3)]
        self.assert_renders("--set", "variants=3", "--out", "many")
        found = sonarsim_data.open_datasets(self.folder / "many")
        self.assertEqual([str(one.folder) for one in found], variants)
        self.assertEqual(len(sonarsim_data.open_datasets(variants[0])), 1)
        self.write("many/variants.json", '{"variants": [{"folder": "../many/variant_0000"}]}')
        with self.assertRaisesRegex(ValueError, "is not a name that sonarsim gives"):
            sonarsim_data.open_datasets(self.folder / "many")

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
        for data in (b"no PNG at all", b"\x89PNG\r\n\x1a\n" + b"\0\0\0\x0dIHDR" +
                     bytes([0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0]) + b"\0\0\0\0"):
            with self.assertRaises(ValueError):
                sonarsim_data.read_png(data)

    def test_the_command(self):
        result = subprocess.run([sys.executable, "-B", PACKAGES / "sonarsim/data.py", self.out],
                                capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("mbes: profiling, 4 pings", result.stdout)
        self.assertIn("instances: 1 walls", result.stdout)
        result = subprocess.run([sys.executable, "-B", PACKAGES / "sonarsim/data.py", self.folder],
                                capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 1)
        self.assertIn("no dataset.json", result.stderr)

    @unittest.skipIf(python_with("torch") is None, "needs torch")
    def test_torch(self):
        program = ("import sys; sys.path.insert(0, sys.argv[1]); import torch; from sonarsim import data as sonarsim_data\n"
                   "data = sonarsim_data.torch_dataset(sonarsim_data.open_dataset(sys.argv[2])['fls'],"
                   " ('polar', 'instance'))\n"
                   "assert isinstance(data, torch.utils.data.Dataset)\n"
                   "loader = torch.utils.data.DataLoader(data, batch_size=2, num_workers=2)\n"
                   "print([(tuple(x.shape), str(y.dtype)) for x, y in loader])\n")
        result = subprocess.run([python_with("torch"), "-B", "-c", program, PACKAGES, self.out],
                                capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(result.stdout.count("(2, 40, 24)"), 3)
        self.assertIn("torch.int32", result.stdout)

    def test_hostile_datasets(self):
        """Every fault is a ValueError, and nothing outside the folder is read."""
        sound = (self.out / "dataset.json").read_text()
        self.write("secret/000000.json", '{"secret": 1}')
        for keys, value in ((("sensors", 0, "files", "meta"), "../secret/%06d.json"),
                            (("sensors", 0, "files", "meta"), "fls/../../secret/%06d.json"),
                            (("sensors", 0, "files", "meta"), f"{self.folder}/secret/%06d.json"),
                            (("sensors", 0, "files", "meta"), "fls/%06d-%06d.json"),
                            (("sensors", 0, "files", "meta"), "fls/meta/%(x)d.json"),
                            (("sensors", 0, "files", "meta"), 7),
                            (("sensors", 0, "name"), "../secret"),
                            (("sensors", 0, "every"), -1),
                            (("sensors", 0, "pings"), 1 << 70),
                            (("sensors", 3, "records", "file"), "../secret/x.npy"),
                            (("sensors",), 5)):
            reported = json.loads(sound)
            inner = reported
            for key in keys[:-1]:
                inner = inner[key]
            inner[keys[-1]] = value
            self.write("out/dataset.json", json.dumps(reported))
            with self.subTest(keys=keys, value=value), self.assertRaises(ValueError):
                self.open()
        self.write("out/dataset.json", sound)
        (self.out / "fls/meta/000000.json").unlink()
        (self.out / "fls/meta/000000.json").symlink_to(self.folder / "secret/000000.json")
        with self.assertRaisesRegex(ValueError, "lies behind a link"):
            self.open()["fls"][0]["meta"]
        for text in ("[" * 200000, "7", "{"):
            self.write("out/dataset.json", text)
            with self.assertRaises(ValueError):
                self.open()

    def test_files_that_tell_more_than_they_hold(self):
        image = (self.out / "fls/image/000000.png").read_bytes()
        huge = image[:16] + (1 << 30).to_bytes(4, "big") + image[20:]
        for data in (huge, image[:40], image[:8], image[:-200]):
            with self.subTest(bytes=len(data)), self.assertRaises(ValueError):
                sonarsim_data.read_png(data)
        polar = (self.out / "fls/polar/000000.npy").read_bytes()
        for data in (polar.replace(b"(40, 24)", b"(99, 99)"), polar[:-1], polar[:20]):
            with self.subTest(bytes=len(data)), self.assertRaises(ValueError):
                sonarsim_data.read_npy(data)


if __name__ == "__main__":
    unittest.main()
