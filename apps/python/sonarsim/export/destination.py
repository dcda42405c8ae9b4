"""The folder that an export writes: DEST.part, which gets its name when it is whole."""
import contextlib
import os
import pathlib
import shutil


@contextlib.contextmanager
def destination(dest, sources):
    """The folder to write into. It becomes DEST if no exception comes, else nothing is left."""
    dest = pathlib.Path(os.path.abspath(dest))
    for source in sources:
        if pathlib.Path(os.path.realpath(dest)).is_relative_to(os.path.realpath(source)):
            raise ValueError(f"{dest}: lies in the dataset; choose a folder outside of it")
    if dest.is_symlink() or dest.exists() and not (dest.is_dir() and not any(dest.iterdir())):
        raise ValueError(f"{dest}: holds something already; choose another folder, or remove it")
    part = dest.with_name(dest.name + ".part")
    try:
        part.mkdir(parents=True)
    except FileExistsError:
        raise ValueError(f"{part}: another export writes it, or was killed; if none is running, remove it") from None
    try:
        yield part
        os.sync()
        part.rename(dest)
    except BaseException:
        shutil.rmtree(part, ignore_errors=True)
        raise
