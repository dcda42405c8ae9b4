"""Builds the wheel of the Python package: `pip wheel .` calls this file (PEP 517), which needs no other package.

The wheel holds the package with its compiled module, the program, the presets and the shared libraries that the
machine of a user may lack. OpenImageIO has a hundred of them: heightmaps and maps take Debian's package.
SONARSIM_FOLDER=build-release takes the compiled files of test.sh.
"""
import base64
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sysconfig
import tempfile
import tomllib
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
# Part of every Linux with Python; libstdc++ and libgcc_s of Debian 12 are older than those of most.
OF_THE_SYSTEM = re.compile(r"^(ld-linux|libc\.|libm\.|libdl\.|librt\.|libpthread\.|libstdc\+\+|libgcc_s)")


def run(*command, **options):
    return subprocess.run([str(word) for word in command], check=True, **options)


def libraries_of(files):
    """The shared libraries that files load, and those that these load, by name."""
    lines = run("ldd", *files, stdout=subprocess.PIPE, text=True).stdout.splitlines()
    found = dict(re.findall(r"(\S+) => (/\S+)", "\n".join(lines)))
    return {name: path for name, path in found.items() if not OF_THE_SYSTEM.match(name)}


def fill(folder):
    """The package in a folder, with bin, lib and share of the program below it."""
    build = ROOT / os.environ.get("SONARSIM_FOLDER", "build-wheel")
    preset = "release" if build.name == "build-release" else "program"
    # An RPATH, unlike a RUNPATH, also holds for the libraries of libraries.
    link = "-Wl,--disable-new-dtags"
    run("cmake", "--preset", preset, "-B", build, "-DSONARSIM_TESTS=OFF", "-DSONARSIM_PYTHON=ON",
        "-DSONARSIM_JOINED=ON",
        "-DCMAKE_INSTALL_RPATH=$ORIGIN/lib:$ORIGIN/../lib:$ORIGIN/..", f"-DCMAKE_EXE_LINKER_FLAGS={link}",
        f"-DCMAKE_MODULE_LINKER_FLAGS={link}", cwd=ROOT)
    run("cmake", "--build", build)
    with tempfile.TemporaryDirectory() as name:
        prefix = pathlib.Path(name)
        for component in ("program", "python"):
            run("cmake", "--install", build, "--prefix", prefix, "--component", component)
        shutil.copytree(prefix / "lib/sonarsim/python/sonarsim", folder)
        shutil.copytree(prefix / "bin", folder / "bin")
        shutil.copytree(prefix / "lib/sonarsim", folder / "lib/sonarsim", ignore=shutil.ignore_patterns("python"))
        shutil.copytree(prefix / "share/sonarsim/configs", folder / "share/sonarsim/configs")
    (folder / "lib/sonarsim/libsonarsim_images.so").unlink(missing_ok=True)
    for library, path in libraries_of([folder / "bin/sonarsim", *folder.rglob("*.so")]).items():
        shutil.copy(path, folder / "lib" / library)


def metadata_of(project, version):
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {version}",
             f"Summary: {project['description']}", f"Requires-Python: {project['requires-python']}",
             *(f"Requires-Dist: {name}" for name in project["dependencies"])]
    for extra, names in project["optional-dependencies"].items():
        lines += [f"Provides-Extra: {extra}", *(f'Requires-Dist: {name}; extra == "{extra}"' for name in names)]
    return "\n".join([*lines, "Description-Content-Type: text/markdown", "", (ROOT / project["readme"]).read_text()])


def described():
    """The name of the distribution with its version, the tag of its wheel, and the files of its metadata."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    version = re.search(r"project\(sonarsim VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text()).group(1)
    python = "cp" + sysconfig.get_config_var("py_version_nodot")
    tag = f"{python}-{python}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"
    script, target = next(iter(project["scripts"].items()))
    return f"sonarsim-{version}", tag, {"METADATA": metadata_of(project, version),
        "WHEEL": f"Wheel-Version: 1.0\nGenerator: sonarsim\nRoot-Is-Purelib: false\nTag: {tag}\n",
        "entry_points.txt": f"[console_scripts]\n{script} = {target}\n", "LICENSE": (ROOT / "LICENSE").read_text()}


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """The name of the folder of metadata. Without this hook, pip builds the wheel twice."""
    name, _, texts = described()
    folder = pathlib.Path(metadata_directory, f"{name}.dist-info")
    folder.mkdir()
    for file, text in texts.items():
        (folder / file).write_text(text)
    return folder.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    """The name of the wheel, in this folder."""
    name, tag, texts = described()
    info, name = f"{name}.dist-info", f"{name}-{tag}.whl"
    records = []
    with (tempfile.TemporaryDirectory() as folder,
          zipfile.ZipFile(pathlib.Path(wheel_directory, name), "w", zipfile.ZIP_DEFLATED) as wheel):
        package = pathlib.Path(folder, "sonarsim")
        fill(package)

        def add(path, data, mode):
            entry = zipfile.ZipInfo(path)
            entry.compress_type, entry.external_attr = zipfile.ZIP_DEFLATED, mode << 16
            wheel.writestr(entry, data)
            digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).decode().rstrip("=")
            records.append(f"{path},sha256={digest},{len(data)}")

        for path in sorted(path for path in package.rglob("*") if path.is_file() and path.suffix != ".pyc"):
            add(path.relative_to(folder).as_posix(), path.read_bytes(), path.stat().st_mode)
        for file, text in texts.items():
            add(f"{info}/{file}", text.encode(), 0o100644)
        wheel.writestr(f"{info}/RECORD", "\n".join([*records, f"{info}/RECORD,,", ""]))
    return name
