"""The folder that an export writes: DEST.part, which gets its name when it is whole."""
import contextlib
import os
import pathlib

from ..command import new_folder


@contextlib.contextmanager
def destination(dest, sources):
    """The folder to write into. It becomes DEST if no exception comes, else nothing is left."""
    dest = pathlib.Path(os.path.abspath(dest))
    for source in sources:
        if pathlib.Path(os.path.realpath(dest)).is_relative_to(os.path.realpath(source)):
            raise ValueError(f"{dest}: lies in the dataset; choose a folder outside of it")
    if dest.is_symlink() or dest.exists() and not (dest.is_dir() and not any(dest.iterdir())):
        raise ValueError(f"{dest}: holds something already; choose another folder, or remove it")
    with new_folder(dest) as part:
        yield part
        os.sync()
