"""Installs a build into a temporary folder, and builds and runs a project that uses it there. Where
scripts/package.sh has left Debian packages in the build folder, they are unpacked instead.

    python3 tests/consumer/test_install.py <build folder> <compiler>
"""
import concurrent.futures
import json
import os
import pathlib
import subprocess
import sys
import tempfile

MISSION = """\
scene: {file: SHARE/scenes/tank.glb, materials: SHARE/scenes/materials.csv}
trajectory: {file: SHARE/trajectories/tank_loop.csv}
sensors: {fls: {preset: sensors/gemini_720is.yaml}}
"""


def run(*command, **options):
    result = subprocess.run([str(word) for word in command], capture_output=True, text=True, **options)
    assert result.returncode == 0, f"{command}\n{result.stdout}{result.stderr}"
    return result.stdout


def render_all(program, share, folder):
    """A ping of every mission of the package, as a user who cannot write to the package's folder."""
    def render(mission):
        # Without files the error is not measured, which takes longer than the pings.
        words = ("--shard", "1/1000", "--no-files", "--json")
        assert json.loads(run(program, "render", mission, *words, cwd=folder))["pings"], mission

    list_files = ("ls", "-lR", "--time-style=full-iso", share)
    before = run(*list_files)
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        assert len(list(pool.map(render, (share / "configs").glob("*.yaml")))) > 30
    assert run(*list_files) == before, "a render wrote into the folder of the package"


def main(build, compiler):
    consumer = pathlib.Path(__file__).resolve().parent
    with tempfile.TemporaryDirectory() as folder:
        prefix, own = pathlib.Path(folder, "usr"), pathlib.Path(folder, "build")
        packages = list(pathlib.Path(build).glob("*.deb"))
        for package in packages:
            run("dpkg-deb", "-x", package, folder)
        if not packages:
            run("cmake", "--install", build, "--prefix", prefix)
        for name in ("bin/sonarsim", "share/doc/sonarsim/README.md", "share/doc/sonarsim/docs/model.md",
                     "share/sonarsim/scenes/tank.glb", *(["share/man/man1/sonarsim.1.gz"] if packages else []),
                     "share/sonarsim/scripts/slurm/render.sh", "lib/sonarsim/libsonarsim_meshes.so",
                     *(f"lib/python3/dist-packages/sonarsim/{own}" for own in (
                         "__init__.py", "_sonarsim.pyi", "data.py", "data.pyi", "mission.py", "py.typed", "torch.py"))):
            assert (prefix / name).exists(), f"not installed: {name}"
        assert folder in run("/usr/bin/python3", "-Bc", "import sonarsim, sonarsim.data; print(sonarsim._sonarsim)",
                             env={**os.environ, "PYTHONPATH": prefix / "lib/python3/dist-packages"})
        scenario = pathlib.Path(folder, "scenario.json")
        scenario.write_text('{"agents": [{"sensors": [{"sensor_type": "ImagingSonar"}]}]}')
        assert "kind: \"imaging\"" in run(prefix / "bin/sonarsim", "import-holoocean", scenario)
        share = prefix / "share/sonarsim"
        run(prefix / "bin/sonarsim", "render", share / "configs/tank_imaging.yaml", "--set", "trajectory.rate_hz=0.2", cwd=folder)
        assert pathlib.Path(folder, "out/tank_imaging/SHA256SUMS").exists()
        render_all(prefix / "bin/sonarsim", share, folder)
        # It finds the instruments of the package.
        pathlib.Path(folder, "mission.yaml").write_text(MISSION.replace("SHARE", str(share)))
        run(prefix / "bin/sonarsim", "validate", "mission.yaml", cwd=folder)
        # It finds its module wherever the folders lie.
        copy = pathlib.Path(folder, "copy")
        run("cp", "-r", share, copy)
        run("scripts/make_scenes.py", "lifeboat", cwd=copy)
        assert "rails" in run(prefix / "bin/sonarsim", "inspect", copy / "scenes/generated/lifeboat.glb")
        run("cmake", "-S", consumer, "-B", own, f"-DCMAKE_PREFIX_PATH={prefix}", f"-DCMAKE_CXX_COMPILER={compiler}",
            "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON")
        # The project itself asks for no standard and no instruction set.
        command = (own / "compile_commands.json").read_text()
        for option in ("-std=gnu++20", "-march=x86-64-v3", "-DEIGEN_MPL2_ONLY", "-DEIGEN_FAST_MATH=0"):
            assert option in command, f"{option} is missing in {command}"
        assert "-Wall" not in command, command
        run("cmake", "--build", own, "--parallel", "2")
        range_m, name, occupied = run(own / "pings", share / "configs/tank_imaging.yaml").split()
        # 512 bins from 0.1 to 10 m: the wall at 5 m lies in bin 253, which begins at 4.992 m.
        assert 5.0 - 9.9 / 512 < float(range_m) <= 5.0, range_m
        assert name == "fls" and 1000 < int(occupied) < 512 * 256, (name, occupied)
        print(f"installed, found, built and run: the wall echoes from {range_m} m on")


if __name__ == "__main__":
    main(*sys.argv[1:])
