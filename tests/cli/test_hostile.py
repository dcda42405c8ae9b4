"""Datasets that somebody else made, to do harm: each attack is refused, and nothing outside changes."""
import hashlib
import json
import os
import resource
import shutil
import struct
import subprocess
import unittest

from sandbox import SONARSIM, Sandbox, digest, path_csv, png_file

COMMANDS = (("verify", "out"), ("status", "out"), ("merge", "out", "merged"))


class Hostile(Sandbox):
    def setUp(self):
        super().setUp()
        self.write("path.csv", path_csv(2))
        self.assert_renders()
        self.sound = self.dataset()

    def change(self, *keys, to, name="out"):
        """Sets a value of dataset.json, or of another one."""
        description = json.loads(json.dumps(self.sound))
        inner = description
        for key in keys[:-1]:
            inner = inner[key]
        inner[keys[-1]] = to
        self.write(f"{name}/dataset.json", json.dumps(description))
        # Whoever changes a file can give its sum.
        sums = self.folder / name / "SHA256SUMS"
        own = hashlib.sha256((self.folder / name / "dataset.json").read_bytes()).hexdigest()
        sums.write_text("".join(f"{own}  dataset.json\n" if line.endswith("  dataset.json\n") else line
                                for line in sums.read_text().splitlines(keepends=True)))

    def assert_all_refuse(self, *fragments):
        for command in COMMANDS:
            with self.subTest(command=command, fragments=fragments):
                result = self.run_sonarsim(*command)
                self.assert_refused(result, "out/dataset.json", *fragments)
                self.assertNotIn("json.exception", result.stderr)
                self.assertFalse((self.folder / "merged").exists())

    def test_keys_of_the_wrong_kind(self):
        for keys, value, words in (
                (("complete",), "yes", "type must be boolean"),
                (("poses",), 10 ** 9, "more than ten million poses"),
                (("sensors",), 5, "is damaged"),
                (("sensors", 0, "pings"), 1 << 60, "another number of pings of 'fls'"),
                (("sensors", 0, "name"), "../fls", "'../fls', which is not the name of a folder"),
                (("sensors", 0, "files", "meta"), "fls/../secret/%06d.json", "not the path of a file in 'fls/'"),
                (("sensors", 0, "files", "meta"), "/etc/%06d.json", "not the path of a file in 'fls/'"),
                (("sensors", 0, "files", "image"), "http://a.example/%06d.png", "not the path of a file"),
                (("products",), ["../../x"], "not the path of a file in 'seabed/'")):
            self.change(*keys, to=value)
            self.assert_all_refuse(words)
        self.write("out/dataset.json", "[" * 200000)
        for command in COMMANDS:
            self.assert_refused(self.run_sonarsim(*command), "not sonarsim's, or damaged")

    def test_variants(self):
        for text in ('{"format": "sonarsim variants", "variants": 5}',
                     '{"format": "sonarsim variants"}', "[]", "{", "[" * 200000):
            self.write("drawn/variants.json", text)
            for command in (("verify", "drawn"), ("status", "drawn"), ("merge", "drawn", "merged")):
                self.assert_refused(self.run_sonarsim(*command), "drawn/variants.json")

    def test_names_of_shards(self):
        """The name of a part of the journal tells how many shards there are."""
        self.change("complete", to=False)
        for name in ("1-of-0.txt", "0-of-0.txt", "2-of-1.txt", "1-of-4294967296.txt", "1-of-2000000000.txt"):
            self.write(f"out/journal.d/{name}", "")
        result = self.run_sonarsim("status", "out", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(json.loads(result.stdout)["state"], "interrupted")

    def test_files_that_tell_more_than_they_hold(self):
        """verify says so, and takes no memory for it."""
        def limit():
            if os.environ["SANITIZED"] != "1":  # a sanitizer reserves more memory than that
                resource.setrlimit(resource.RLIMIT_AS, (1 << 31, 1 << 31))
        sums = (self.out / "SHA256SUMS").read_text()
        for name, data in (("fls/image/000000.png", png_file(1 << 30, 1, b"\0")),
                           ("fls/image/000000.png", png_file(1 << 20, 1 << 20, b"\0")),
                           ("fls/polar/000000.npy", npy((1 << 32, 1 << 32)))):
            with self.subTest(name=name):
                path = self.out / name
                whole = path.read_bytes()
                path.write_bytes(data)
                sanitized = os.environ.get("SANITIZED") == "1"
                done = subprocess.run([SONARSIM, "verify", "out", "-j1"], cwd=self.folder, check=False,
                                      capture_output=True, text=True, timeout=60,
                                      preexec_fn=None if sanitized else limit)
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn(f"{name}: its bytes differ from SHA256SUMS; remove it", done.stderr)
                path.write_bytes(whole)
        self.assertEqual((self.out / "SHA256SUMS").read_text(), sums)

    def test_variants_behind_a_link(self):
        self.write("victim/dataset.json", json.dumps(self.sound))
        mission = (self.folder / "mission.yaml").read_text()
        self.write("drawn.yaml", mission.replace("folder: out", "folder: drawn") +
                   "variants: 2\n")
        first = self.run_sonarsim("render", "drawn.yaml")
        self.assertEqual(first.returncode, 0, first.stderr)
        shutil.rmtree(self.folder / "drawn/variant_0000")
        (self.folder / "drawn/variant_0000").symlink_to(self.folder / "victim")
        result = self.run_sonarsim("render", "drawn.yaml", "--overwrite")
        self.assert_refused(result, "variant_0000", "is a symbolic link")
        self.assertTrue((self.folder / "victim/dataset.json").exists())


def npy(shape):
    text = f"{{'descr': '<f4', 'fortran_order': False, 'shape': {shape}, }}"
    text += " " * (-(10 + len(text) + 1) % 64) + "\n"
    return b"\x93NUMPY\x01\x00" + struct.pack("<H", len(text)) + text.encode()


if __name__ == "__main__":
    unittest.main()
