"""Checks the examples of docs/development.md: what one adds to lib, and how few files it touches.

    python3 tests/examples/check_examples.py <root of the repository> <compiler> <include folders>

An example is a folder with the files that it adds to lib and wiring.patch, the lines that it changes
in lib. Its new and changed sources must compile, over the rest of lib. The tests of
examples_test.cpp run what is new.
"""
import pathlib
import re
import shutil
import sys
import tempfile

sys.path.append(str(pathlib.Path(__file__).resolve().parents[1] / "consumer"))
from test_install import run

# The example, the most files that it may touch in lib, and the folder of its own that is not counted.
EXAMPLES = (("add_sonar", 6, None), ("add_stage", 5, None), ("add_echo_model", 4, "simulate/lambert"), ("add_wake", 7, None))


def overlay_of(root, example, folder):
    """The files of lib that an example adds or changes, in `folder`; by their paths."""
    def copy(source, name):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(source, folder / name)

    patch = example / "wiring.patch"
    changed = re.findall(r"^\+\+\+ b/(\S+)", patch.read_text(), re.MULTILINE)
    for name in changed:
        copy(root / name, name)
    run("git", "apply", patch, cwd=folder)
    added = [path.relative_to(example).as_posix() for path in (example / "lib").rglob("*") if path.is_file()]
    for name in added:
        assert not (root / name).exists(), f"{example.name} adds {name}, which lib has"
        copy(example / name, name)
    return sorted(changed + added)


def check(root, name, most, own, compiler, includes):
    with tempfile.TemporaryDirectory() as temporary:
        folder = pathlib.Path(temporary)
        files = overlay_of(root, root / "tests/examples" / name, folder)
        counted = [file for file in files if not file.startswith(f"lib/{own}/")]
        print(f"{name}: {len(counted)} files in lib, at most {most}:", *files)
        assert len(counted) <= most, f"{name} touches {len(counted)} files, more than {most}"
        flags = [f"-I{folder}/lib", f"-I{root}/lib", *(f"-idirafter{path}" for path in includes)]
        # All in one unit, as the joined build has them: most of the time goes into the headers of lib.
        unit = folder / "unit.cpp"
        unit.write_text("".join(f'#include "{file.removeprefix("lib/")}"\n' for file in
                                sorted(files, key=lambda file: file.endswith(".cpp"))))
        run(compiler, "-std=gnu++20", "-march=x86-64-v3", "-fsyntax-only", "-Wall", "-Wextra", "-Werror", *flags, unit)


if __name__ == "__main__":
    if shutil.which("git") is None:
        print("git is not here, which applies the patches")
        sys.exit(77)
    for name, most, own in EXAMPLES:
        check(pathlib.Path(sys.argv[1]), name, most, own, sys.argv[2], [path for path in sys.argv[3].split(":") if path])
