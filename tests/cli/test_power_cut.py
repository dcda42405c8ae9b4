"""The power goes off at any moment: what is not durable yet is gone, or there in part; the same
command run again comes to the same bytes as a run that nothing disturbed."""
import json
import os
import shutil
import subprocess
import sys
import unittest

from sandbox import ALL_FILES, SANITIZED, Sandbox, digest, path_csv

POWER_CUT = os.environ["POWER_CUT"]


class PowerCut(Sandbox):
    FEWEST_CALLS = 150

    def setUp(self):
        super().setUp()
        self.write("mission.yaml", ALL_FILES)
        self.write("path.csv", path_csv(8))
        self.whole = self.render_whole()

    def render_until(self, call, seed):
        """With checkpoints so often that some lie between the pings of a short run."""
        environment = dict(os.environ, LD_PRELOAD=POWER_CUT, POWER_CUT_BELOW=str(self.out), POWER_CUT_CALL=str(call),
                           POWER_CUT_SEED=str(seed), POWER_CUT_LOG=str(self.folder / "calls"))
        return self.render("-j2", "--checkpoint", "0.01", env=environment)

    def count_calls(self):
        result = self.render_until(0, 0)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(digest(self.out), self.whole)
        shutil.rmtree(self.out)
        return int((self.folder / "calls").read_text())

    def test_many_moments(self):
        calls = self.count_calls()
        # Four sonars with all their files: fewer would mean that the disk is not asked.
        self.assertGreater(calls, self.FEWEST_CALLS)
        moments = 5 if SANITIZED else 14
        survived = skipped = 0
        for k in range(moments):
            shutil.rmtree(self.out, ignore_errors=True)
            call = 1 + (calls - 1) * k // (moments - 1)
            with self.subTest(call=call):
                cut = self.render_until(call, seed=k)
                # Checkpoints come at other times in every run: near the end there may be no such call.
                self.assertIn(cut.returncode, (0, 99), cut.stderr)
                survived += cut.returncode == 0
                result = self.assert_renders("-j1", "--json")
                self.assertEqual(digest(self.out), self.whole, result.stderr)
                skipped += json.loads(result.stdout)["skipped"]
        self.assertLessEqual(survived, 3)
        if not SANITIZED:  # a few moments of a slow program may all lie before its first checkpoint
            self.assertGreater(skipped, 0, "what a checkpoint holds is not rendered again")

    def test_cut_again_and_again(self):
        """A resume may be cut as well."""
        calls = self.count_calls()
        for k in range(3 if SANITIZED else 8):
            self.render_until(2 + calls * (k % 4 + 1) // 5, seed=100 + k)
        self.assert_renders()
        self.assertEqual(digest(self.out), self.whole)

    def test_a_disk_that_forgets_would_be_noticed(self):
        """The library does take away what is not durable: files written by a program that never
        asks for it are gone."""
        self.out.mkdir()
        target = self.out / "file"
        program = (f"import os; f = os.open({str(target)!r}, os.O_WRONLY | os.O_CREAT); "
                   "os.write(f, b'x' * 100); os.close(f); "
                   f"os.open({str(self.out / 'last')!r}, os.O_WRONLY | os.O_CREAT)")
        lost = 0
        for seed in range(12):
            target.unlink(missing_ok=True)
            environment = dict(os.environ, LD_PRELOAD=POWER_CUT, POWER_CUT_BELOW=str(self.out),
                               POWER_CUT_CALL="3", POWER_CUT_SEED=str(seed))
            code = subprocess.run([sys.executable, "-SIc", program], env=environment,
                                  check=False).returncode
            self.assertEqual(code, 99)
            lost += not target.exists() or target.stat().st_size < 100
        self.assertGreater(lost, 4)


if __name__ == "__main__":
    unittest.main()
