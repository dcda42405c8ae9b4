"""Disks that fail, memory that runs out, signals and power cuts at any moment: an exit code, a sentence, and what is
written is whole or, by the same command run again, becomes so."""
import contextlib
import json
import os
import random
import re
import resource
import shutil
import signal
import time
import unittest

from sandbox import ALL_FILES, SANITIZED, SONARSIM, Sandbox, digest, path_csv, with_disk

RECORDS = ("soundings.npy", "waterfall.npy", "echogram.npy")
# What a line of the journal or dataset.json counts on is durable before it is written.
CHECKPOINT = ["syncfs out", "write out/journal.d/1-of-1.txt", "fdatasync out/journal.d/1-of-1.txt"]
BEGIN = ["fsync out/..dataset.json.part.part", "close out/..dataset.json.part.part", "rename out/.dataset.json.part",
         "fsync out", "link out/dataset.json", "syncfs out"]
END = ["syncfs out", "open out/.dataset.json.part", "write out/.dataset.json.part", "fsync out/.dataset.json.part",
       "close out/.dataset.json.part", "rename out/dataset.json", "fsync out"]


class Faults(Sandbox):
    def assert_whole(self, killed=False):
        """Every file that has its final name has all of its bytes; others only a kill leaves."""
        for path in self.out.rglob("*"):
            if path.name.endswith(".part"):
                self.assertTrue(killed, path)
            elif path.suffix == ".json":
                json.loads(path.read_text())
            elif path.suffix == ".png":
                self.assertEqual(path.read_bytes()[-8:-4], b"IEND", path)
            elif path.is_file() and path.name in self.expected_sizes:
                # Where pings are added one by one, in any order, the file bears its name before.
                if path.name not in RECORDS or self.is_complete():
                    self.assertEqual(path.stat().st_size, self.expected_sizes[path.name], path)

    def is_complete(self):
        return (self.out / "dataset.json").exists() and self.dataset()["complete"]

    def render_whole(self):
        self.assert_renders()
        self.expected_sizes = {p.name: p.stat().st_size for p in self.out.rglob("*")
                               if p.suffix in (".npy", ".tif", ".csv", ".ply", ".tum")}
        return super().render_whole()

    def assert_can_go_on(self, whole):
        self.assert_renders()
        self.assertEqual(digest(self.out), whole)
        shutil.rmtree(self.out)


class FaultyDisk(Faults):
    FEWEST_CALLS = 100
    FILES = {"mission.yaml": ALL_FILES, "path.csv": path_csv(1)}

    def setUp(self):
        super().setUp()
        self.whole = self.render_whole()

    def render_faulty(self, mode, call=0):
        """The result, and the calls that write, by their names in the sandbox."""
        log = self.folder / "calls"
        result = self.render("-j1", env=with_disk(self, mode, call))
        calls = log.read_text().replace(f"{self.folder}/", "") if log.exists() else ""
        return result, re.sub(r"\.[0-9a-f]{16}\.part", ".part", calls).splitlines()

    def test_every_call_that_writes_may_fail(self):
        result, calls = self.render_faulty("none")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(digest(self.out), self.whole)
        # Four kinds of sonar with all their files: fewer would mean that the disk is not asked.
        self.assertEqual({call.split()[0] for call in calls},
                         {"open", "write", "pwrite", "ftruncate", "rename", "link", "mkdir", "close", "fsync",
                          "fdatasync", "syncfs"})
        self.assertGreater(len(calls), self.FEWEST_CALLS)
        for expected, at in ((BEGIN, calls.index(BEGIN[0])), (CHECKPOINT, calls.index(CHECKPOINT[1]) - 1),
                             (END, len(calls) - len(END) - 1)):
            self.assertEqual(calls[at:at + len(expected)], expected)
        every = 10 if SANITIZED else 1
        for number in range(1, len(calls) + 1, every):
            self.check_call("once", "Input/output error", calls, number, number % 12 == 0)
        for number in range(1, len(calls) + 1, 10 * every):
            self.check_call("full", "No space left on device", calls, number, True)

    def check_call(self, mode, reason, calls, number, go_on):
        with self.subTest(mode=mode, number=number, call=calls[number - 1]):
            shutil.rmtree(self.out, ignore_errors=True)
            result, seen = self.render_faulty(mode, number)
            self.assertEqual(seen[:number], calls[:number], "calls in another order")
            if calls[number - 1].endswith("(deleted)"):  # the lock's file, which holds nothing more
                self.assertEqual(result.returncode, 0, result.stderr)
                return
            self.assertEqual(result.returncode, 1, result.stderr)
            self.assertEqual(len(re.findall("^error: ", result.stderr, re.M)), 1, result.stderr)
            self.assertIn(reason, result.stderr)
            self.assertIn(str(self.out), result.stderr)
            if self.is_complete():
                self.assertEqual(number, len(calls) - 1, "the last fsync, after which all is durable")
            self.assert_whole()
            if go_on:
                self.assert_can_go_on(self.whole)

    def test_writes_that_are_done_in_parts(self):
        for mode in ("short", "interrupted"):
            with self.subTest(mode=mode):
                result, calls = self.render_faulty(mode)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertEqual(digest(self.out), self.whole)
                self.assertGreater(len(calls), self.FEWEST_CALLS)
                shutil.rmtree(self.out)

    def test_results_that_nobody_can_take(self):
        for arguments in (["render", "mission.yaml", "--no-files"], ["inspect", "box.gltf"], ["validate", "mission.yaml"],
                          ["--help"]):
            with self.subTest(arguments=arguments), open("/dev/full", "w") as full:
                result = self.run_program(SONARSIM, *arguments, code=1, stdout=full)
                self.assertIn("No space left on device", result.stderr)


class Ends(Faults):
    def test_signals_at_random_moments(self):
        self.write("path.csv", path_csv(120))
        start = time.monotonic()
        whole = self.render_whole()
        longest = time.monotonic() - start
        draw = random.Random(20)
        killed = False
        codes = {signal.SIGINT: {130}, signal.SIGTERM: {143}, signal.SIGKILL: {-signal.SIGKILL}}
        for _ in range(4 if SANITIZED else 16):
            number = draw.choice(list(codes))
            wait = draw.uniform(0.0, longest)
            before = digest(self.out) if self.out.exists() else {}
            with self.subTest(signal=number, wait=wait):
                with self.start("render", "mission.yaml") as process:
                    time.sleep(wait)
                    process.send_signal(number)
                    _, stderr = process.communicate(timeout=60)
                # Until the program is loaded and has begun, a signal ends it without a word.
                after = digest(self.out) if self.out.exists() else {}
                early = {-number} if after == before else set()
                self.assertIn(process.returncode, codes[number] | {0} | early, stderr)
                if process.returncode > 0:
                    self.assertIn("same command again", stderr)
                if process.returncode >= 0:
                    self.assertEqual(self.is_complete(), process.returncode == 0)
                # What a kill left stays until a run gets as far as to tidy up.
                killed = killed or number == signal.SIGKILL or "stopped at once" in stderr
                self.assert_whole(killed)
        self.assert_can_go_on(whole)

    def test_power_cuts(self):
        """Where the power goes, files of pings that no line of the journal names are there, in part, or not at all."""
        self.write("mission.yaml", ALL_FILES)
        self.write("path.csv", path_csv(80))
        whole = self.render_whole()
        draw = random.Random(7)
        lost = 0
        rounds = 0
        # Whether files lie between two checkpoints at the moment of the cut is up to chance.
        while rounds < (3 if SANITIZED else 10) or (lost == 0 and rounds < 60):
            begun = len(self.durable_pings())
            with self.start("render", "mission.yaml", "-j2", "--checkpoint", "0.01") as process:
                while process.poll() is None and len(self.durable_pings()) == begun:
                    time.sleep(0.001)
                time.sleep(draw.uniform(0.0, 0.01))
                process.kill()
            lost += self.lose_power(draw)
            rounds += 1
            if rounds % 3 == 0:
                self.assert_can_go_on(whole)
        self.assert_can_go_on(whole)
        self.assertGreater(lost, 0)

    def durable_pings(self):
        """Pairs of a sensor's number and a ping."""
        lines = ""
        for path in (*self.out.glob("journal.d/*"), self.out / "journal.txt"):
            with contextlib.suppress(FileNotFoundError):
                lines += path.read_text()
        return {(int(sensor), int(ping)) for sensor, ping in re.findall(r"^ping (\d+) (\d+) ", lines, re.M)}

    def lose_power(self, draw):
        """The number of files that are lost."""
        durable = self.durable_pings()
        lost = 0
        for number, sensor in enumerate(("fls", "mbes", "sss", "sounder")):
            for path in self.out.glob(f"{sensor}/*/*"):
                fate = draw.choice(("there", "part", "none"))
                if (number, int(path.name.strip(".")[:6])) not in durable and fate != "there":
                    lost += 1
                    os.truncate(path, path.stat().st_size // 2) if fate == "part" else path.unlink()
        return lost

    def test_a_second_signal_ends_at_once(self):
        self.write("path.csv", path_csv(2400))
        with self.start("render", "mission.yaml") as process:
            self.wait_for(lambda: list(self.out.glob("fls/meta/*.json")), process)
            process.send_signal(signal.SIGSTOP)  # so that both are there before it can react
            for number in (signal.SIGINT, signal.SIGTERM, signal.SIGCONT):
                process.send_signal(number)
            process.communicate(timeout=60)
        self.assertIn(process.returncode, {-signal.SIGINT, -signal.SIGTERM, 130, 143})

    @unittest.skipIf(SANITIZED, "a program under a sanitizer cannot be held to so little memory")
    def test_memory_runs_out_anywhere(self):
        """From what suffices down to what the libraries cannot even be loaded with."""
        def limited(*arguments, megabytes):
            return self.run_sonarsim(*arguments, preexec_fn=lambda: resource.setrlimit(
                resource.RLIMIT_AS, (megabytes << 20, megabytes << 20)))

        whole = self.render_whole()
        least = next(mb for mb in range(100, 2000, 10) if limited("--version", megabytes=mb).returncode == 0)
        failed = 0
        # Where a library lies in memory is up to chance, and so is the last bit that it needs.
        for megabytes in range(least + 40, least + 500, 40):
            with self.subTest(megabytes=megabytes):
                result = limited("render", "mission.yaml", "-j2", megabytes=megabytes)
                self.assertIn(result.returncode, (0, 1), result.stderr)
                self.assertEqual(self.is_complete(), result.returncode == 0)
                self.assert_whole()
                if result.returncode == 0:
                    self.assertEqual(digest(self.out), whole)
                    break
                failed += 1
                self.assertIn("out of memory", result.stderr)
        self.assertGreater(failed, 0)
        self.assertTrue(self.is_complete())
