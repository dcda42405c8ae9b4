#!/usr/bin/python3
"""Renders missions with several builds of sonarsim and compares every byte of their datasets.

    ./scripts/same_bytes.py [--mission FILE[,KEY=VALUE...]]... PROGRAM PROGRAM...

A program may be a command of several words. Without --mission it is tests/four_sonars.yaml, once
with each engine. In dataset.json, and so in the line of SHA256SUMS on it, `build` may differ: it says
how the program was built. Exit code 0: all alike; 1: not.
"""
import argparse
import hashlib
import json
import pathlib
import shlex
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
MISSIONS = [f"{ROOT}/tests/four_sonars.yaml,engine={engine}" for engine in ("rays", "octree", "strips")]


def content(path):
    if path.name == "SHA256SUMS":
        return b"".join(line for line in path.read_bytes().splitlines(True)
                        if not line.endswith(b"  dataset.json\n"))
    if path.name != "dataset.json":
        return path.read_bytes()
    description = json.loads(path.read_text())
    description.pop("build", None)
    return json.dumps(description).encode()


def render(program, mission, folder):
    """SHA-256 of every file that the program makes of the mission, by name within the dataset."""
    file, *settings = mission.split(",")
    arguments = [word for setting in settings for word in ("--set", setting)]
    subprocess.run([*shlex.split(program), "render", file, "--quiet", *arguments,
                    "--set", f"output.folder={folder}"], check=True)
    files = {str(path.relative_to(folder)): hashlib.sha256(content(path)).hexdigest()
             for path in sorted(folder.rglob("*")) if path.is_file()}
    shutil.rmtree(folder)
    return files


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--mission", action="append", metavar="FILE[,KEY=VALUE...]")
    parser.add_argument("--folder", type=pathlib.Path, help="where to render, for a moment")
    parser.add_argument("programs", nargs="+", metavar="PROGRAM")
    options = parser.parse_args()
    failed = False
    with tempfile.TemporaryDirectory(prefix="same_bytes-", dir=options.folder) as temporary:
        folder = pathlib.Path(temporary) / "dataset"
        for mission in options.mission or MISSIONS:
            expected = render(options.programs[0], mission, folder)
            for program in options.programs[1:]:
                found = render(program, mission, folder)
                differing = sorted(name for name in expected.keys() | found.keys()
                                   if expected.get(name) != found.get(name))
                failed |= bool(differing)
                verdict = f"{len(differing)} of {len(expected)} files differ" if differing \
                    else f"{len(expected)} files, all alike"
                print(f"{mission}: {options.programs[0]} and {program}: {verdict}", flush=True)
                for name in differing[:20]:
                    print(f"    {name}")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
