"""Builds the wheel, installs it into a folder and uses it there: module, program and commands in Python.

    python3 tests/consumer/test_wheel.py <root of the repository>
"""
import os
import pathlib
import sys
import tempfile

from test_install import MISSION, run

SYSTEM = ("linux-vdso", "/lib64/ld-linux", "libc.so", "libm.so", "libstdc++", "libgcc_s")
USE = """
import sonarsim
mission = sonarsim.open("mission.yaml", set={"trajectory.rate_hz": 0.2})
print(sonarsim.__version__, mission.ping(0, sensor="fls").image.shape)
"""


def main(root):
    pip = (sys.executable, "-m", "pip")
    with tempfile.TemporaryDirectory() as name:
        folder, site = pathlib.Path(name), pathlib.Path(name, "site")
        run(*pip, "wheel", root, "--no-deps", "--no-index", "-w", folder)
        (wheel,) = folder.glob("sonarsim-*.whl")
        run(*pip, "install", "--no-deps", "--no-index", "--target", site, wheel)
        package = site / "sonarsim"
        for file in (package / "bin/sonarsim", *package.rglob("*.so")):
            for line in run("ldd", file).splitlines():
                assert f"{package}/" in line or line.strip().startswith(SYSTEM), f"{file}: {line}"
        env = {**os.environ, "PYTHONPATH": site, "PYTHONSAFEPATH": "1"}
        (folder / "mission.yaml").write_text(MISSION.replace("SHARE", os.path.realpath(root)) + "output: {labels: [objects]}\n")
        print(run(sys.executable, "-Bc", USE, cwd=folder, env=env).strip())
        sonarsim = site / "bin/sonarsim"
        run(sonarsim, "render", "mission.yaml", "--out", "out", "--set", "trajectory.rate_hz=0.2", cwd=folder, env=env)
        run(sonarsim, "export", "out", "yolo", "--format", "yolo", cwd=folder, env=env)
        assert list((folder / "yolo/images").rglob("*.png")), "no images were exported"
        print(f"{wheel.name}, {wheel.stat().st_size // 1000} kB: imports, renders, exports")


if __name__ == "__main__":
    main(sys.argv[1])
