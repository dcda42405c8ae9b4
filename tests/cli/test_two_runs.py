"""Two runs that write into one folder at the same time: one of them gets a clear sentence, or both
fit together; what is there in the end is whole, and of one mission."""
import os
import random
import shutil
import signal
import subprocess
import time
import unittest

from sandbox import SONARSIM, Sandbox, digest, path_csv

FAULTY_DISK = os.environ["FAULTY_DISK"]
VARY = """
variants: 3
vary:
  - {key: sensors.fls.noise.add_sigma, uniform: [0.01, 0.2]}
"""
SECOND_RUN = "another run is writing into this folder"
REFUSALS = (SECOND_RUN, "holds a dataset of another mission", "holds variants of another mission",
            "holds files that are not a sonarsim dataset", "holds files that are not variants")


class Folder(Sandbox):
    POSES = 60

    def setUp(self):
        super().setUp()
        self.write("path.csv", path_csv(self.POSES))
        mission = (self.folder / "mission.yaml").read_text()
        self.write("variants.yaml", mission + VARY)
        self.draw = random.Random(25)

    def start(self, *arguments):
        return subprocess.Popen([SONARSIM, *map(str, arguments)], cwd=self.folder, text=True,
                                stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)

    def end(self, process):
        _, stderr = process.communicate(timeout=120)
        return process.returncode, stderr


class TwoRuns(Folder):
    def whole(self, *arguments):
        """What the command makes where nobody disturbs it."""
        out = self.folder / "alone"
        result = self.run_sonarsim(*arguments, "--out", out)
        self.assertEqual(result.returncode, 0, result.stderr)
        found = digest(out)
        shutil.rmtree(out)
        return found

    def assert_whole(self, *wholes):
        """The folder holds one of these datasets and nothing else."""
        result = self.run_sonarsim("verify", "out")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertNotIn("is not a file of the dataset", result.stderr)
        self.assertIn(digest(self.out), wholes)

    def assert_refused_or_done(self, code, stderr):
        self.assertIn(code, (0, 2), stderr)
        if code == 0:
            return
        errors = [line for line in stderr.splitlines() if line.startswith("error:")]
        self.assertEqual(len(errors), 1, stderr)
        self.assertTrue(any(words in errors[0] for words in REFUSALS), stderr)

    def pair(self, first, second, delay):
        """The exit codes of two commands, the second of which starts `delay` seconds later."""
        shutil.rmtree(self.out, ignore_errors=True)
        one = self.start(*first)
        time.sleep(delay)
        other = self.start(*second)
        codes = []
        for process in (one, other):
            code, stderr = self.end(process)
            self.assert_refused_or_done(code, stderr)
            codes.append(code)
        self.assertIn(0, codes)
        return tuple(codes)

    def test_pairs_of_runs(self):
        """Two missions, one mission twice, one that overwrites the other, and two shards."""
        other = ("--seed", "9")
        for name in ("mission.yaml", "variants.yaml"):
            render = ("render", name)
            wholes = [self.whole(*render), self.whole(*render, *other)]
            for first, second, delay in (((), other, 0.0), ((), other, self.draw.uniform(0.0, 0.15)), ((), (), 0.02),
                                         ((), (*other, "--overwrite"), 0.1), (("--shard", "1/2"), ("--shard", "2/2"), 0.0)):
                with self.subTest(name=name, first=first, second=second, delay=delay):
                    codes = self.pair((*render, *first), (*render, *second), delay)
                    if second == other:
                        self.assertEqual(sorted(codes), [0, 2])
                    if first:
                        self.assertEqual(codes, (0, 0))
                    # The second may have come first, or have replaced a finished dataset.
                    replaced = "--overwrite" in second and codes[1] == 0 or second == other and codes[0] != 0
                    self.assert_whole(wholes[replaced])

    def test_shards_that_do_not_fit(self):
        """The same shard twice, shards of two divisions, of two missions, and a whole run."""
        render = ("render", "mission.yaml")
        wholes = [self.whole(*render), self.whole(*render, "--seed", "9")]
        for second in (("--shard", "1/2"), ("--shard", "2/3"), ("--shard", "2/2", "--seed", "9"), ()):
            with self.subTest(second=second):
                codes = self.pair((*render, "--shard", "1/2"), (*render, *second), self.draw.uniform(0.0, 0.15))
                other = codes[0] != 0 and "--seed" in second
                self.assertEqual(self.run_sonarsim(*render, *(("--seed", "9") if other else ())).returncode, 0)
                self.assert_whole(wholes[other])

    def test_eight_shards_at_once(self):
        whole = self.whole("render", "mission.yaml")
        shards = [self.start("render", "mission.yaml", "-j1", "--shard", f"{k}/8")
                  for k in range(1, 9)]
        for shard in shards:
            code, stderr = self.end(shard)
            self.assertEqual(code, 0, stderr)
        self.assert_whole(whole)

    def test_merges(self):
        render = ("render", "mission.yaml")
        whole = self.whole(*render)
        for k in (1, 2):
            self.assert_renders("--shard", f"{k}/2", "--out", f"part{k}")
        merge = ("merge", "part1", "part2", "out")
        for second in (merge, render):
            with self.subTest(second=second):
                self.pair(merge, second, 0.005)
                self.assertEqual(self.run_sonarsim(*render).returncode, 0)
                self.assert_whole(whole)


class HeldFolder(Folder):
    """The first run is halted, so that the second comes while it is at work."""
    POSES = 600

    def halted(self, *arguments):
        process = self.start("render", *arguments)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        deadline = time.monotonic() + 30
        while not list(self.out.rglob("fls/meta/*.json")):
            self.assertIsNone(process.poll())
            self.assertLess(time.monotonic(), deadline)
            time.sleep(0.005)
        process.send_signal(signal.SIGSTOP)
        # The signal is delivered later; this returns when every thread has stopped.
        os.waitid(os.P_PID, process.pid, os.WSTOPPED | os.WNOWAIT)
        return process

    def go_on(self, process):
        process.send_signal(signal.SIGCONT)
        code, stderr = self.end(process)
        self.assertEqual(code, 0, stderr)
        result = self.run_sonarsim("verify", "out")
        self.assertEqual(result.returncode, 0, result.stderr)

    def assert_second_is_refused(self, *arguments):
        before = digest(self.out)
        result = self.run_sonarsim(*arguments)
        # Another mission is refused without a look at who is at work.
        other = "--seed" in arguments and "--overwrite" not in arguments or "out/variant_0000" in arguments
        self.assert_refused(result, "out", "of another mission" if other else SECOND_RUN)
        self.assertEqual(digest(self.out), before)

    def test_a_whole_run(self):
        part = self.folder / "part"
        self.assert_renders("--out", part)
        first = self.halted("mission.yaml")
        for more in ((), ("--seed", "9"), ("--seed", "9", "--overwrite"), ("--shard", "1/2")):
            with self.subTest(more=more):
                self.assert_second_is_refused("render", "mission.yaml", *more)
        self.assert_second_is_refused("merge", part, "out")
        self.go_on(first)

    def test_a_shard(self):
        first = self.halted("mission.yaml", "--shard", "1/2")
        for more in ((), ("--overwrite",), ("--shard", "1/2"), ("--shard", "1/3")):
            with self.subTest(more=more):
                self.assert_second_is_refused("render", "mission.yaml", *more)
        second = self.render("--shard", "2/2")
        self.assertEqual(second.returncode, 0, second.stderr)
        self.go_on(first)

    def test_variants(self):
        first = self.halted("variants.yaml")
        for more in ((), ("--seed", "9", "--overwrite")):
            with self.subTest(more=more):
                self.assert_second_is_refused("render", "variants.yaml", *more)
        self.assert_second_is_refused("render", "mission.yaml", "--out", "out/variant_0000")
        self.go_on(first)

    def test_a_killed_run_holds_nothing(self):
        first = self.halted("mission.yaml")
        first.kill()
        first.wait()
        self.assert_renders()


class Disks(Sandbox):
    def on_disk(self, mode, *arguments):
        environment = dict(os.environ, LD_PRELOAD=FAULTY_DISK, FAULTY_DISK_BELOW=str(self.out),
                           FAULTY_DISK_LOG=str(self.folder / "calls"), FAULTY_DISK_MODE=mode)
        return self.run_sonarsim(*arguments, env=environment)

    def test_a_disk_without_locks(self):
        self.write("variants.yaml", (self.folder / "mission.yaml").read_text() + VARY)
        self.assert_renders("--out", "part")
        for arguments in (("render", "mission.yaml"), ("render", "mission.yaml", "--shard", "1/1"),
                          ("render", "variants.yaml"), ("merge", "part", "out")):
            with self.subTest(arguments=arguments):
                shutil.rmtree(self.out, ignore_errors=True)
                result = self.on_disk("nolock", *arguments)
                self.assertEqual(result.returncode, 0, result.stderr)
                warnings = [line for line in result.stderr.splitlines() if "no locks" in line]
                self.assertEqual(len(warnings), 1, result.stderr)
                self.assertIn("out: the disk", warnings[0])
                self.assertEqual(self.run_sonarsim("verify", "out").returncode, 0)

    def test_a_complete_dataset_on_a_read_only_disk(self):
        self.edit("mission.yaml", "    kind: imaging\n", "    kind: echosounder\n")
        self.edit("mission.yaml", "    azimuth_deg: 60\n    elevation_deg: 12\n", "")
        self.edit("mission.yaml", "    azimuth_bins: 32\n", "")
        self.write("variants.yaml", (self.folder / "mission.yaml").read_text() + VARY)
        for name in ("variants.yaml", "mission.yaml"):
            shutil.rmtree(self.out, ignore_errors=True)
            self.assertEqual(self.run_sonarsim("render", name).returncode, 0)
            before = digest(self.out)
            for more in ((), ("--shard", "1/2")):
                result = self.on_disk("readonly", "render", name, *more)
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn("complete; ", result.stderr)
            self.assertEqual(digest(self.out), before)
        (self.out / "fls/echogram.npy").unlink()
        result = self.on_disk("readonly", "render", "mission.yaml")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("Read-only file system", result.stderr)


if __name__ == "__main__":
    unittest.main()
