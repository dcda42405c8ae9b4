"""The command `sonarsim` of the wheel: commands in Python run here, the others in the program of the package."""
import os
import pathlib
import runpy
import sys

IN_PYTHON = ("export", "gallery", "compare", "calibrate", "import-holoocean", "import-poses")


def main():
    name = sys.argv[1] if len(sys.argv) > 1 else ""
    if name not in IN_PYTHON:
        program = pathlib.Path(__file__).with_name("bin") / "sonarsim"
        if not program.exists():
            sys.exit("sonarsim: this package comes without the program; it is that of the wheel alone")
        os.execv(program, ["sonarsim", *sys.argv[1:]])
    del sys.argv[1]
    runpy.run_module(f"sonarsim.{name.replace('-', '_')}", run_name="__main__", alter_sys=True)


if __name__ == "__main__":
    main()
