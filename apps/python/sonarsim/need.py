"""Says in one sentence which packages a command lacks."""
import importlib.util
import pathlib
import sys

PACKAGES = {"numpy": "python3-numpy", "PIL": "python3-pil", "scipy": "python3-scipy",
            "matplotlib": "python3-matplotlib", "yaml": "python3-yaml"}


def need(*modules):
    """Ends the program with exit code 2 and one sentence if one of these modules is not installed. Call it before
    they are imported."""
    missing = [PACKAGES.get(module, module) for module in modules if importlib.util.find_spec(module) is None]
    if missing:
        command = pathlib.Path(sys.argv[0]).stem.replace("_", "-")
        if command == "--main--":       # of a folder, sonarsim/gallery/__main__.py
            command = pathlib.Path(sys.argv[0]).parent.name
        print(f"sonarsim {command}: install {' '.join(missing)} "
              f"(Python is {sys.executable}; SONARSIM_PYTHON names another)", file=sys.stderr)
        sys.exit(2)
