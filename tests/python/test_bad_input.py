"""Every tool of the package with bad input ends with one sentence, and leaves nothing half."""
import json
import shutil
import unittest

import numpy as np
import tool
import test_export
from gallery_dataset import write_dataset

RECORDING = ("kind: imaging\nfiles: pings.npy\nlaw: {kind: gamma, full_value: 255}\nsound_speed_m_s: 1500\nfirst_range_m: 1\n"
             "range_step_m: 0.01\nbearing_first_deg: -30\nbearing_last_deg: 30\n")
# The words of a tool that reads IN and writes below OUT, and the packages that it needs.
TOOLS = {"export": (("IN", "--format", "yolo", "OUT/e"), "numpy PIL"), "gallery": (("IN",), "numpy"),
         "compare": (("IN", "IN", "--out", "OUT/c"), "numpy scipy yaml PIL"),
         "calibrate": (("IN", "--preset", "gemini_720is", "--out", "OUT/mine.yaml"), "numpy scipy yaml PIL")}
FULL_DISK = ("import resource, signal; resource.setrlimit(resource.RLIMIT_FSIZE, (600, 600)); "
             "signal.signal(signal.SIGXFSZ, signal.SIG_IGN)")


class BadInput(tool.ToolTest):
    def setUp(self):
        super().setUp()
        self.source, self.out = self.folder / "in", self.folder / "out"
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
            shutil.rmtree(self.source)
        self.source.mkdir()
        speckle = np.random.default_rng(1).rayleigh(40.0, (4, 240, 96))
        np.save(self.source / "pings.npy", np.minimum(np.sqrt(255.0 * speckle), 255.0).astype(np.uint8))
        (self.source / "recording.yaml").write_text(RECORDING)
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


if __name__ == "__main__":
    unittest.main()
