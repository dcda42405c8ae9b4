"""A processor that cannot run the program gets a sentence. Needs qemu-x86_64 (Debian: qemu-user)."""
import os
import shutil
import subprocess
import sys
import unittest

SONARSIM = os.environ["SONARSIM"]
QEMU = shutil.which("qemu-x86_64")


def version_on(processor):
    return subprocess.run([QEMU, "-cpu", processor, SONARSIM, "--version"], text=True,
                          capture_output=True, timeout=300)


class Processor(unittest.TestCase):
    def test_without_avx2(self):
        for processor in ("Nehalem", "IvyBridge"):
            result = version_on(processor)
            self.assertEqual((result.returncode, result.stdout), (1, ""), processor)
            self.assertIn("this processor lacks AVX2", result.stderr)
            ours = [line for line in result.stderr.splitlines() if not line.startswith("qemu")]
            self.assertEqual(len(ours), 1, result.stderr)

    def test_with_all_that_the_emulator_has(self):
        result = version_on("max")
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertTrue(result.stdout.startswith("sonarsim "), result.stdout)


if __name__ == "__main__":
    if QEMU is None or os.environ["SANITIZED"] == "1":
        print("skipped: needs qemu-x86_64 and a build without sanitizers")
        sys.exit(77)
    unittest.main()
