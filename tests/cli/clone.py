"""A copy of the repository."""
import pathlib
import shutil
import subprocess
import tempfile
import unittest

from sandbox import IN_MEMORY, ROOT, SANITIZED


class Clone(unittest.TestCase):
    """In `clone` lies what git tracks, as it stands here, and nothing else: no generated scene, no build."""

    @classmethod
    def setUpClass(cls):
        if SANITIZED:
            raise unittest.SkipTest("the sanitizers see in other tests what these commands run")
        cls.folder = pathlib.Path(cls.enterClassContext(tempfile.TemporaryDirectory(prefix="sonarsim-", dir=IN_MEMORY)))
        cls.clone = cls.folder / "clone"
        cls.clone.mkdir()
        try:
            # The checkout may belong to another user than the tests.
            listed = subprocess.run(["git", "-c", "safe.directory=*", "-C", ROOT, "ls-files", "-z"], capture_output=True,
                                    check=True, text=True).stdout
        except (OSError, subprocess.CalledProcessError) as fault:
            raise unittest.SkipTest("this is no checkout of git") from fault
        for name in listed.split("\0"):
            if name and (ROOT / name).is_file():
                (cls.clone / name).parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(ROOT / name, cls.clone / name)

    def run_script(self, name, *arguments):
        return subprocess.run([self.clone / "scripts" / name, *arguments], cwd=self.clone, text=True, capture_output=True,
                              stdin=subprocess.DEVNULL, timeout=300, check=False)
