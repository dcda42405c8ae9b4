"""Installs a build into a temporary folder, and builds and runs a project that uses it there.

    python3 tests/consumer/test_install.py <build folder> <compiler>
"""
import pathlib
import subprocess
import sys
import tempfile


def run(*command):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True)
    assert result.returncode == 0, f"{command}\n{result.stdout}{result.stderr}"
    return result.stdout


def main(build, compiler):
    consumer = pathlib.Path(__file__).resolve().parent
    with tempfile.TemporaryDirectory() as folder:
        prefix, own = pathlib.Path(folder, "prefix"), pathlib.Path(folder, "build")
        run("cmake", "--install", build, "--prefix", prefix)
        for name in ("bin/sonarsim", "share/doc/sonarsim/README.md", "share/doc/sonarsim/docs/model.md",
                     "share/sonarsim/scenes/tank.glb", "share/man/man1/sonarsim.1.gz",
                     "share/bash-completion/completions/sonarsim", "share/sonarsim/mission.schema.json",
                     "share/sonarsim/scripts/sonarsim_data.py",
                     "share/sonarsim/scripts/slurm/render.sh", "lib/sonarsim/libsonarsim_meshes.so"):
            assert (prefix / name).exists(), f"not installed: {name}"
        package = prefix / "lib/python3/dist-packages/sonarsim"
        if (pathlib.Path(build) / "python/sonarsim").exists():
            for name in ("__init__.py", "_sonarsim.pyi", "data.py", "data.pyi", "py.typed", "torch.py"):
                assert (package / name).exists(), f"not installed: {name}"
            assert len(list(package.glob("_sonarsim.*.so"))) == 1, list(package.iterdir())
        run(prefix / "bin/sonarsim", "validate", prefix / "share/sonarsim/configs/tank_imaging.yaml")
        # It finds its module wherever the folders lie.
        run(sys.executable, "-B", prefix / "share/sonarsim/scripts/make_scenes.py", "anchor", "--out", folder)
        assert "shackle" in run(prefix / "bin/sonarsim", "inspect", pathlib.Path(folder, "anchor.obj"))
        run("cmake", "-S", consumer, "-B", own, f"-DCMAKE_PREFIX_PATH={prefix}",
            f"-DCMAKE_CXX_COMPILER={compiler}", "-DCMAKE_BUILD_TYPE=Release",
            "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON")
        # The project itself asks for no standard and no instruction set.
        command = (own / "compile_commands.json").read_text()
        for option in ("-std=gnu++20", "-march=x86-64-v3", "-DEIGEN_MPL2_ONLY",
                       "-DEIGEN_FAST_MATH=0"):
            assert option in command, f"{option} is missing in {command}"
        assert "-Wall" not in command, command
        run("cmake", "--build", own, "--parallel", "2")
        # 512 bins from 0.1 to 10 m: the wall at 5 m lies in bin 253, which begins at 4.992 m.
        range_m = float(run(own / "one_ping"))
        assert 5.0 - 9.9 / 512 < range_m <= 5.0, range_m
        tank = prefix / "share/sonarsim/configs/tank_imaging.yaml"
        name, occupied = run(own / "mission_ping", tank).split()
        assert name == "fls" and 1000 < int(occupied) < 512 * 256, (name, occupied)
        print(f"installed, found, built and run: the wall echoes from {range_m} m on")


if __name__ == "__main__":
    main(*sys.argv[1:])
