"""Every tool of the package with bad input ends with one sentence, and leaves nothing half."""
import contextlib
import io
import json
import random
import re
import shutil
import types
import unittest
import unittest.mock

import numpy as np
import tool
import sonarsim.calibrate.command
import sonarsim.compare.comparison
import test_export
from gallery_dataset import write_dataset
from sonarsim import command

# The words of a tool that reads IN and writes below OUT, and the packages that it needs.
TOOLS = {"export": (("IN", "--format", "yolo", "OUT/e"), "numpy PIL"), "gallery": (("IN",), "numpy"),
         "compare": (("IN", "IN", "--out", "OUT/c"), "numpy scipy yaml PIL"),
         "calibrate": (("IN", "--preset", "gemini_720is", "--out", "OUT/mine.yaml"), "numpy scipy yaml PIL")}
FULL_DISK = ("import resource, signal; resource.setrlimit(resource.RLIMIT_FSIZE, (600, 600)); "
             "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)")


class BadInput(tool.ToolTest):
    def setUp(self):
        super().setUp()
        self.source = self.folder / "in"
        self.out.mkdir()

    def refused(self, name, text, code=2, setup=""):
        words = [word.replace("IN", str(self.source)).replace("OUT", str(self.out)) for word in TOOLS[name][0]]
        self.assert_refused(name, text, *words, code=code, setup=setup)

    def test_what_is_not_a_dataset(self):
        for name in TOOLS:
            self.refused(name, "in: is not a (dataset|recording)")
        self.source.mkdir()
        for text, words in ((None, "in: is not a (dataset|recording)"), ("[" * 100000, "dataset.json: "),
                            ('{"format": "sonarsim dataset", "format_version": 3}', "dataset.json: ")):
            if text is not None:
                (self.source / "dataset.json").write_text(text)
            for name in TOOLS:
                self.refused(name, words)

    def test_a_half_rendered_dataset(self):
        description = write_dataset(self.source)
        (self.source / "dataset.json").write_text(json.dumps(description | {"complete": False}))
        for name in TOOLS.keys() - {"gallery"}:     # whose page says so
            self.refused(name, "in: is not complete")

    def test_a_full_disk(self):
        for name, write in (("gallery", write_dataset), ("export", test_export.write_dataset)):
            write(self.source)
            self.refused(name, "File too large", 1, FULL_DISK)
            if name == "export":    # each format names the file that the disk does not take
                for kind, file in (("webdataset", "train-000000.tar"), ("coco", "train/.*png"), ("masks", "img_dir/.*png")):
                    self.assert_refused("export", f"e.part/{file}: File too large", self.source, "--format", kind,
                                        self.out / "e", code=1, setup=FULL_DISK)
            shutil.rmtree(self.source)
        self.source.mkdir()
        speckle = np.random.default_rng(1).rayleigh(40.0, (4, 240, 96))
        tool.write_recording(self.source, np.minimum(np.sqrt(255.0 * speckle), 255.0).astype(np.uint8),
                             {"kind": "gamma", "full_value": 255})
        for name in ("compare", "calibrate"):
            self.refused(name, "File too large", 1, FULL_DISK)
        scenario = self.folder / "scenario.json"
        scenario.write_text(json.dumps({"agents": [{"sensors": 9 * [{"sensor_type": "ImagingSonar"}]}]}))
        done = tool.run("import_holoocean", scenario, "--out", self.out / "m.yaml", setup=FULL_DISK)
        self.assertEqual((done.returncode, list(self.out.iterdir())), (1, []))
        self.assertRegex(done.stderr, "\nsonarsim import-holoocean: [^\n]*File too large\n$")

    def test_a_missing_package(self):
        for name, (_, packages) in TOOLS.items():
            for package in packages.split():
                hide = ("import importlib.util as u; find = u.find_spec; "
                        f"u.find_spec = lambda name, package=None: None if name == '{package}' else find(name, package)")
                self.refused(name, f"install python3-{package.lower()} ", setup=hide)

    def test_more_than_lies_on_disk(self):
        """Numbers of a dataset.json from elsewhere are refused within a second or so, and little memory."""
        limits = ("import resource; resource.setrlimit(resource.RLIMIT_AS, (3 << 30,) * 2); "
                  "resource.setrlimit(resource.RLIMIT_CPU, (20, 20))")
        out = self.source
        test_export.write_dataset(out)
        sound = {name: (out / name).read_text() for name in ("dataset.json", "sss/objects.json", "trajectory.tum")}
        wide = json.loads(sound["dataset.json"])
        wide["sensors"] = wide["sensors"][:1]
        wide["sensors"][0]["fan"] |= {"width_px": 40000, "height_px": 40000}
        raw = json.loads(json.dumps(wide))
        raw["sensors"][0]["files"]["raw"] = "fls/fan/%06d.png"
        for name, text, words, more in (
                ("dataset.json", sound["dataset.json"].replace('"poses": 60', '"poses": 4000000000'), "'poses' is 4000000000", ()),
                ("dataset.json", sound["dataset.json"].replace('"pings": 10', '"pings": 4000000000'), "more than poses", ()),
                ("dataset.json", sound["dataset.json"].replace('"every": 1', '"every": 4000000000'), "more than poses", ()),
                ("trajectory.tum", "", "'poses' is 60", ()),
                ("sss/objects.json", sound["sss/objects.json"].replace('"width": 24', '"width": 1000000000'), "too large", ()),
                ("dataset.json", json.dumps(wide), "is not 40000 x 40000 pixels", ()),
                ("dataset.json", json.dumps(raw), "too large a fan", ("--image", "raw"))):
            with tool.replaced(out / name, text), self.subTest(name=name, words=words):
                self.assertNotEqual(text, sound[name])
                self.assert_refused("export", words, out, "--format", "yolo", *more, self.folder / "e", setup=limits)
                if "pose" in words:
                    self.assert_refused("gallery", words, out, setup=limits)
                    self.assert_refused("compare", words, out, out, setup=limits)


class Mutations(tool.ToolTest):
    """Some values in the JSON of a dataset are others: each tool works, or says one sentence that is not Python's."""
    VALUES = (None, True, -1, 0, 4_000_000_000, 10**30, 1.5, float("inf"), float("nan"), "x", "\ud800", [], {}, [None], {"a": 1})
    PYTHON = re.compile("Error|Traceback|codec|NoneType|argument|literal|could not convert|hashable|subscript|<class|indices|"
                        "Warning|operand|shape mismatch|tuple|reshape|line [0-9]+$")

    def places(self, value):
        items = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
        for key, one in list(items):
            if key == 9 and isinstance(value, list):    # the rest of a long list is alike
                return
            yield value, key
            yield from self.places(one)

    def run_tools(self, source, names):
        from sonarsim.compare.__main__ import compare
        from sonarsim.export import __main__ as exporter
        from sonarsim.gallery.__main__ import write_page
        options = types.SimpleNamespace(real=source, simulated=[source], out=None, sensor="fls", real_sensor="fls", pings=2,
                                        json=False, quiet=True)
        for name, work in (("export", lambda: exporter.main([str(source), "--format", "coco", str(self.folder / "e")])),
                           ("gallery", lambda: command.run("gallery", write_page, source)),
                           ("compare", lambda: command.run("compare", compare, options))):
            if name not in names:
                continue
            said = io.StringIO()
            # In one process, which is quicker for two pictures and forks nothing.
            alone = unittest.mock.patch.object(exporter, "prepare_all", lambda pictures, numbers, options: (
                exporter.prepare(one, numbers[one.dataset], options) for one in pictures))
            with contextlib.redirect_stderr(said), contextlib.redirect_stdout(io.StringIO()), alone:
                code = work()
            with self.subTest(name, code=code):
                self.assertIn(code, (0, 2))
                self.assertRegex(said.getvalue(), r"\Asonarsim [^\n]*\n\Z" if code else r"\A\Z")
                self.assertNotRegex(said.getvalue(), self.PYTHON)
            shutil.rmtree(self.folder / "e", ignore_errors=True)

    def test_any_value(self):
        self.render_tank("in", "trajectory.rate_hz=1")
        source, draw = self.folder / "in", random.Random(3)
        names = ["dataset.json", *(str(path.relative_to(source)) for path in sorted(source.rglob("*/*.json")))]
        self.run_tools(source, TOOLS)
        for k in range(80):
            name = names[0] if draw.random() < 0.7 else draw.choice(names)
            content = json.loads((source / name).read_text())
            holder, key = draw.choice(list(self.places(content)))
            if isinstance(holder, dict) and draw.random() < 0.3:
                del holder[key]
            else:
                holder[key] = draw.choice(self.VALUES)
            with tool.replaced(source / name, json.dumps(content)), self.subTest(file=name, key=key):
                self.run_tools(source, TOOLS if k % 8 == 0 else ("export", "gallery"))
