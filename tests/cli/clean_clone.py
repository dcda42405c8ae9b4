"""What a clone of the repository holds, copied to where it may be written to."""
import os
import pathlib
import shutil
import subprocess

ROOT = pathlib.Path(__file__).parents[2]


def clone_to(folder):
    """Copies what git tracks, as it stands here, and nothing else: no generated scene, no build.
    False where this is no checkout of git."""
    try:
        # The checkout may belong to another user than the tests.
        listed = subprocess.run(["git", "-c", "safe.directory=*", "-C", ROOT, "ls-files", "-z"],
                                capture_output=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return False
    for name in listed.decode().split("\0"):
        source = ROOT / name
        if name and source.is_file():
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(source, folder / name)
    return True


def render(clone, *arguments):
    """scripts/render.sh with the program under test: nothing is installed or built."""
    assert os.environ["SONARSIM"]
    return subprocess.run([clone / "scripts/render.sh", *arguments], cwd=clone, text=True,
                          capture_output=True, stdin=subprocess.DEVNULL, timeout=300, check=False)
