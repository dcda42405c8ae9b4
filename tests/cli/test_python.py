"""The Python package: the pings of a mission in memory are those of the files of `render`."""
import ast
import concurrent.futures
import gc
import importlib
import inspect
import multiprocessing
import os
import pathlib
import sys
import time
import types
import unittest
import unittest.mock

PACKAGE = os.environ.get("SONARSIM_PYTHON_PACKAGE")
if not PACKAGE:
    print("needs a build with pybind11 and Python's headers")
    sys.exit(77)
sys.path.insert(0, PACKAGE)
from sandbox import ALL_FILES, MISSION, VARIED, Sandbox, path_csv, run_with

run_with("numpy")
import numpy as np
import sonarsim
import sonarsim.data

KINDS = ALL_FILES.replace("output: {folder: out, image: true}", """\
  oculus: {preset: sensors/oculus_m1200d_2100khz_10m.yaml, range_max_m: 6, range_bins: 64}
  head: {kind: scanning, range_max_m: 6, range_bins: 16, every: 2}
  towed: {kind: sidescan, model: calibrated, range_max_m: 6, range_bins: 64}
output: {folder: out, labels: true}""")
POSES = 5
# The files of a ping that are pictures for people, or products of several pings.
PICTURES = {"image", "fan", "stages", "meta", "soundings"}
IMAGES = {"polar", "waterfall", "echogram", "scan"}


def content_of(ping):
    """What a ping holds, for comparisons."""
    arrays = {"image": ping.image, "raw": ping.raw, **ping.labels}
    return (ping.sensor, ping.number, ping.variant, ping.metadata,
            {name: value.tobytes() if isinstance(value, np.ndarray) else value for name, value in arrays.items()})


class Package(Sandbox):
    def open(self, set=None, **options):
        return sonarsim.open(self.folder / "mission.yaml", set, **options)

    def assert_same(self, mission, folder):
        """Every ping has the numbers of its files, and nothing is missing."""
        dataset = sonarsim.data.open_dataset(folder)
        self.assertEqual(list(mission.sensors), list(dataset.sensors))
        np.testing.assert_allclose(mission.poses, dataset.poses(), atol=1e-6)
        for kind in ("instances", "classes", "materials"):
            self.assertEqual(getattr(mission, kind), getattr(dataset, kind))
        seen = set()
        for name, sensor in dataset.sensors.items():
            self.assertEqual(mission.sensors[name].pings, sensor.pings)
            np.testing.assert_array_equal(mission.sensors[name].range_edges_m, sensor.range_edges_m)
            for sample in sensor:
                with self.subTest(sample=sample):
                    self.assert_same_ping(mission.ping(sample.ping, name), sample)
                seen.update(sample)
        return seen

    def assert_same_ping(self, ping, sample):
        arrays = {**ping.labels, **({} if ping.raw is None else {"raw": ping.raw})}
        arrays.update({name: ping.image for name in IMAGES & set(sample)})
        self.assertEqual(set(arrays), set(sample) - PICTURES)
        for name, value in arrays.items():
            expected = sample[name]
            if isinstance(value, np.ndarray):
                self.assertEqual((value.dtype, value.shape), (expected.dtype, expected.shape), name)
                value, expected = value.tobytes(), np.ascontiguousarray(expected).tobytes()
            self.assertEqual(value, expected, name)
        self.assertEqual(ping.metadata, sample["meta"])


class SameBytes(Package):
    def test_a_scene_that_libassimp_reads(self):
        """Its module lies by the package and not by the interpreter."""
        self.write("slab.obj", "v -9 -9 3\nv 9 -9 3\nv 0 9 3\nusemtl Concrete\nf 1 2 3\n")
        self.assert_renders("--set", "scene.file=slab.obj")
        self.assert_same(self.open({"scene.file": "slab.obj"}), self.out)

    def test_all_kinds_and_labels(self):
        self.write("mission.yaml", KINDS)
        self.write("path.csv", path_csv(POSES))
        self.assert_renders()
        mission = self.open()
        seen = self.assert_same(mission, self.out)
        self.assertLessEqual({"polar", "raw", "waterfall", "echogram", "scan", "instance", "share",
                              "elevation", "clean", "shadow", "objects", "fan_instance"}, seen)
        self.assertEqual(len(mission), 6 * POSES + 3)
        pings = list(mission)
        self.assertEqual([p.sensor for p in pings[:4]], ["fls", "mbes", "sss", "sounder"])
        self.assertEqual(len(pings), len(mission))
        # Another order, more threads and shards change nothing.
        parts = [list(mission.pings(threads=2, shard=(k, 2))) for k in range(2)]
        self.assertEqual(len(parts[0]) + len(parts[1]), len(pings))
        merged = sorted(parts[0] + parts[1], key=lambda p: (p.number, mission.sensor_names.index(p.sensor)))
        self.assertEqual([content_of(p) for p in merged], [content_of(p) for p in pings])

    def test_variants(self):
        self.add("  labels: [instance, shadow]\n" + VARIED)
        self.assert_renders()
        mission = self.open()
        self.assertEqual((len(mission.variants), len(mission)), (3, 18))
        for variant, dataset in zip(mission.variants, sonarsim.data.open_datasets(self.out), strict=True):
            self.assert_same(variant, dataset.folder)
        pings = [content_of(p) for p in mission]
        self.assertEqual([p[2] for p in pings], [0] * 6 + [1] * 6 + [2] * 6)
        # Parts of variants; whole ones are in Torch.
        shards = [list(mission.pings("fls", shard=(k, 5))) for k in range(5)]
        self.assertEqual([len(one) for one in shards], [mission.count("fls", shard=(k, 5)) for k in range(5)])
        merged = sorted((p for one in shards for p in one), key=lambda p: (p.variant, p.number))
        self.assertEqual([content_of(p) for p in merged], pings)
        with self.assertRaisesRegex(ValueError, r"has 3 variants: ask one of them.*variants\[0\]"):
            mission.ping(0)

    def test_a_dict_and_overrides(self):
        self.assert_renders("--set", "seed=9", "--set", "sensors.fls.range_bins=40", "--set", "sensors.fls.noise={add_sigma: 0.2}")
        changes = {"seed": 9, "sensors.fls.range_bins": np.int64(40), "sensors.fls.noise": {"add_sigma": 0.2}}
        self.assert_same(self.open(changes), self.out)
        written = {"name": "box", "seed": 9, "scene": {"file": pathlib.Path("box.gltf"), "materials": "materials.csv"},
            "trajectory": {"file": "path.csv"},
            "sensors": {"fls": {"kind": "imaging", "azimuth_deg": 60, "elevation_deg": 12, "range_max_m": 6,
                                "range_bins": 40, "azimuth_bins": 32, "noise": {"add_sigma": 0.2}}}}
        self.assert_same(sonarsim.open(written, paths_from=self.folder), self.out)


class Use(Package):
    def test_mistakes_have_the_words_of_the_command(self):
        def said(*settings):
            with self.assertRaises(sonarsim.InputError) as caught:
                self.open(dict(setting.split("=", 1) for setting in settings))
            result = self.render(*(word for setting in settings for word in ("--set", setting)), code=2)
            self.assertEqual([f"error: {line}" for line in str(caught.exception).replace(f"{self.folder}/", "").splitlines()],
                             result.stderr.replace(f"{self.folder}/", "").splitlines())
            return str(caught.exception)

        said("sensors.fls.rang_bins=5", "seed=-1")
        said("trajectory.file=nowhere.csv")
        self.edit("mission.yaml", "azimuth_bins: 32", "azimuth_bims: 32")
        self.assertIn("mission.yaml:15:5:", said())
        self.assertTrue(issubclass(sonarsim.InputError, ValueError))
        for mission, fault, words in ((self.folder / "nowhere.yaml", sonarsim.InputError, "nowhere.yaml"),
                                      ({"name": object()}, TypeError, "cannot hold"),
                                      ({"sensors": {"fls": {"kind": "imaging", "range_bins": "many"}}},
                                       sonarsim.InputError, "mission: 'range_bins' must")):
            with self.assertRaisesRegex(fault, words):
                sonarsim.open(mission)
        self.assertFalse(self.out.exists())

    def test_half_of_a_letter(self):
        for mission, set in (({"name": "\ud800"}, None), (self.folder / "mission.yaml", {"name": "a\udfff"}),
                             (self.folder / "mission\ud800.yaml", None), (self.folder / "mission.yaml", {"\ud800": 1})):
            with self.assertRaisesRegex(sonarsim.InputError, r"one half of a letter"):
                sonarsim.open(mission, set)

    def test_a_fork_does_not_wait_for_threads_that_it_has_not(self):
        pings = self.open().pings(threads=2)
        next(pings)

        def forked():
            try:
                next(pings)
            except RuntimeError as fault:
                os._exit(7 if "forked" in str(fault) and len(list(self.open().pings(threads=2))) == 6 else 8)
            os._exit(9)

        child = multiprocessing.get_context("fork").Process(target=forked)
        child.start()
        child.join(60)
        child.kill()
        self.assertEqual(child.exitcode, 7, "None: it hung")
        self.assertEqual(len(list(pings)), 5)     # the parent goes on

    def test_wrong_numbers_and_names(self):
        mission = self.open({"sensors.fls.every": 2, "sensors.other": {"kind": "echosounder"}})
        with self.assertRaisesRegex(ValueError, "sensors fls, other: name one"):
            mission.ping(0)
        with self.assertRaisesRegex(KeyError, "'flz', but fls, other"):
            mission.ping(0, "flz")
        for number in (-1, 1, 6):
            with self.assertRaisesRegex(IndexError, "multiple of 2 from 0 to 5"):
                mission.ping(number, "fls")
        with self.assertRaisesRegex(ValueError, "shard"):
            mission.pings(shard=(2, 2))

    def test_other_threads_run_meanwhile(self):
        """A ping of several tenths of a second; this thread counts its turns meanwhile, of which a ping that held the lock
        would leave none."""
        mission = self.open({"sensors.fls.range_bins": 3000, "sensors.fls.azimuth_bins": 1500,
                             "sensors.fls.multipath": {"method": "exact"}})
        turns, began = 0, time.monotonic()
        with concurrent.futures.ThreadPoolExecutor(1) as pool:
            ping = pool.submit(mission.ping, 0)
            while not ping.done():
                time.sleep(0.001)
                turns += 1
        # Of some 900 turns a second a busy machine may take most.
        self.assertGreater(turns, max(3, 20 * (time.monotonic() - began)))

    def test_memory_does_not_grow(self):
        mission = self.open({"output.labels": "[instance, class, objects, clean]"})
        pings = [mission.ping(k) for k in range(6)]

        def work(times):
            for k in range(times):
                self.assertEqual(content_of(mission.ping(k % 6)), content_of(pings[k % 6]))
            gc.collect()
            return int(pathlib.Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE")

        before = work(100)
        # A ping takes some 40 kB; 400 of them 16 MB.
        self.assertLess(work(400) - before, 2 << 20)

    def test_arrays_are_their_own(self):
        mission = self.open({"output.labels": "[class]"})
        ping = mission.ping(0)
        before = content_of(ping)
        ping.image[:] = ping.pose[:] = -1
        ping.labels["class"][:] = 7
        again = mission.ping(0)
        del mission
        gc.collect()
        self.assertEqual(content_of(again), before)
        self.assertNotEqual(again.pose[0], -1)

    def test_the_stubs_are_those_of_the_code(self):
        """Every name of a stub is in the module, and functions have the parameters of the stub."""
        def compare(body, owner):
            for node in body:
                if isinstance(node, ast.ClassDef):
                    compare(node.body, getattr(owner, node.name))
                elif isinstance(node, ast.FunctionDef):
                    found = inspect.getattr_static(owner, node.name)
                    if inspect.isfunction(found):
                        self.assertEqual(list(inspect.signature(found).parameters), [one.arg for one in node.args.args], node.name)

        for module in (sonarsim.data, sonarsim._sonarsim):
            stub = pathlib.Path(sonarsim.__file__).parent / (module.__name__.split(".")[1] + ".pyi")
            compare(ast.parse(stub.read_text()).body, module)


class Torch(Package):
    def module(self, torch_like):
        """sonarsim.torch with what stands in for torch."""
        self.enterContext(unittest.mock.patch.dict(sys.modules, {"torch": torch_like}))
        sys.modules.pop("sonarsim.torch", None)
        return importlib.import_module("sonarsim.torch")

    def test_without_torch(self):
        with self.assertRaisesRegex(ImportError, "needs PyTorch.*python3-torch"):
            self.module(None)

    def test_workers_share_a_shard(self):
        """Every number of workers makes the pings of the shard, each once. Objects are text, whose number in a batch is
        free."""
        tools = types.SimpleNamespace(IterableDataset=object, get_worker_info=None)
        module = self.module(types.SimpleNamespace(utils=types.SimpleNamespace(data=tools)))
        for variants, shard, expected in ((VARIED, (0, 2), [(v, k) for v in (0, 2) for k in range(6)]),
                (VARIED, (1, 4), [(v, k) for v in range(3) for k in (1, 5)]), ("", (1, 2), [(None, k) for k in (1, 3, 5)])):
            self.write("mission.yaml", MISSION + variants)
            data = module.PingDataset(self.folder / "mission.yaml", shard=shard, transform=lambda ping: (ping.variant, ping.number))
            self.assertEqual(len(data), len(expected))
            for workers in range(5):
                found = []
                for worker in range(max(1, workers)):
                    info = types.SimpleNamespace(id=worker, num_workers=workers) if workers else None
                    tools.get_worker_info = lambda info=info: info
                    found += data
                self.assertEqual(sorted(found), expected, (variants, shard, workers))
        objects = {"ping": 3, "objects": []}
        text = module.tensor_of(types.SimpleNamespace(image=None, raw=None, sensor="fls", labels={"objects": objects}), "objects")
        self.assertEqual(text, '{"ping": 3, "objects": []}')
