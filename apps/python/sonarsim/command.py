"""What the commands of the package share: missing packages, exit codes, and files that are whole or not there."""
import contextlib
import importlib.util
import os
import pathlib
import shutil
import sys
import traceback

PACKAGES = {"numpy": "python3-numpy", "PIL": "python3-pil", "scipy": "python3-scipy", "yaml": "python3-yaml"}


def need(command, *modules):
    """Ends the program with exit code 2 and one sentence unless these modules are installed. Call it before imports."""
    missing = [PACKAGES.get(module, module) for module in modules if importlib.util.find_spec(module) is None]
    if missing:
        print(f"sonarsim {command}: install {' '.join(missing)} "
              f"(Python is {sys.executable}; SONARSIM_PYTHON names another)", file=sys.stderr)
        sys.exit(2)


def run(command, work, *arguments):
    """The exit code of a command: 0; with one sentence 2 for a mistake, 1 for what cannot be read or written."""
    try:
        work(*arguments)
        return 0
    except ValueError as fault:
        code, text = 2, str(fault)
    except MemoryError:
        code, text = 1, "out of memory"
    except (ArithmeticError, AttributeError, LookupError, TypeError, RuntimeError) as fault:
        place = traceback.extract_tb(fault.__traceback__)[-1]
        code, text = 2, ("cannot work with a value of its input; sonarsim verify says which file was changed. If none was, "
                         f"report {pathlib.Path(place.filename).name}, line {place.lineno}")
    except OSError as fault:
        # Of a copy that fails, the second name is that of the file that is written.
        code, text = 1, f"{fault.filename2 or fault.filename or 'output'}: {fault.strerror or fault}"
    print(f"sonarsim {command}: {text}", file=sys.stderr)
    return code


@contextlib.contextmanager
def naming(path):
    """Gives the path to an OSError that has none: that of a write does not say what is written."""
    try:
        yield path
    except OSError as fault:
        if fault.filename is not None:
            raise
        raise OSError(fault.errno, fault.strerror or str(fault), str(path)) from fault


@contextlib.contextmanager
def replaced(path):
    """A path to write to, whose file becomes that of `path` if no exception comes; else nothing is left."""
    path = pathlib.Path(path)
    part, is_new = path.with_name(f".{path.name}.{os.getpid()}"), not path.parent.exists()
    if path.exists() and not path.is_file():
        raise ValueError(f"{path}: is not a regular file, so it cannot be replaced")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        yield part
        part.replace(path)
    except BaseException as fault:
        with contextlib.suppress(OSError):
            part.unlink(missing_ok=True)
            if is_new:
                path.parent.rmdir()
        if isinstance(fault, OSError):
            raise OSError(fault.errno, fault.strerror or str(fault), str(path)) from fault
        raise


@contextlib.contextmanager
def new_folder(path):
    """A folder to fill, which becomes `path` if no exception comes; else nothing is left."""
    part = path.with_name(path.name + ".part")
    try:
        part.mkdir(parents=True)
    except FileExistsError:
        raise ValueError(f"{part}: another run writes it, or was killed; if none is running, remove it") from None
    try:
        yield part
        shutil.rmtree(path, ignore_errors=True)
        part.rename(path)
    except BaseException:
        shutil.rmtree(part, ignore_errors=True)
        raise
