"""sonarsim.data: opens what sonarsim writes, with numpy alone and without the compiled module. That every
kind of file is read: test_python.py."""
import json
import os
import shutil
import sys
import tempfile
import unittest

from sandbox import IN_MEMORY, ROOT, Sandbox, box_gltf, path_csv, run_with

run_with("numpy")
PACKAGES = ROOT / "apps/python"
sys.path.insert(0, str(PACKAGES))
import numpy as np
from sonarsim import data as sonarsim_data

MISSION = """\
name: reader
seed: 7
scene: {file: box.gltf, materials: materials.csv}
trajectory: {file: path.csv}
sensors:
  fls: {kind: imaging, azimuth_deg: 60, range_max_m: 6, range_bins: 40, azimuth_bins: 24,
        noise: {add_sigma: 0.05}}
  round: {kind: imaging, azimuth_deg: 200, range_max_m: 6, range_bins: 16, azimuth_bins: 90}
  full: {kind: imaging, azimuth_deg: 360, range_max_m: 6, range_bins: 16, azimuth_bins: 90}
  mbes: {kind: profiling, range_max_m: 6, range_bins: 16, azimuth_bins: 8, every: 2}
  sss: {kind: sidescan, range_max_m: 6, range_bins: 16}
  sounder: {kind: echosounder, range_max_m: 6, range_bins: 16}
  head: {kind: scanning, range_max_m: 6, range_bins: 16}
output: {folder: out, image: true, stages: true, labels: [instance, share, class, elevation, objects]}
"""
POSES = 7


class Reader(Sandbox):
    """All tests read copies of one dataset."""

    @classmethod
    def setUpClass(cls):
        cls.rendered = tempfile.mkdtemp(prefix="sonarsim-", dir=IN_MEMORY)
        cls.addClassCleanup(shutil.rmtree, cls.rendered)
        maker = Sandbox()
        maker.setUp()
        maker.write("box.gltf", box_gltf().replace('"walls"', '"W\\u00e4nde"'))
        maker.write("mission.yaml", MISSION)
        maker.write("path.csv", path_csv(POSES))
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
        # image is 65535 polar / full_scale, clipped at 1 and rounded.
        expected = np.floor(65535 * (polar.astype(np.float64) / fls.description["full_scale"]).clip(0, 1) + 0.5)
        self.assertLessEqual(np.abs(sample["image"] - expected).max(), 1)
        self.assertGreater(sample["image"].max(), 1000)
        # The box is the one instance, and has the whole of every bin that is occupied.
        self.assertEqual(list(dataset.instances.values()), ["W\u00e4nde"])
        self.assertEqual(set(np.unique(sample["instance"])), {0, 1})
        np.testing.assert_array_equal(65535 * sample["instance"], sample["share"])
        self.assertEqual(dataset["mbes"][1]["soundings"].shape, (8, 5))
        self.assertEqual(fls.raw(-1, "polar"), fls.raw(len(fls) - 1, "polar"))

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
            ids = sensor.to_fan(np.ones(polar.shape, np.uint16), width=101)
            self.assertEqual((ids.dtype, set(np.unique(ids))), (np.uint16, {0, 1}))
            np.testing.assert_array_equal(ids, ids[:, ::-1])
            ramp = sensor.to_fan(np.broadcast_to(np.arange(polar.shape[1]), polar.shape), 101, -1)
            row = ramp[len(ramp) // 4]
            self.assertTrue((np.diff(row[row >= 0]) <= 0).all())
        # A full turn ends straight astern, on the middle column of an odd width.
        fan = self.open()["full"].to_fan(np.ones((16, 90)), 65)
        self.assertEqual(fan[3 * len(fan) // 4, 32], 1)

    def test_the_fan_is_that_of_sonarsim(self):
        """Same frame, same place: the programs differ in how they mix bins, and not in where."""
        sensor = self.open()["fls"]
        sample = sensor[6]      # the walls stand askew
        fan = sample["fan"].astype(float)
        self.assertEqual(sensor.fan_shape(fan.shape[1])[0], fan.shape[0])
        ours = 255 * np.sqrt(sensor.to_fan(sample["polar"], fan.shape[1]).clip(0, 1))
        same, mirrored, flipped = (np.corrcoef(fan.ravel(), one.ravel())[0, 1] for one in (ours, ours[:, ::-1], ours[::-1]))
        self.assertGreater(same, max(0.8, mirrored + 0.05, flipped + 0.3))

    def test_the_command(self):
        # A locale of ASCII alone reads UTF-8 wrongly, as that of Windows or Latin-1 does.
        ascii_only = {"LC_ALL": "C", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0", "PYTHONIOENCODING": "utf-8"}
        result = self.run_program(sys.executable, "-B", PACKAGES / "sonarsim/data.py", self.out, encoding="utf-8",
                                  env={**os.environ, **ascii_only})
        for words in ("mbes: profiling, 4 pings", "instances: 1 W\u00e4nde"):
            self.assertIn(words, result.stdout)

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
        image = (self.out / "fls/image/000000.png").read_bytes()
        polar = (self.out / "fls/polar/000000.npy").read_bytes()
        for read, data in ((sonarsim_data.read_png, image[:16] + (1 << 30).to_bytes(4, "big") + image[20:]),
                           (sonarsim_data.read_png, image[:40]), (sonarsim_data.read_png, image[:-200]),
                           (sonarsim_data.read_png, b"no PNG at all"),
                           (sonarsim_data.read_npy, polar.replace(b"(40, 24)", b"(99, 99)")),
                           (sonarsim_data.read_npy, polar[:-1]), (sonarsim_data.read_npy, polar[:20])):
            with self.assertRaises(ValueError):
                read(data)


if __name__ == "__main__":
    unittest.main()
