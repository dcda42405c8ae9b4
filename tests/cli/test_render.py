"""A render: what it prints and leaves behind, and that a signal is obeyed within about a second whatever the
program does when it comes. Bytes that do not depend on threads, shards and kills: tests/golden, test_faults.py."""
import importlib.util
import json
import os
import pathlib
import pty
import re
import shutil
import signal
import subprocess
import time
import unittest

from sandbox import ROOT, SANITIZED, SONARSIM, Sandbox, digest, gltf, path_csv, sheet_mesh, with_disk, with_keys


class Render(Sandbox):
    def test_where_files_go(self):
        before = digest(self.folder)
        self.succeeds("validate", "mission.yaml")
        self.assert_renders("--no-files")
        self.assertEqual(digest(self.folder), before)
        self.assertIn("pings/s", self.assert_renders("--out", "elsewhere").stdout)
        self.assertTrue(self.dataset("elsewhere")["complete"])
        self.assertFalse(self.out.exists())

    def test_log(self):
        """Triangles without area are in the mesh, and multipath and noise drop footprints."""
        mesh = json.loads((self.folder / "box.gltf").read_text())
        mesh["nodes"].append({"name": "line", "mesh": 0, "scale": [1, 0, 0]})
        self.write("box.gltf", json.dumps(mesh))
        self.edit("mission.yaml", "    noise:\n", "    multipath: {method: cluster}\n    noise:\n")
        lines = self.assert_renders().stderr.splitlines()
        self.assertEqual(len(lines), 3, lines)
        self.assertIn("box: 12 triangles, 6 poses", lines[0])
        self.assertIn("complete; 6 pings rendered", lines[1])
        self.assertTrue(lines[2].endswith("open out/fls/fan/000000.png"), lines[2])
        self.assertIn("all of its 6 pings were there already", self.assert_renders().stderr)
        far = ("--set", "sensors.fls.noise.range_lambda_m=3")
        debug = self.assert_renders("--overwrite", "--log-level", "debug", *far).stderr
        self.assert_has(debug, "12 triangles without area are left out", "multipath:", "footprints dropped")

    def test_another_mission_is_refused_in_words(self):
        self.assert_renders()
        before = digest(self.out)
        changes = ("seed: 7 there, 3 here", "sensors.fls.range_max_m: 6 there, 5 here", "--overwrite")
        self.assert_refused(self.render("--seed", "3", "--set", "sensors.fls.range_max_m=5"), "of another mission", *changes)
        self.assert_refused(self.run_sonarsim("validate", "mission.yaml", "--seed", "3"), changes[0])
        again = ("render", "out/mission.resolved.yaml", "--seed", "9", "--out", "out", "--overwrite")
        self.assert_refused(self.run_sonarsim(*again), "--paths-from")
        self.assert_refused(self.run_sonarsim(*again, "--paths-from", "."), "mission.resolved.yaml", "the mission itself")
        self.edit("materials.csv", "2400", "2500")
        self.assert_refused(self.render(), "other scene, material or trajectory files (materials.csv)")
        self.assertEqual(digest(self.out), before)
        self.assert_renders("--seed", "8", "--overwrite")
        self.assertEqual(self.dataset()["seed"], 8)

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

    @unittest.skipIf(importlib.util.find_spec("yaml") is None, "needs yaml")
    def test_a_mission_written_as_json(self):
        """JSON is YAML, and its writers quote every text and indent by tabs."""
        import yaml
        self.assert_renders()
        as_yaml = digest(self.out)
        mission = yaml.safe_load((self.folder / "mission.yaml").read_text())
        self.write("mission.json", json.dumps(mission, indent="\t").replace("0.1", "1e-1"))
        self.succeeds("render", "mission.json", "--overwrite")
        self.assertEqual(digest(self.out), as_yaml)

    def test_where_when_and_by_whom_leave_no_trace(self):
        """A time in a file would differ, since the runs begin in different seconds."""
        self.assert_renders(env={**os.environ, "HOME": "/", "TZ": "Asia/Tokyo", "USER": "one"})
        for path in self.out.rglob("*"):
            if path.is_file():
                self.assertNotIn(str(self.folder).encode(), path.read_bytes(), path)
        other = shutil.copytree(self.folder, self.folder / "deeper/other", ignore=shutil.ignore_patterns("out"))
        time.sleep(1.1)
        self.folder = other
        self.assert_renders(env={**os.environ, "HOME": "/tmp", "TZ": "UTC", "USER": "two"})
        self.assertEqual(digest(other / "out"), digest(self.out))
        for name in ("box.gltf", "materials.csv", "path.csv"):
            self.assertIn({"file": name, "sha256": digest(other)[name]}, self.dataset()["inputs"])

    def test_progress_line(self):
        poses = 2_000 if SANITIZED else 5_000   # seconds of work, and the line is first shown before one is over
        self.write("path.csv", path_csv(poses))
        ours, theirs = pty.openpty()
        with subprocess.Popen([SONARSIM, "render", "mission.yaml", "--no-files", "-j1"], cwd=self.folder,
                              env={**os.environ, "TERM": "xterm"}, stdout=subprocess.DEVNULL, stderr=theirs) as process:
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
        self.assertIn(b"\x1b[32minfo\x1b[m: ", shown)

    @unittest.skipIf(SANITIZED, "the same work as other renders, and minutes of it")
    def test_stated_bytes(self):
        """`validate` states the bytes that `render` writes to within a factor of 1.3."""
        text = (ROOT / "configs/towed_sidescan.yaml").read_text().replace("../scenes", str(ROOT / "scenes"))
        scatter, trajectory = text.index("  scatter:"), text.index("trajectory:")
        self.write("towed.yaml", (text[:scatter] + text[trajectory:]).replace("cell_m: 0.12", "cell_m: 0.4").replace("rippled_", ""))
        for mission, *settings in ((ROOT / "configs/tank_scanning.yaml",),
                ("towed.yaml", "trajectory.rate_hz=5", "sensors.sss.range_max_m=12", "output.xtf=true", "output.mosaic=true",
                 "output.labels=[]"), (ROOT / "configs/made_seabeds.yaml", "variants=2", "trajectory.rate_hz=2")):
            with self.subTest(mission=mission):
                shutil.rmtree(self.out, ignore_errors=True)
                options = [*with_keys(*settings), "--out", self.out]
                stated = self.reported("validate", mission, *options)["bytes"]
                self.succeeds("render", mission, "-q", *options)
                written = sum(path.stat().st_size for path in self.out.rglob("*") if path.is_file())
                self.assertTrue(written / 1.3 < stated < 1.3 * written, (stated, written))
        self.succeeds("validate", "towed.yaml", *with_keys("output.labels=[]", "sensors.sss.every=1000"))


def catches_sigterm(process):
    caught = re.search(r"^SigCgt:\s*(\w+)", pathlib.Path(f"/proc/{process.pid}/status").read_text(), re.MULTILINE)
    return int(caught[1], 16) >> (signal.SIGTERM - 1) & 1 == 1


class Signals(Sandbox):
    """Each test brings the program into a phase that lasts much longer than a second."""

    def assert_ends_at_once(self, process, number=signal.SIGTERM):
        """The phase goes on for long, so that only the end at once can print these words."""
        process.send_signal(number)
        _, stderr = process.communicate(timeout=120)
        self.assertEqual(process.returncode, 128 + number, stderr)
        self.assertIn("warning: stopped at once; written files are complete; run the same command " "again to continue", stderr)

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
                    "output.fan=false", "output.full_scale=1")
        with self.start("render", "mission.yaml", "-j1", *with_keys(*settings)) as process:
            self.wait_for(lambda: (self.out / "dataset.json").exists(), process)
            time.sleep(1)
            self.assert_ends_at_once(process)
        self.assertFalse(self.dataset()["complete"])

    def test_while_a_product_is_written(self):
        self.edit("mission.yaml", "    kind: imaging\n", "    kind: profiling\n")
        log = self.folder / "calls"
        whole = self.render_whole("-j1", env=with_disk(self, "none"))
        number = next(i for i, call in enumerate(log.read_text().splitlines(), 1)
                      if call.startswith("write ") and "bathymetry.tif" in call)
        with self.start("render", "mission.yaml", "-j1", env=with_disk(self, "stall", number)) as process:
            self.wait_for(lambda: log.exists() and log.read_text().count("\n") >= number, process)
            self.assert_ends_at_once(process)
        self.assertFalse(self.dataset()["complete"])
        self.assert_renders()
        self.assertEqual(digest(self.out), whole)
