"""A render: what it prints and leaves behind, and that a signal is obeyed within about a second whatever the
program does when it comes. Bytes that do not depend on threads, shards and kills: tests/golden, test_faults.py."""
import json
import os
import pathlib
import pty
import shutil
import signal
import subprocess
import time
import unittest

from sandbox import SANITIZED, SONARSIM, Sandbox, digest, gltf, path_csv, sheet_mesh

FAULTY_DISK = os.environ["FAULTY_DISK"]


class Render(Sandbox):
    def test_out_option_and_no_files(self):
        self.assertIn("pings/s", self.assert_renders("--out", "elsewhere").stdout)
        self.assertTrue(self.dataset(self.folder / "elsewhere")["complete"])
        self.assert_renders("--no-files")
        self.assertFalse(self.out.exists())

    def test_quiet_and_json(self):
        result = self.assert_renders("--quiet")
        self.assertEqual((result.stdout, result.stderr), ("", ""))
        result = self.assert_renders("--json", "--overwrite")
        lines = [json.loads(line) for line in result.stderr.splitlines()]
        self.assertTrue(lines)
        for line in lines:
            self.assertEqual(set(line), {"time", "level", "message"})
        for command in ("validate", "render"):
            result = self.succeeds(command, "mission.yaml", "--json", "-q")
            self.assertEqual((result.stderr, json.loads(result.stdout)["pings"]), ("", 6 if command == "validate" else 0))

    def test_a_mission_written_as_json(self):
        """JSON is YAML, and its writers quote every text."""
        mission = {
            "name": "box", "seed": 7, "engine": "rays", "octree": {"leaf_m": 0.02},
            "scene": {"file": "box.gltf", "materials": "materials.csv"},
            "trajectory": {"file": "path.csv"},
            "sensors": {"fls": {
                "kind": "imaging", "azimuth_deg": 60, "elevation_deg": 12.0, "range_max_m": 6,
                "range_bins": 48, "azimuth_bins": 32, "streaks": {"mode": "none"},
                "noise": {"add_sigma": 0.05, "mult_sigma": 1e-1, "range_lambda_m": 0.02}}},
            "output": {"folder": "out", "image": True}}
        self.assert_renders("--set", "engine=rays")
        as_yaml = digest(self.out)
        self.write("mission.json", json.dumps(mission, indent="\t"))
        self.succeeds("render", "mission.json", "--overwrite")
        self.assertEqual(digest(self.out), as_yaml)

    def test_validate_writes_nothing(self):
        before = digest(self.folder)
        result = self.succeeds("validate", "mission.yaml")
        self.assertEqual(digest(self.folder), before)
        for fragment in ("6 poses", "6 pings", "12 triangles", "fls"):
            self.assertIn(fragment, result.stdout)

    def test_where_when_and_by_whom_leave_no_trace(self):
        """A time in a file would differ, since the runs begin in different seconds."""
        self.assert_renders(env={**os.environ, "HOME": "/", "TZ": "Asia/Tokyo", "USER": "one"})
        for path in self.out.rglob("*"):
            if path.is_file():
                self.assertNotIn(str(self.folder).encode(), path.read_bytes(), path)
        other = self.folder / "deeper/other"
        other.mkdir(parents=True)
        for name in ("mission.yaml", "materials.csv", "box.gltf", "path.csv"):
            shutil.copy(self.folder / name, other)
        time.sleep(1.1)
        self.folder = other
        self.assert_renders(env={**os.environ, "HOME": "/tmp", "TZ": "UTC", "USER": "two"})
        self.assertEqual(digest(other / "out"), digest(self.out))

    def test_the_resolved_mission_gives_the_same_dataset(self):
        self.assert_renders()
        sums = digest(self.folder)
        for name in ("box.gltf", "materials.csv", "path.csv"):
            self.assertIn({"file": name, "sha256": sums[name]}, self.dataset()["inputs"])
        resolved = ("render", "out/mission.resolved.yaml", "--out", self.folder / "again")
        self.assert_refused(self.run_sonarsim(*resolved), "--paths-from")
        self.succeeds(*resolved, "--paths-from", ".")
        self.assertEqual(digest(self.folder / "again"), digest(self.out))

    def test_seed_and_resume(self):
        self.assert_renders()
        whole = digest(self.out)
        shutil.rmtree(self.out)
        self.assert_renders("--shard", "1/2")
        kept = self.out / "fls/polar/000000.npy"
        before = kept.stat().st_mtime_ns
        done = json.loads(self.assert_renders("--json").stdout)
        self.assertEqual((done["pings"], done["skipped"]), (3, 3))
        self.assertEqual(digest(self.out), whole)
        self.assertEqual(kept.stat().st_mtime_ns, before, "what was done is not done again")
        self.assert_renders("--seed", "8", "--overwrite")
        eight = digest(self.out)
        for name in (name for name in whole if name.startswith("fls/polar")):
            self.assertNotEqual(whole[name], eight[name])

    def test_progress_line(self):
        poses = 2_000 if SANITIZED else 5_000   # seconds of work, and the line is first shown before one is over
        self.write("path.csv", path_csv(poses))
        ours, theirs = pty.openpty()
        with subprocess.Popen([SONARSIM, "render", "mission.yaml", "--no-files", "-j1"], cwd=self.folder,
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
        self.assertRegex(shown.decode(), rf"[0-9]+ of {poses} pings, [0-9]+ pings/s, .* left")


def catches_sigterm(process):
    for line in pathlib.Path(f"/proc/{process.pid}/status").read_text().splitlines():
        if line.startswith("SigCgt:"):
            return int(line.split()[1], 16) >> (signal.SIGTERM - 1) & 1 == 1
    return False


def busy_s(pid):
    """The processor time that a process has had so far; 0 when it is gone."""
    try:
        fields = pathlib.Path(f"/proc/{pid}/stat").read_text().rsplit(")", 1)[1].split()
    except (FileNotFoundError, ProcessLookupError):
        return 0.0
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


class Signals(Sandbox):
    """Each test brings the program into a phase that lasts much longer than a second."""

    def wait_for(self, holds, process):
        for _ in range(6000):
            if holds():
                return
            self.assertIsNone(process.poll(), "ended before it came to the phase")
            time.sleep(0.02)
        self.fail("never came to the phase")

    def start(self, *arguments, **environment):
        return subprocess.Popen([SONARSIM, *arguments], cwd=self.folder, text=True,
                                env={**os.environ, **environment}, stdout=subprocess.DEVNULL,
                                stderr=subprocess.PIPE)

    def assert_ends_at_once(self, process, number=signal.SIGTERM):
        """The phase goes on for long, so that only the end at once can print these words."""
        process.send_signal(number)
        _, stderr = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 128 + number, stderr)
        self.assertIn("warning: stopped at once; written files are complete; run the same command "
                      "again to continue", stderr)

    def test_while_a_scene_is_loaded(self):
        # Copies of a sheet whose triangles have no area, which take time and no memory.
        points, indices, material = sheet_mesh(10.0, 70)
        nodes = [{"mesh": 0, "translation": [0, -k, 0]} for k in range(1000 if SANITIZED else 10000)]
        self.write("box.gltf", gltf(nodes, [([(x, 0, 0) for x, _, _ in points], indices, material)]))
        with self.start("render", "mission.yaml") as process:
            self.wait_for(lambda: catches_sigterm(process), process)
            self.assert_ends_at_once(process, signal.SIGINT)
            self.assertFalse(self.out.exists())

    def test_during_a_long_ping(self):
        # Where sound bends the error is not measured, which would take much longer before.
        settings = ("sensors.fls.azimuth_bins=3072", "sensors.fls.azimuth_deg=360", "sensors.fls.elevation_deg=160",
                    "water.profile={named: summer}", "scene.water_surface={height_m: 5}", "accuracy.relative_l1=1e-4",
                    "output.fan=false")
        with self.start("render", "mission.yaml", "-j1", *(w for s in settings for w in ("--set", s))) as process:
            self.wait_for(lambda: (self.out / "dataset.json").exists(), process)
            begun = busy_s(process.pid)
            self.wait_for(lambda: busy_s(process.pid) > begun + 0.5, process)
            self.assert_ends_at_once(process)
        self.assertFalse(self.dataset()["complete"])

    def test_while_a_product_is_written(self):
        self.edit("mission.yaml", "    kind: imaging\n", "    kind: profiling\n")
        log = self.folder / "calls"
        disk = {"LD_PRELOAD": FAULTY_DISK, "FAULTY_DISK_BELOW": str(self.out), "FAULTY_DISK_LOG": str(log)}
        self.assert_renders("-j1", env={**os.environ, **disk, "FAULTY_DISK_MODE": "none", "FAULTY_DISK_CALL": "0"})
        whole = digest(self.out)
        number = next(i for i, call in enumerate(log.read_text().splitlines(), 1)
                      if call.split()[0] in ("fwrite", "write", "fopen") and "bathymetry.tif" in call)
        shutil.rmtree(self.out)
        log.unlink()
        with self.start("render", "mission.yaml", "-j1", FAULTY_DISK_MODE="stall", FAULTY_DISK_CALL=str(number),
                        **disk) as process:
            self.wait_for(lambda: log.exists() and log.read_text().count("\n") >= number, process)
            self.assert_ends_at_once(process)
        self.assertFalse(self.dataset()["complete"])
        self.assert_renders()
        self.assertEqual(digest(self.out), whole)


if __name__ == "__main__":
    unittest.main()
