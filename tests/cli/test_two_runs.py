"""Two runs that write into one folder at the same time: one of them gets a clear sentence, or both
fit together; what is there in the end is whole, and of one mission."""
import os
import random
import shutil
import signal
import time

from sandbox import ALL_FILES, MISSION, VARIED, Sandbox, digest, path_csv, with_disk

RENDER = ("render", "mission.yaml")
SECOND_RUN = "another run is writing into this folder"
REFUSALS = (SECOND_RUN, "holds a dataset of another mission", "holds variants of another mission",
            "holds files that are not a sonarsim dataset", "holds files that are not variants")


class TwoRuns(Sandbox):
    FILES = {"path.csv": path_csv(60), "variants.yaml": MISSION + VARIED}

    def assert_whole(self, whole):
        """The folder holds this dataset and nothing else."""
        self.assertNotIn("is not a file of the dataset", self.succeeds("verify", "out").stderr)
        self.assertEqual(digest(self.out), whole)

    def pair(self, first, second, delay):
        """The exit codes of two commands, the second of which starts `delay` seconds later: done or refused in a word."""
        shutil.rmtree(self.out, ignore_errors=True)
        one = self.start(*first)
        time.sleep(delay)
        processes = one, self.start(*second)
        for process in processes:
            _, stderr = process.communicate(timeout=120)
            self.assertIn(process.returncode, (0, 2), stderr)
            errors = [line for line in stderr.splitlines() if line.startswith("error:")]
            self.assertEqual(len(errors), process.returncode // 2, stderr)
            self.assertTrue(all(any(words in error for words in REFUSALS) for error in errors), stderr)
        codes = tuple(process.returncode for process in processes)
        self.assertIn(0, codes)
        return codes

    def test_pairs_of_runs(self):
        """One mission twice, two missions, one that overwrites the other; two shards, shards of two divisions and of two
        missions."""
        draw, other, half = random.Random(25), ("--seed", "9"), ("--shard", "1/2")
        for name, pairs in (("variants.yaml", (((), other), ((), (*other, "--overwrite")), (half, ("--shard", "2/2")))),
                            ("mission.yaml", (((), other), ((), ()), ((), (*other, "--overwrite")),
                                              (half, ("--shard", "2/2")), (half, half), (half, ("--shard", "2/3")),
                                              (half, ("--shard", "2/2", *other)), (half, ())))):
            wholes = [self.render_whole(*more, name=name, out="alone") for more in ((), other)]
            for first, second in pairs:
                with self.subTest(name=name, first=first, second=second):
                    codes = self.pair(("render", name, *first), ("render", name, *second), draw.uniform(0.0, 0.15))
                    if second == other:
                        self.assertEqual(sorted(codes), [0, 2])
                    # The second may have come first, or have replaced a finished dataset.
                    replaced = "--seed" in second and (codes[0] != 0 or "--overwrite" in second and codes[1] == 0)
                    if second == ("--shard", "2/2"):
                        self.assertEqual(codes, (0, 0))
                    elif first:
                        self.succeeds("render", name, *(other if replaced else ()))
                    self.assert_whole(wholes[replaced])

    def test_merges(self):
        merge = ("merge", "part1", "part2", "out")
        whole = self.render_whole()
        for k in (1, 2):
            self.assert_renders("--shard", f"{k}/2", "--out", f"part{k}")
        for second in (merge, RENDER):
            with self.subTest(second=second):
                self.pair(merge, second, 0.005)
                self.assert_renders()
                self.assert_whole(whole)


class HeldFolder(Sandbox):
    """The first run is halted, so that the second comes while it is at work."""
    FILES = {**TwoRuns.FILES, "path.csv": path_csv(600)}

    def halted(self, *arguments):
        process = self.start("render", *arguments)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.wait_for(lambda: [f for f in self.out.rglob("fls/meta/*.json") if "variant_0001" not in f.parts], process)
        process.send_signal(signal.SIGSTOP)
        # The signal is delivered later; this returns when every thread has stopped.
        os.waitid(os.P_PID, process.pid, os.WSTOPPED | os.WNOWAIT)
        return process

    def assert_seconds_are_refused(self, first, *seconds, meanwhile=()):
        """Commands while `first` is halted, which then goes on to its end; `meanwhile` is one that is not refused."""
        for command in seconds:
            with self.subTest(command=command):
                before = digest(self.out)
                # Another mission is refused without a look at who is at work.
                other = "--seed" in command and "--overwrite" not in command or "out/variant_0000" in command
                self.assert_refused(self.run_sonarsim(*command), "out", "of another mission" if other else SECOND_RUN)
                self.assertEqual(digest(self.out), before)
        if meanwhile:
            self.succeeds(*meanwhile)
        first.send_signal(signal.SIGCONT)
        _, stderr = first.communicate(timeout=120)
        self.assertEqual(first.returncode, 0, stderr)
        self.succeeds("verify", "out")

    def test_a_whole_run(self):
        self.assert_renders("--out", "part")
        self.assert_seconds_are_refused(
            self.halted("mission.yaml"), RENDER, (*RENDER, "--seed", "9"), (*RENDER, "--seed", "9", "--overwrite"),
            (*RENDER, "--shard", "1/2"), ("merge", "part", "out"))

    def test_a_shard(self):
        self.assert_seconds_are_refused(
            self.halted("mission.yaml", "--shard", "1/2"), RENDER, (*RENDER, "--overwrite"), (*RENDER, "--shard", "1/2"),
            (*RENDER, "--shard", "1/3"), meanwhile=(*RENDER, "--shard", "2/2"))

    def test_variants(self):
        self.assert_seconds_are_refused(
            self.halted("variants.yaml"), ("render", "variants.yaml"), ("render", "variants.yaml", "--seed", "9", "--overwrite"),
            ("render", "mission.yaml", "--out", "out/variant_0000"))


class Disks(Sandbox):
    def on_disk(self, mode, *arguments, code=0):
        return self.run_sonarsim(*arguments, code=code, env=with_disk(self, mode))

    def test_a_disk_without_locks(self):
        self.write("variants.yaml", MISSION + VARIED)
        self.assert_renders("--out", "part")
        for arguments in (RENDER, ("render", "variants.yaml"), ("merge", "part", "out")):
            with self.subTest(arguments=arguments):
                shutil.rmtree(self.out, ignore_errors=True)
                result = self.on_disk("nolock", *arguments)
                warnings = [line for line in result.stderr.splitlines() if "no locks" in line]
                self.assertEqual(len(warnings), 1, result.stderr)
                self.assertIn("out: the disk", warnings[0])
                self.succeeds("verify", "out")

    def test_a_complete_dataset_on_a_read_only_disk(self):
        self.write_all({"mission.yaml": ALL_FILES, "variants.yaml": ALL_FILES + "variants: 2\n"})
        for name in ("variants.yaml", "mission.yaml"):
            shutil.rmtree(self.out, ignore_errors=True)
            self.succeeds("render", name)
            before = digest(self.out)
            for more in ((), ("--shard", "1/2")):
                result = self.on_disk("readonly", "render", name, *more)
                self.assertEqual(digest(self.out), before)
                self.assertIn("complete; ", result.stderr)
        (self.out / "sounder/echogram.npy").unlink()
        result = self.on_disk("readonly", "render", "mission.yaml", code=1)
        self.assertIn("Read-only file system", result.stderr)
