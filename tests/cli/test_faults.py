"""Disks that fail, memory that runs out, signals and power cuts at any moment: an exit code, a sentence, and what is
written is whole or, by the same command run again, becomes so."""
import os
import random
import re
import resource
import shutil
import signal
import time
import unittest

from sandbox import ALL_FILES, SANITIZED, SONARSIM, Sandbox, digest, path_csv, with_disk

GROWING = ("soundings.npy", "waterfall.npy", "echogram.npy", "dataset.json")
# What a line of the journal or dataset.json counts on is durable before it is written.
CHECKPOINT = ["syncfs out", "write out/journal.d/1-of-1.txt", "fdatasync out/journal.d/1-of-1.txt"]
BEGIN = ["fsync out/..dataset.json.part.part", "close out/..dataset.json.part.part", "rename out/.dataset.json.part",
         "fsync out", "link out/dataset.json", "syncfs out"]
END = ["syncfs out", "open out/.dataset.json.part", "write out/.dataset.json.part", "fsync out/.dataset.json.part",
       "close out/.dataset.json.part", "rename out/dataset.json", "fsync out"]


class Faults(Sandbox):
    def assert_bytes(self, whole, killed=False):
        """Every file that has its final name has the bytes of the whole dataset; others only a kill leaves."""
        complete = self.is_complete()
        for name, found in digest(self.out).items():
            if name.endswith(".part"):
                self.assertTrue(killed, name)
            # Where pings are added one by one, in any order, the file bears its name before.
            elif name in whole and (complete or not name.endswith(GROWING)):
                self.assertEqual(found, whole[name], name)

    def is_complete(self):
        return (self.out / "dataset.json").exists() and self.dataset()["complete"]

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
                         {"open", "write", "pwrite", "ftruncate", "rename", "link", "mkdir", "close", "fsync", "fdatasync", "syncfs"})
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
            self.assert_bytes(self.whole)
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
        start, whole = time.monotonic(), self.render_whole()
        longest = time.monotonic() - start
        draw, killed = random.Random(20), False
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
                self.assert_bytes(whole, killed)
        self.assert_can_go_on(whole)

    def test_power_cuts(self):
        """Where the power goes, files of pings that no line of the journal names are there, in part, or not at all."""
        self.write("mission.yaml", ALL_FILES)
        whole = self.render_whole()
        draw, journal, fates = random.Random(7), self.out / "journal.d/1-of-2.txt", set()
        for _ in range(3 if SANITIZED else 10):
            self.assert_renders("--shard", "1/2")
            text = journal.read_text()
            cut = draw.randrange(len(text))
            journal.write_text(text[:cut])
            for sensor, ping in re.findall(r"^ping (\d+) (\d+) ", text[text.rfind("\n", 0, cut) + 1:], re.M):
                for path in self.out.glob(f"{('fls', 'mbes', 'sss', 'sounder')[int(sensor)]}/*/{int(ping):06}.*"):
                    fate = draw.choice(("there", "part", "none"))
                    fates.add(fate)
                    if fate == "part":
                        os.truncate(path, path.stat().st_size // 2)
                    elif fate == "none":
                        path.unlink()
            self.assert_can_go_on(whole)
        self.assertEqual(len(fates), 3)

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
                self.assert_bytes(whole)
                if result.returncode == 0:
                    self.assertEqual(digest(self.out), whole)
                    break
                failed += 1
                self.assertIn("out of memory", result.stderr)
        self.assertGreater(failed, 0)
        self.assertTrue(self.is_complete())
