"""sonarsim verify: what is wrong with a dataset, a line for each fault; SHA256SUMS, which needs no sonarsim to be
checked; and datasets that somebody else made, to do harm: each attack is refused."""
import hashlib
import json
import random
import re
import resource
import shutil
import time

from sandbox import ALL_FILES, SANITIZED, Rendered, digest, path_csv


class Verify(Rendered):
    FILES = {"mission.yaml": ALL_FILES, "path.csv": path_csv(3)}

    def test_whole(self):
        result = self.succeeds("verify", "out")
        self.assertEqual(result.stdout, "")
        self.assertIn("whole", result.stderr)
        listed = {line[66:]: line[:64] for line in (self.out / "SHA256SUMS").read_text().splitlines()}
        self.assertEqual(listed, digest(self.out, without=("SHA256SUMS",)))
        self.assertEqual(self.succeeds("verify", "out", "--quiet", "-j1").stderr, "")
        self.run_program("sha256sum", "--check", "--strict", "--quiet", "SHA256SUMS", cwd=self.out)
        # A stranger does no harm.
        self.write("out/notes.txt", "mine")
        self.write("out/fls/polar/000003.npy", "one too many")
        verdict = self.reported("verify", "out")
        self.assertEqual((verdict["whole"], verdict["files"], verdict["errors"]), (True, len(listed), []))
        self.assertEqual(verdict["unknown_files"], ["fls/polar/000003.npy", "notes.txt"])

    def test_the_cure_cures(self):
        whole = digest(self.out)
        names = ("fls/fan/000002.png", "sss/waterfall.npy", "mbes/bathymetry.tif", "journal.txt", "trajectory.tum")
        for name in (*names, "SHA256SUMS"):
            with self.subTest(name=name):
                (self.out / name).unlink()
                self.assert_verify_finds(name)
                self.assert_renders()
                self.assertEqual(digest(self.out), whole)
        # Every fault has a line, and nothing changes; the description of the dataset has a sum as well.
        for name in names[:3]:
            (self.out / name).unlink()
        self.edit("out/dataset.json", '"seed": 7', '"seed": 8')
        before = digest(self.out)
        result = self.assert_verify_finds("dataset.json: ", "remove SHA256SUMS", *(f"{name}: is missing" for name in names[:3]))
        self.assertEqual((result.stderr.count("error:"), digest(self.out)), (4, before))
        (self.out / "SHA256SUMS").unlink()
        self.assert_renders()
        self.assertEqual(digest(self.out), whole)

    def test_unfinished(self):
        shutil.rmtree(self.out)
        self.assert_renders("--shard", "1/3")
        self.assertFalse((self.out / "SHA256SUMS").exists())
        self.assert_verify_finds("not complete", "is missing")

    def test_no_dataset(self):
        self.write("other/dataset.json", "{}")
        for folder, *words in (("none", "none", "there is no such folder"), ("out/fls", "give the folder above"),
                               ("other", "dataset.json", "not sonarsim's")):
            self.assert_refused(self.run_sonarsim("verify", folder), *words)
        good = (self.out / "SHA256SUMS").read_text()
        for line in ("nonsense", "0" * 64 + "  ../mission.yaml", "0" * 64 + "  /etc/passwd", "0" * 63):
            with self.subTest(line=line):
                self.write("out/SHA256SUMS", line + "\n" + good)
                self.assert_refused(self.run_sonarsim("verify", "out"), "SHA256SUMS:1", "remove SHA256SUMS")
        self.edit("out/dataset.json", '"format_version": 3', '"format_version": 2')
        self.assert_refused(self.run_sonarsim("verify", "out"), "format_version 2")

    def test_a_byte_of_any_file(self):
        """A byte that was flipped, an end that was cut off and a file that was removed are found, in every kind of
        file."""
        self.write("path.csv", path_csv(1))
        self.edit("mission.yaml", "image: true", "image: true, labels: [instance, objects]")
        self.assert_renders("--overwrite")
        draw = random.Random(7)
        files = sorted(p for p in self.out.rglob("*") if p.is_file())
        self.assertGreater(len(files), 30)
        for path in files:
            data = path.read_bytes()
            place = draw.randrange(len(data))
            flipped = bytes([data[place] ^ draw.randrange(1, 256)])
            for what, spoilt in (("flipped", data[:place] + flipped + data[place + 1:]),
                                 ("cut", data[:draw.choice((place, len(data) - 1))]), ("removed", None)):
                with self.subTest(file=path.relative_to(self.out), what=what, place=place):
                    path.unlink() if spoilt is None else path.write_bytes(spoilt)
                    result = self.run_sonarsim("verify", "out", "-j1")
                    path.write_bytes(data)
                    self.assertIn(result.returncode, (1, 2), result.stderr)
                    self.assertIn("error:", result.stderr)
        self.succeeds("verify", "out")

    def test_variants(self):
        self.add("variants: 2\nvary: [{key: water.sound_speed_m_s, uniform: [1470, 1490]}]\n")
        shutil.rmtree(self.out)
        self.assert_renders()
        self.succeeds("verify", "out")
        self.write("out/variant_0000/fls/polar/000000.npy", "spoilt")
        shutil.rmtree(self.out / "variant_0001")
        self.write("out/variant_0000/notes.txt", "mine")
        result = self.assert_verify_finds("variant_0001: is missing", "fls/polar/000000.npy: its bytes differ", more=("--json",))
        self.assertEqual(json.loads(result.stdout)["unknown_files"], ["variant_0000/notes.txt"])


class Hostile(Rendered):
    FILES = {"path.csv": path_csv(2)}

    def describe(self, text):
        """Writes dataset.json. Whoever changes a file can give its sum."""
        self.write("out/dataset.json", text)
        own = hashlib.sha256(text.encode()).hexdigest()
        sums = (self.out / "SHA256SUMS").read_text()
        self.write("out/SHA256SUMS", re.sub(r"(?m)^\w+(?=  dataset.json$)", own, sums))

    def test_descriptions(self):
        sound = json.dumps(self.dataset())
        for right, wrong, words in (('"complete": true', '"complete": "yes"', "type must be boolean"),
                ('"poses": 2', '"poses": 4000000000', "more than ten million poses"),
                ('"pings": 2', f'"pings": {1 << 60}', "another number of pings of 'fls'"),
                ('"name": "fls"', '"name": "../fls"', "'../fls', which is not the name of a folder"),
                ("fls/meta/%06d", "fls/../secret/%06d", "not the path of a file in 'fls/'"),
                ("fls/meta/%06d", "/etc/%06d", "not the path of a file in 'fls/'"),
                ('"poses": 2', '"poses": 2, "products": ["../../x"]', "not the path of a file in 'seabed/'"),
                (sound, "[" * 200000, "not sonarsim's, or damaged")):
            self.assertIn(right, sound)
            self.describe(sound.replace(right, wrong, 1))
            self.assert_all_refuse("out/dataset.json", words)
        (self.out / "dataset.json").unlink()
        for text in ('{"format": "sonarsim variants", "variants": 5}', "[]", "[" * 200000):
            self.write("out/variants.json", text)
            self.assert_all_refuse("out/variants.json")

    def assert_all_refuse(self, *words):
        for command in (("verify", "out"), ("status", "out"), ("merge", "out", "merged")):
            with self.subTest(command=command, words=words):
                result = self.run_sonarsim(*command)
                self.assert_refused(result, *words)
                self.assertNotIn("json.exception", result.stderr)
                self.assertFalse((self.folder / "merged").exists())

    def test_more_files_than_there_are(self):
        """Ten million pings would be a list of gigabytes."""
        sound = json.dumps(self.dataset())
        self.describe(sound.replace('"poses": 2', '"poses": 10000000').replace('"pings": 2', '"pings": 10000000'))
        limit = (1 << 30, 1 << 30)
        for command in (("verify", "out"), ("merge", "out", "merged")):
            start = time.monotonic()
            result = self.run_sonarsim(*command, preexec_fn=None if SANITIZED else lambda: resource.setrlimit(
                resource.RLIMIT_AS, limit))
            self.assert_refused(result, "out/dataset.json: lists more files than SHA256SUMS")
            self.assertLess(time.monotonic() - start, 10)   # without a bound it is minutes

    def test_names_of_shards(self):
        """The name of a part of the journal has the number of shards."""
        self.describe(json.dumps(self.dataset() | {"complete": False}))
        for name in ("1-of-0.txt", "2-of-1.txt", "1-of-4294967296.txt", "1-of-2000000000.txt"):
            self.write(f"out/journal.d/{name}", "")
        self.assertEqual(self.reported("status", "out")["state"], "incomplete")
