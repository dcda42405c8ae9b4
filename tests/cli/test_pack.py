"""output.pack: the files of pings in tar archives of a given size. They hold what loose files do, have
the same bytes whoever writes them in whatever order, and survive what loose files survive."""
import hashlib
import itertools
import json
import os
import pathlib
import shutil
import signal
import tarfile
import unittest

from sandbox import Sandbox, digest, path_csv
from test_faults import FAULTY_DISK, MISSION

POSES = 20
PACKED = MISSION.replace("fan_width_px: 32}",
                         "fan_width_px: 32, pack: tar, pack_size_mb: 0.2, labels: true}")


class Pack(Sandbox):
    def setUp(self):
        super().setUp()
        self.write("mission.yaml", PACKED)
        self.write("path.csv", path_csv(POSES))

    def packs(self, folder=None):
        return sorted((folder or self.out).rglob("*.tar"))

    def whole(self):
        self.assert_renders()
        whole = digest(self.out)
        shutil.rmtree(self.out)
        return whole

    def test_packs_hold_what_loose_files_do(self):
        self.assert_renders()
        self.assert_renders("--set", "output.pack=none", "--out", "loose")
        packed = {}
        for path in self.packs():
            self.assertLessEqual(path.stat().st_size, 100_000)
            with tarfile.open(path) as archive:
                for member in archive:
                    # fls-000003.polar.npy is fls/polar/000003.npy.
                    stem, kind, extension = member.name.split(".")
                    sensor, number = stem.rsplit("-", 1)
                    packed[f"{sensor}/{kind}/{number}.{extension}"] = hashlib.sha256(
                        archive.extractfile(member).read()).hexdigest()
                    self.assertEqual((member.mtime, member.uid, member.gid, member.mode,
                                      member.uname), (0, 0, 0, 0o644, ""))
        loose = digest(self.folder / "loose")
        singles = {name: sum for name, sum in loose.items() if len(pathlib.Path(name).parts) == 3}
        self.assertEqual(packed, singles)
        for name in ("mbes/soundings.npy", "sss/waterfall.npy", "sss/instance.npy", "mbes/bathymetry.tif"):
            self.assertEqual(digest(self.out)[name], loose[name], name)
        # All that a ping has stands together, in the order of the pings.
        with tarfile.open(self.packs(self.out / "fls")[0]) as archive:
            stems = [name.split(".")[0] for name in archive.getnames()]
        self.assertEqual([stem for stem, _ in itertools.groupby(stems)],
                         [f"fls-{k:06d}" for k in range(len(set(stems)))])

    def test_a_ping_is_found_without_looking(self):
        self.assert_renders()
        for sensor in self.dataset()["sensors"]:
            reported = sensor["packs"]
            for ping in range(POSES):
                pack = self.out / (reported["file"] % (ping // reported["pings"]))
                with tarfile.open(pack) as archive:
                    for member in reported["members"].values():
                        self.assertIn(member % ping, archive.getnames())
            self.assertEqual(sensor["files"], {})

    def test_same_bytes(self):
        whole = self.whole()
        self.assertGreater(sum(name.endswith(".tar") for name in whole), 8)
        self.assert_renders("-j2")
        self.assertEqual(digest(self.out), whole)
        shutil.rmtree(self.out)
        for k in (2, 3, 1):
            self.assert_renders("--shard", f"{k}/3", "-j1")
        self.assertEqual(digest(self.out), whole)
        for k in (1, 2, 3):
            self.assert_renders("--shard", f"{k}/3", "--out", f"part{k}")
        for order in itertools.permutations(("part1", "part2", "part3")):
            with self.subTest(order=order):
                result = self.run_sonarsim("merge", *order, "-".join(order))
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual(digest(self.folder / "-".join(order)), whole)

    def test_more_shards_than_packs(self):
        """A shard without a pack renders nothing and says so by the parts that are still missing."""
        self.edit("mission.yaml", "pack_size_mb: 0.2", "pack_size_mb: 1000")
        whole = self.whole()
        self.assertEqual(sum(name.endswith(".tar") for name in whole), 4)
        result = self.assert_renders("--shard", "2/2", "--json")
        self.assertEqual(json.loads(result.stdout)["pings"], 0)
        self.assert_renders("--shard", "1/2")
        self.assertEqual(digest(self.out), whole)

    def test_a_missing_part(self):
        for k in (1, 3):
            self.assert_renders("--shard", f"{k}/3", "--out", f"part{k}")
        self.assert_refused(self.run_sonarsim("merge", "part1", "part3", "all"), "--shard 2/3")
        self.assert_renders("--shard", "2/3", "--out", "part2")
        victim = self.packs(self.folder / "part2")[0]
        data = bytearray(victim.read_bytes())
        data[700] ^= 1
        victim.write_bytes(data)
        self.assert_refused(self.run_sonarsim("merge", "part1", "part2", "part3", "all"),
                            str(victim.relative_to(self.folder)), "copy the part again")

    def test_ten_kills(self):
        """Each run is killed before a call that writes: after 2.5 % of the calls of a whole run, after
        5 % ... 25 %. What all of them leave to do takes more calls than that."""
        whole = self.whole()
        log = self.folder / "calls"
        disk = dict(os.environ, LD_PRELOAD=FAULTY_DISK, FAULTY_DISK_BELOW=str(self.out),
                    FAULTY_DISK_LOG=str(log), FAULTY_DISK_MODE="kill")
        self.render("-j2", env=dict(disk, FAULTY_DISK_CALL="0"))
        shutil.rmtree(self.out)
        calls = len(log.read_text().splitlines())
        for fortieth in range(1, 11):
            killed = self.render("-j2", "--checkpoint", "0.01",
                                 env=dict(disk, FAULTY_DISK_CALL=str(calls * fortieth // 40)))
            self.assertEqual(killed.returncode, -signal.SIGKILL, killed.stderr)
        self.assert_renders()
        self.assertEqual(digest(self.out), whole)

    def test_a_pack_that_was_cut_off_goes_on(self):
        whole = self.whole()
        self.assert_renders()
        victim = self.packs(self.out / "fls")[1]
        with tarfile.open(victim) as archive:
            members = len(self.dataset()["sensors"][0]["packs"]["members"])
            second = archive.getmembers()[members].offset
        with open(victim, "r+b") as file:
            file.truncate(second + 100)
        result = json.loads(self.assert_renders("--json").stdout)
        each = self.dataset()["sensors"][0]["packs"]["pings"]
        self.assertEqual(result["pings"], each - 1)  # the first of the pack is still there
        self.assertEqual(digest(self.out), whole)
        victim.unlink()
        self.assertEqual(json.loads(self.assert_renders("--json").stdout)["pings"], each)
        self.assertEqual(digest(self.out), whole)

    def test_verify(self):
        self.assert_renders()
        result = self.run_sonarsim("verify", "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        victim = self.packs()[0]
        data = victim.read_bytes()
        for spoilt, words in ((data[:700] + bytes([data[700] ^ 1]) + data[701:], "SHA256SUMS"),
                              (data[:4096], "cut off"),
                              (data[:-1024] + data[:1024] + data[-1024:], "where its end should be"),
                              (data + data[-512:], "bytes after its end"),
                              (b"", "cut off")):
            with self.subTest(words=words):
                victim.write_bytes(spoilt)
                result = self.run_sonarsim("verify", "out")
                self.assertEqual(result.returncode, 1, result.stderr)
                self.assertIn(words, result.stderr)
        victim.unlink()
        self.assertIn("is missing", self.run_sonarsim("verify", "out").stderr)
        self.assert_renders()
        self.assertEqual(self.run_sonarsim("verify", "out").returncode, 0)

    def test_overwrite_removes_packs_and_nothing_else(self):
        self.assert_renders()
        self.write("out/fls/pack/notes.txt", "mine")
        self.assert_renders("--overwrite", "--set", "output.pack=none")
        self.assertEqual(self.packs(), [])
        self.assertEqual((self.out / "fls/pack/notes.txt").read_text(), "mine")

    def test_mistakes(self):
        self.edit("mission.yaml", "pack_size_mb: 0.2", "pack_size_mb: 0")
        self.assert_refused(self.render(), "mission.yaml:11:", "'pack_size_mb' must be")
        self.edit("mission.yaml", "pack_size_mb: 0", "pack_size_mb: 0.001")
        self.assert_refused(self.render(), "output.pack_size_mb is too small", "sensor 'fls' takes up to")
        self.edit("mission.yaml", "pack: tar", "pack: zip")
        self.assert_refused(self.render(), "mission.yaml:11:", "tar")
        self.assertFalse(self.out.exists())


if __name__ == "__main__":
    unittest.main()
