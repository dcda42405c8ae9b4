"""What a render leaves behind: the same bytes whatever the threads, shards and interruptions."""
import json
import os
import pty
import shutil
import signal
import subprocess
import time
import unittest

from sandbox import SONARSIM, Sandbox, digest, path_csv

SANITIZED = os.environ.get("SANITIZED") == "1"


class Render(Sandbox):
    def test_dataset(self):
        result = self.assert_renders()
        self.assertIn("pings/s", result.stdout)
        dataset = self.dataset()
        self.assertIs(dataset["complete"], True)
        self.assertEqual(dataset["seed"], 7)
        for name in ("mission.resolved.yaml", "trajectory.tum"):
            self.assertTrue((self.out / name).is_file(), name)
        for product, suffix in (("polar", "npy"), ("image", "png"), ("fan", "png"),
                                ("meta", "json")):
            names = sorted(p.name for p in (self.out / "fls" / product).iterdir())
            self.assertEqual(names, [f"{i:06}.{suffix}" for i in range(6)])

    def test_polar_is_numpy(self):
        self.assert_renders()
        data = (self.out / "fls/polar/000000.npy").read_bytes()
        self.assertEqual(data[:8], b"\x93NUMPY\x01\x00")
        header = data[10:10 + int.from_bytes(data[8:10], "little")].decode()
        self.assertIn("'descr': '<f4'", header)
        self.assertIn("'shape': (48, 32)", header)
        self.assertEqual(len(data), 10 + len(header) + 48 * 32 * 4)

    def test_out_option_and_no_files(self):
        self.assert_renders("--out", "elsewhere")
        self.assertTrue((self.folder / "elsewhere/dataset.json").is_file())
        self.assert_renders("--no-files")
        self.assertFalse(self.out.exists())

    def test_resolved_mission_renders_the_same_pings(self):
        self.assert_renders()
        result = self.run_sonarsim("render", "out/mission.resolved.yaml", "--out",
                                   self.folder / "again", "--paths-from", self.folder)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(digest(self.out / "fls"), digest(self.folder / "again/fls"))

    def test_quiet_says_nothing(self):
        result = self.assert_renders("--quiet")
        self.assertEqual((result.stdout, result.stderr), ("", ""))

    def test_json(self):
        result = self.assert_renders("--json")
        lines = [json.loads(line) for line in result.stderr.splitlines()]
        self.assertTrue(lines)
        for line in lines:
            self.assertEqual(set(line), {"time", "level", "message"})
        summary = json.loads(result.stdout)
        self.assertEqual(summary["pings"], 6)
        (self.folder / "box.gltf").unlink()
        result = self.run_sonarsim("validate", "mission.yaml", "--json")
        self.assertEqual(result.returncode, 2)
        self.assertEqual(json.loads(result.stderr.splitlines()[-1])["level"], "error")

    def test_quiet_keeps_the_json_that_was_asked_for(self):
        for command in ("validate", "render"):
            with self.subTest(command=command):
                result = self.run_sonarsim(command, "mission.yaml", "--json", "-q")
                self.assertEqual((result.returncode, result.stderr), (0, ""))
                self.assertEqual(json.loads(result.stdout)["pings"], 6)

    def test_a_mission_written_as_json(self):
        """JSON is YAML, and its writers quote every text."""
        mission = {
            "name": "box", "seed": 7, "engine": "rays", "octree": {"leaf_m": 0.02},
            "scene": {"file": "box.gltf", "materials": "materials.csv"},
            "trajectory": {"file": "path.csv"},
            "sensors": {"fls": {
                "kind": "imaging", "azimuth_deg": 60, "elevation_deg": 12.0, "range_max_m": 6,
                "range_bins": 48, "azimuth_bins": 32, "streaks": {"mode": "none"},
                "multipath": {"method": "none"},
                "noise": {"add_sigma": 0.05, "mult_sigma": 1e-1, "range_lambda_m": 0.02,
                          "scale_with_range": True}}},
            "output": {"folder": "out", "image": True, "meta": True}}
        self.assert_renders("--set", "engine=rays")
        as_yaml = digest(self.out)
        for style in ({"indent": 2}, {"indent": "\t"}, {"separators": (",", ":")}):
            with self.subTest(style=style):
                self.write("mission.json", json.dumps(mission, **style))
                result = self.run_sonarsim("render", "mission.json", "--overwrite")
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual(digest(self.out), as_yaml)

    def test_validate_writes_nothing(self):
        before = digest(self.folder)
        result = self.run_sonarsim("validate", "mission.yaml")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(digest(self.folder), before)
        for fragment in ("6 poses", "6 pings", "12 triangles", "fls"):
            self.assertIn(fragment, result.stdout)

    def test_inspect(self):
        result = self.run_sonarsim("inspect", "box.gltf")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("Concrete", result.stdout)
        self.assertIn("walls", result.stdout)
        result = self.run_sonarsim("inspect", "box.gltf", "--json")
        scene = json.loads(result.stdout)
        self.assertEqual(scene["triangles"], 12)
        # Half-extents 2, 1.5, 2 in glTF axes; (x, y, z)_world = (x, -z, y)_gltf.
        self.assertEqual(scene["bounds_min_m"], [-2, -2, -1.5])
        self.assertEqual(scene["bounds_max_m"], [2, 2, 1.5])
        self.assert_refused(self.run_sonarsim("inspect", "none.glb"), "none.glb")


class SameBytes(Sandbox):
    def render_anew(self, *arguments):
        shutil.rmtree(self.out, ignore_errors=True)
        self.assert_renders(*arguments)
        return digest(self.out)

    def assert_polar(self, assertion, one, other):
        names = [name for name in one if name.startswith("fls/polar")]
        self.assertEqual(len(names), 6)
        for name in names:
            assertion(one[name], other[name], name)

    def test_threads(self):
        self.assertEqual(self.render_anew("-j1"), self.render_anew("-j2"))

    def test_where_when_and_by_whom_leave_no_trace(self):
        """A time in a file would differ, since the runs begin in different seconds."""
        self.assert_renders(env={**os.environ, "HOME": "/", "TZ": "Asia/Tokyo", "USER": "one"})
        other = self.folder / "deeper/other"
        other.mkdir(parents=True)
        for name in ("mission.yaml", "materials.csv", "box.gltf", "path.csv"):
            shutil.copy(self.folder / name, other)
        time.sleep(1.1)
        self.folder = other
        self.assert_renders(env={**os.environ, "HOME": "/tmp", "TZ": "UTC", "USER": "two"})
        self.assertEqual(digest(other / "out"), digest(self.out))

    def test_seed(self):
        seven = self.render_anew()
        eight = self.render_anew("--seed", "8")
        self.assert_polar(self.assertNotEqual, seven, eight)
        self.assertEqual(self.render_anew("--set", "seed=8"), eight)

    def test_without_noise_the_seed_does_not_matter(self):
        off = [argument for key in ("add_sigma", "mult_sigma", "range_lambda_m")
               for argument in ("--set", f"sensors.fls.noise.{key}=0")]
        self.assert_polar(self.assertEqual, self.render_anew(*off),
                          self.render_anew("--seed", "8", *off))

    def test_shards(self):
        whole = self.render_anew()
        shutil.rmtree(self.out)
        self.assert_renders("--shard", "1/2")
        self.assertIs(self.dataset()["complete"], False)
        self.assertEqual(len(list((self.out / "fls/polar").iterdir())), 3)
        self.assert_renders("--shard", "2/2")
        self.assertEqual(digest(self.out), whole)

    def test_shards_in_folders_that_are_merged(self):
        whole = self.render_anew()
        self.render_anew("--shard", "1/2")
        self.out.rename(self.folder / "first")
        self.render_anew("--shard", "2/2")
        shutil.copytree(self.folder / "first", self.out, dirs_exist_ok=True)
        self.assert_renders()
        self.assertEqual(digest(self.out), whole)

    def test_resume(self):
        whole = self.render_anew()
        self.render_anew("--shard", "1/2")
        kept = self.out / "fls/polar/000000.npy"
        before = kept.stat().st_mtime_ns
        result = self.assert_renders("--json")
        self.assertEqual(json.loads(result.stdout)["pings"], 3)
        self.assertEqual(json.loads(result.stdout)["skipped"], 3)
        self.assertEqual(digest(self.out), whole)
        self.assertEqual(kept.stat().st_mtime_ns, before, "what was done is not done again")
        result = self.assert_renders("--json")
        self.assertEqual(json.loads(result.stdout)["pings"], 0)


class Interrupted(Sandbox):
    POSES = 1500

    def interrupt(self, number):
        """Starts a long render anew and sends it a signal once pings appear."""
        shutil.rmtree(self.out, ignore_errors=True)
        with subprocess.Popen([SONARSIM, "render", "mission.yaml"], cwd=self.folder, text=True,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE) as process:
            deadline = time.monotonic() + 60
            while not list(self.out.glob("fls/meta/*.json")):
                if time.monotonic() > deadline or process.poll() is not None:
                    process.kill()
                    self.fail("no ping appeared")
                time.sleep(0.01)
            process.send_signal(number)
            _, stderr = process.communicate(timeout=60)
        return process.returncode, stderr

    def test_a_signal_leaves_what_was_written_intact(self):
        self.write("path.csv", path_csv(self.POSES))
        for number, code in ((signal.SIGTERM, 143), (signal.SIGINT, 130)):
            with self.subTest(signal=number):
                returned, stderr = self.interrupt(number)
                self.assertEqual(returned, code, stderr)
                self.assertIn("same command again", stderr, "the message says how to go on")
                self.assertIs(self.dataset()["complete"], False)
                self.check_files()
        self.assert_renders()
        resumed = digest(self.out)
        self.assertIs(self.dataset()["complete"], True)
        shutil.rmtree(self.out)
        self.assert_renders()
        self.assertEqual(digest(self.out), resumed)

    def check_files(self):
        polar = list((self.out / "fls/polar").iterdir())
        self.assertLess(len(polar), self.POSES)
        self.assertEqual({p.stat().st_size for p in polar}, {128 + 48 * 32 * 4})
        for path in self.out.rglob("*"):
            self.assertFalse(path.name.endswith(".part"), path)
            if path.suffix == ".json":
                json.loads(path.read_text())
            elif path.suffix == ".png":
                self.assertEqual(path.read_bytes()[-8:-4], b"IEND", path)


class Terminal(Sandbox):
    # Seconds of work, and the line is first shown before one is over.
    POSES = 4_000 if SANITIZED else 10_000

    def test_progress_line(self):
        self.write("path.csv", path_csv(self.POSES))
        ours, theirs = pty.openpty()
        with subprocess.Popen([SONARSIM, "render", "mission.yaml", "--no-files"], cwd=self.folder,
                              stdout=subprocess.DEVNULL, stderr=theirs) as process:
            os.close(theirs)
            shown = b""
            try:
                while piece := os.read(ours, 4096):
                    shown += piece
            except OSError:  # so ends a terminal whose other side is closed
                pass
        os.close(ours)
        self.assertEqual(process.returncode, 0)
        self.assertRegex(shown.decode(), rf"[0-9]+ of {self.POSES} pings, [0-9]+ pings/s, .* left")


if __name__ == "__main__":
    unittest.main()
