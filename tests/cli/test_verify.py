"""sonarsim verify: what is wrong with a dataset, a line for each fault; and SHA256SUMS, which needs no
sonarsim to be checked."""
import json
import os
import random
import shutil
import subprocess
import unittest

from sandbox import SONARSIM, Sandbox, digest, path_csv
from test_faults import MISSION


class Verify(Sandbox):
    def setUp(self):
        super().setUp()
        self.write("mission.yaml", MISSION)
        self.write("path.csv", path_csv(3))
        self.assert_renders()

    def verify(self, *arguments):
        return self.run_sonarsim("verify", "out", *arguments)

    def assert_fault(self, *fragments, count=1):
        """So many lines of errors, exit code 1, nothing changed; what the message says."""
        before = digest(self.out)
        result = self.verify()
        self.assertEqual(result.returncode, 1, result.stderr)
        errors = [line for line in result.stderr.splitlines() if line.startswith("error:")]
        self.assertEqual(len(errors), count, result.stderr)
        for fragment in fragments:
            self.assertIn(fragment, result.stderr)
        self.assertEqual(digest(self.out), before)

    def resum(self, name):
        """Writes the sum of a changed file into SHA256SUMS."""
        sums = (self.out / "SHA256SUMS").read_text().splitlines()
        new = digest(self.out)[name]
        self.write("out/SHA256SUMS", "".join(
            (f"{new}  {name}" if line.endswith(f"  {name}") else line) + "\n" for line in sums))

    def test_whole(self):
        result = self.verify()
        self.assertEqual((result.returncode, result.stdout), (0, ""), result.stderr)
        self.assertIn("whole", result.stderr)
        listed = {line[66:]: line[:64] for line in (self.out / "SHA256SUMS").read_text().splitlines()}
        self.assertEqual(listed, digest(self.out, without=("SHA256SUMS",)))
        verdict = json.loads(self.verify("--json").stdout)
        self.assertEqual(verdict["whole"], True)
        self.assertEqual(verdict["files"], len(listed))
        self.assertEqual((verdict["errors"], verdict["unknown_files"]), ([], []))
        self.assertEqual(self.verify("--quiet", "-j1").stderr, "")

    def test_coreutils_take_the_sums(self):
        check = ["sha256sum", "--check", "--strict", "--quiet", "SHA256SUMS"]
        self.assertEqual(subprocess.run(check, cwd=self.out, check=False).returncode, 0)
        self.write("out/fls/meta/000001.json", "{}")
        result = subprocess.run(check, cwd=self.out, capture_output=True, check=False)
        self.assertEqual(result.returncode, 1)

    def test_a_flipped_bit_in_any_file(self):
        for path in sorted(p for p in self.out.rglob("*") if p.is_file()):
            name = str(path.relative_to(self.out))
            if name in ("SHA256SUMS", "dataset.json"):
                continue
            data = path.read_bytes()
            with self.subTest(name=name):
                path.write_bytes(data[:-1] + bytes([data[-1] ^ 1]))
                self.assert_fault(f"{name}: ", "SHA256SUMS", "remove it")
                path.write_bytes(data)
        self.assertEqual(self.verify().returncode, 0)

    def test_dataset_json_is_covered(self):
        whole = digest(self.out)
        self.edit("out/dataset.json", '"seed": 7', '"seed": 8')
        self.assert_fault("dataset.json: ", "remove SHA256SUMS")
        (self.out / "SHA256SUMS").unlink()
        self.assert_renders()
        self.assertEqual(digest(self.out), whole)

    def test_missing(self):
        (self.out / "fls/fan/000002.png").unlink()
        (self.out / "sss/waterfall.npy").unlink()
        self.assert_fault("fls/fan/000002.png: is missing", "sss/waterfall.npy: is missing", count=2)

    def test_the_cure_cures(self):
        whole = digest(self.out)
        for name in ("fls/fan/000002.png", "sss/waterfall.npy", "mbes/bathymetry.tif", "journal.txt",
                     "trajectory.tum", "SHA256SUMS"):
            with self.subTest(name=name):
                (self.out / name).unlink()
                self.assertEqual(self.verify().returncode, 1)
                self.assert_renders()
                self.assertEqual(digest(self.out), whole)

    def test_a_stranger_does_no_harm(self):
        self.write("out/notes.txt", "mine")
        self.write("out/fls/polar/000003.npy", "one too many")
        result = self.verify("--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(json.loads(result.stdout)["unknown_files"], ["fls/polar/000003.npy", "notes.txt"])
        self.assertIn("notes.txt", result.stderr)

    def test_unfinished(self):
        shutil.rmtree(self.out)
        self.assert_renders("--shard", "1/3")
        self.assertFalse((self.out / "SHA256SUMS").exists())
        result = self.verify()
        self.assertEqual(result.returncode, 1)
        self.assertIn("not complete", result.stderr)
        self.assertIn("is missing", result.stderr)

    def test_no_dataset(self):
        self.assert_refused(self.run_sonarsim("verify", "none"), "none", "there is no such folder")
        self.write("other/dataset.json", "{}")
        self.assert_refused(self.run_sonarsim("verify", "other"), "dataset.json", "not sonarsim's")
        self.edit("out/dataset.json", '"format_version": 3', '"format_version": 2')
        self.assert_refused(self.verify(), "format_version 2")

    def test_sums_that_are_none(self):
        good = (self.out / "SHA256SUMS").read_text()
        for line in ("nonsense", "0" * 64 + "  ../mission.yaml", "0" * 64 + "  /etc/passwd", "0" * 63):
            with self.subTest(line=line):
                self.write("out/SHA256SUMS", line + "\n" + good)
                self.assert_refused(self.verify(), "SHA256SUMS:1", "remove SHA256SUMS")

    def test_a_description_that_lies(self):
        reported = self.dataset()
        reported["poses"] = 1000
        for sensor in reported["sensors"]:
            sensor["pings"] = -(-reported["poses"] // sensor["every"])
        self.write("out/dataset.json", json.dumps(reported))
        result = self.verify()
        self.assertEqual(result.returncode, 1)
        self.assertIn("fls/polar/000999.npy: is missing", result.stderr)
        reported["sensors"][0]["pings"] = 10 ** 18
        self.write("out/dataset.json", json.dumps(reported))
        self.assert_refused(self.verify(), "dataset.json", "another number of pings of 'fls'")


class EveryFile(Sandbox):
    """Of whatever the program writes, in every layout: a byte that was flipped, an end that was cut off
    and a file that was removed are found."""

    def setUp(self):
        super().setUp()
        self.write("path.csv", path_csv(2))
        self.draw = random.Random(7)
        # The other two sonars write files of the same sorts.
        kept = [line for line in MISSION.splitlines() if not line.startswith(("  mbes", "  sounder"))]
        mission = "\n".join(kept) + "\n"
        labels = mission.replace("image: true", "image: true, labels: [instance, objects]")
        labels += "labels: {background: [none]}\n"
        self.write("mission.yaml", labels)
        self.write("variants.yaml", mission + "variants: 2\n"
                   "vary: [{key: water.sound_speed_m_s, uniform: [1470, 1490]}]\n")

    def done(self, *arguments):
        result = self.run_sonarsim(*arguments)
        self.assertEqual(result.returncode, 0, result.stderr)

    def check_every_file(self):
        self.done("verify", "out")
        # variants.json is a list, without a sum of its own.
        files = sorted(p for p in self.out.rglob("*") if p.is_file() and p.name != "variants.json")
        for path in files:
            data = path.read_bytes()
            place = self.draw.randrange(len(data))
            flipped = bytes([data[place] ^ self.draw.randrange(1, 256)])
            end = self.draw.choice((place, len(data) - 1))
            for what, spoilt in (("flipped", data[:place] + flipped + data[place + 1:]),
                                 ("cut", data[:end]), ("removed", None)):
                with self.subTest(file=path.relative_to(self.out), what=what, place=place):
                    path.unlink() if spoilt is None else path.write_bytes(spoilt)
                    result = self.run_sonarsim("verify", "out", "-j1")
                    path.write_bytes(data)
                    self.assertIn(result.returncode, (1, 2), result.stderr)
                    self.assertIn("error:", result.stderr)
        self.done("verify", "out")
        return len(files)

    def test_plain(self):
        self.done("render", "mission.yaml")
        self.assertGreater(self.check_every_file(), 20)

    def test_variants(self):
        self.done("render", "variants.yaml")
        self.assertGreater(self.check_every_file(), 30)

    def test_merged(self):
        for k in (1, 2):
            self.done("render", "mission.yaml", "--shard", f"{k}/2", "--out", f"part{k}")
        self.done("merge", "part1", "part2", "out")
        self.done("render", "mission.yaml")
        self.check_every_file()

    def test_a_variant_that_is_missing(self):
        self.done("render", "variants.yaml")
        shutil.rmtree(self.out / "variant_0001")
        self.write("out/variant_0000/notes.txt", "mine")
        result = self.run_sonarsim("verify", "out", "--json")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("variant_0001: is missing", result.stderr)
        self.assertEqual(json.loads(result.stdout)["unknown_files"], ["variant_0000/notes.txt"])


class AnotherPlace(Sandbox):
    """A dataset does not tell where it was made, and by whom."""

    def test_other_folders(self):
        self.assert_renders()
        here = digest(self.out)
        other = self.folder / "somewhere/else"
        other.mkdir(parents=True)
        for name in ("mission.yaml", "materials.csv", "box.gltf", "path.csv"):
            shutil.copy(self.folder / name, other)
        result = subprocess.run([SONARSIM, "render", other / "mission.yaml", "--out", other / "data/set"],
                                cwd="/", env=dict(os.environ, HOME="/nowhere", USER="nobody"),
                                capture_output=True, text=True, check=False)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(digest(other / "data/set"), here)
        for path in self.out.rglob("*"):
            if path.is_file():
                self.assertNotIn(str(self.folder).encode(), path.read_bytes(), path)

    def test_inputs_are_told(self):
        self.assert_renders()
        sums = digest(self.folder)
        for name in ("box.gltf", "materials.csv", "path.csv"):
            self.assertIn({"file": name, "sha256": sums[name]}, self.dataset()["inputs"])
            self.assertIn(f"{sums[name]}  {name}\n", (self.out / "mission.resolved.yaml").read_text())

    def test_resolved_mission_gives_the_same_dataset(self):
        self.assert_renders()
        resolved = ("render", "out/mission.resolved.yaml", "--out", self.folder / "again")
        self.assert_refused(self.run_sonarsim(*resolved), "--paths-from")
        result = self.run_sonarsim(*resolved, "--paths-from", ".")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(digest(self.folder / "again"), digest(self.out))


if __name__ == "__main__":
    unittest.main()
