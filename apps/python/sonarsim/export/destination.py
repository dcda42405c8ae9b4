"""The folder that an export writes: DEST.part, which gets its name when it is whole."""
import contextlib
import fcntl
import os
import pathlib
import shutil

MARK = ".sonarsim-export"       # of an unfinished export


@contextlib.contextmanager
def destination(dest, sources):
    """The folder to write into. It becomes DEST if no exception comes, else nothing is left."""
    dest = pathlib.Path(os.path.abspath(dest))
    real = pathlib.Path(os.path.realpath(dest))
    for source in sources:
        if real.is_relative_to(os.path.realpath(source)):
            raise ValueError(f"{dest}: lies in the dataset; choose a folder outside of it")
    if dest.is_symlink() or dest.exists() and not (dest.is_dir() and not any(dest.iterdir())):
        raise ValueError(f"{dest}: holds something already; choose another folder, or remove it")
    part = dest.with_name(dest.name + ".part")
    if part.is_symlink() or part.exists() and not (part / MARK).is_file():
        raise ValueError(f"{part}: is no unfinished export; remove it, or choose another folder")
    part.mkdir(parents=True, exist_ok=True)
    with open(part / MARK, "w", encoding="ascii") as mark:
        try:
            fcntl.flock(mark, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise ValueError(f"{part}: another export is writing it") from None
        try:
            for left in part.iterdir():
                if left.name != MARK:
                    shutil.rmtree(left) if left.is_dir() and not left.is_symlink() else left.unlink()
            yield part
            (part / MARK).unlink()
            os.sync()
            part.rename(dest)
        except BaseException:
            shutil.rmtree(part, ignore_errors=True)
            raise
