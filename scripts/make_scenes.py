#!/usr/bin/python3
"""Writes the example scenes as .glb files, maps as GeoTIFF and PNG:
    ./scripts/make_scenes.py [name ...] [--out DIR]

tank      a concrete tank, 8 x 6 x 3 m, with a few objects (the default; scenes/tank.glb)
seafloor  200 x 200 m of sand and silt with a hundred boulders, a million triangles
wreck     a broken hull with ribs on a rippled bottom, 60 x 60 m
close_bottom  a rough bottom half a metre below a sonar; besides it close_bottom_surface and
          close_bottom_flocs, which move
lifeboat  a hull with rails, ropes and gear, of one material, for comparisons of the engines
bathymetry  a survey's map of 55 x 50 m of sand as a GeoTIFF in UTM coordinates
sediments a map of what that ground is made of as a PNG, and backscatter, a map of decibels as a
          GeoTIFF
basin     the map of decibels of the floor of scenes/basin.obj, basin_floor.tif
stock     43 kinds of things, each in six drawn examples: stock/tyre_1.glb and so on, for
          `scatter: [{stock: tyre}]`

    ./scripts/make_scenes.py --for mission.yaml [options of sonarsim]

makes the files that the mission or the options name and that are missing, and no others.

The same command writes the same bytes on every machine.
"""
import argparse
import contextlib
import os
import pathlib
import re
import subprocess
import sys

from scenes import bathymetry, close_bottom, lifeboat, seafloor, sediments, stock, tank, wreck
from scenes.glb import write_glb

ROOT = pathlib.Path(__file__).resolve().parent.parent
GENERATED = ROOT / "scenes" / "generated"
FOREIGN = "motorbike"  # by foreign_mesh.sh, from a Debian package
# In a mission, since YAML is not in Python's library: quoted text, a comment, or plain text between the signs of lists and maps.
PIECE = re.compile(r""""(?P<double>[^"\n]*)"|'(?P<single>[^'\n]*)'|(?:^|(?<=\s))#[^\n]*|"""
                   r"""(?P<plain>(?:[^\s,\[\]{}"'#]|(?<=\S)#|[ \t](?!#))+)""", re.MULTILINE)


def builders(cells: int, area: float) -> dict:
    """The files of every scene, by name, with the function that builds each."""
    return {
        "tank": {"tank.glb": tank.build},
        "seafloor": {"seafloor.glb": lambda: seafloor.build(cells, area)}, "wreck": {"wreck.glb": wreck.build},
        "close_bottom": {"close_bottom.glb": close_bottom.build, **close_bottom.OBJECTS},
        "lifeboat": {"lifeboat.glb": lifeboat.build}, "bathymetry": {"bathymetry.tif": bathymetry.build},
        "sediments": {"sediments.png": sediments.colours, "backscatter.tif": sediments.decibels},
        "basin": {"basin_floor.tif": sediments.basin_decibels},
        "stock": {f"stock/{name}.glb": build for name, build in stock.files().items()}}


def write_parts(file: pathlib.Path, name: pathlib.PurePath, parts: list) -> str:
    """Writes the format that the ending of `name` asks for. Returns what the file holds."""
    pixel_m = {"backscatter": sediments.MOSAIC_PIXEL_M, "basin_floor": sediments.BASIN_PIXEL_M}.get(
        name.stem, bathymetry.PIXEL_M)
    writers = {".png": sediments.write_png, ".tif": lambda path, rows: bathymetry.write_geotiff(path, rows, pixel_m),
               ".glb": write_glb}
    writers[name.suffix](file, parts)
    content = (f"{len(parts)} objects, {sum(part.triangles() for part in parts)} triangles" if name.suffix == ".glb" else
               f"{len(parts[0])} x {len(parts)} pixels")
    return f"{content}, {file.stat().st_size} bytes"


def write(path: pathlib.Path, build) -> None:
    """The file gets its name once it is whole. OSError with the folder where it cannot be written."""
    part = path.with_name(f"{path.name}.{os.getpid()}.part")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        part.touch()  # a folder without rights is refused before seconds of work
        contents = write_parts(part, path, build())
        part.replace(path)
    except OSError as fault:
        raise OSError(fault.errno, f"cannot write {path.name} here: {fault.strerror or fault}", str(path.parent)) from fault
    finally:
        with contextlib.suppress(OSError):
            part.unlink()
    print(f"{path}: {contents}", flush=True)


def values_in(text: str) -> list[str]:
    """Every text of a YAML document that may be a value."""
    values = []
    for piece in PIECE.finditer(text):
        if piece["plain"] is None:
            values.append(piece["double"] or piece["single"] or "")
        else:  # "- file: a.glb": the value comes last
            values.append(re.split(r":\s+|^\s*-\s+", piece["plain"])[-1].strip())
    return values


def text_of(mission: pathlib.Path, options: list[str]) -> str:
    """A mission and the options of sonarsim as lines. OSError where the mission cannot be read."""
    return "\n".join([mission.read_text(encoding="utf-8", errors="replace"), *options])


def stock_named(mission: pathlib.Path, options: list[str], kinds, clutter: tuple) -> list[str]:
    """The kinds of the stock in lists or on lines after the word `stock`, and those of clutter if there is some."""
    text = re.sub(r"#.*", "", text_of(mission, options))
    words = re.findall(r"\w+", " ".join(re.findall(r"\bstock\b(?:[^\n\[]*\[[^\]]*\])?[^\n]*", text)))
    if re.search(r"\bclutter[\"']?\s*[:.=]", text):
        words += clutter
    return sorted(set(words) & set(kinds))


def files_named(mission: pathlib.Path, options: list[str]) -> list[pathlib.Path]:
    """Absolute paths of the .glb, .obj, .tif and .png files in a mission and in options of sonarsim, as in
    `--set scene.file=a.glb`, in their order. Relative paths start at the folder of the mission, or
    at `--paths-from`. OSError where the mission cannot be read."""
    options = [part for option in options for part in (option.split("=", 1) if option.startswith("--") else [option])]
    base = mission.resolve().parent
    if "--paths-from" in options[:-1]:
        base = pathlib.Path(options[options.index("--paths-from") + 1]).resolve()
    text = text_of(mission, [option.split("=", 1)[-1] for option in options])
    names = dict.fromkeys(value for value in values_in(text) if value.endswith((".glb", ".obj", ".tif", ".png")))
    return [pathlib.Path(os.path.normpath(base / name)) for name in names]


def make_for(mission: pathlib.Path, options: list[str], scenes: dict) -> int:
    """Makes the missing files that a mission names; 2 if no script makes one of them."""
    known = {GENERATED / file: build for files in scenes.values() for file, build in files.items()}
    known[ROOT / "scenes" / "tank.glb"] = tank.build
    missing = [path for path in files_named(mission, options)
               if not path.exists() and (path in known or path.parent == GENERATED)]
    wanted = stock_named(mission, options, stock.KINDS, stock.CLUTTER)
    missing += [path for path in (GENERATED / "stock" / f"{kind}_{k}.glb" for kind in wanted
                                  for k in range(1, stock.EXAMPLES + 1)) if not path.exists() and path not in missing]
    foreign = GENERATED / f"{FOREIGN}.glb"
    for path in missing:
        if path not in known and path != foreign:
            print(f"error: {mission} names {path}, which is not there, and no script makes it: "
                  f"scripts/make_scenes.py makes {', '.join(sorted(one.name for one in known if one.parent.name != 'stock'))}, "
                  f"and scripts/foreign_mesh.sh {foreign.name}", file=sys.stderr)
            return 2
    for path in missing:
        if path == foreign:
            if subprocess.run([ROOT / "scripts" / "foreign_mesh.sh"], check=False).returncode != 0:
                return 2
        else:
            write(path, known[path])
    return 0


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="name", help="one of those above")
    parser.add_argument("--out", type=pathlib.Path, metavar="DIR",
                        help="default: scenes/ for the tank, scenes/generated/ for the others")
    parser.add_argument("--cells", type=int, default=708, metavar="N",
                        help="the sea floor has N x N cells of two triangles (default 708)")
    parser.add_argument("--area", type=float, default=200.0, metavar="M",
                        help="the sea floor is M x M metres (default 200)")
    parser.add_argument("--for", nargs=argparse.REMAINDER, dest="mission", default=[],
                        metavar="MISSION", help="make what is missing for a mission")
    arguments = parser.parse_args()
    if not 1 <= arguments.cells <= 10000 or not 1.0 <= arguments.area <= 1e5:
        parser.error("--cells takes 1 to 10000, --area 1 to 100000 metres")

    scenes = builders(arguments.cells, arguments.area)
    for name in arguments.names:
        if name not in scenes:
            parser.error(f"no scene '{name}'; there are {', '.join(scenes)}")
    try:
        if arguments.mission:
            return make_for(pathlib.Path(arguments.mission[0]), arguments.mission[1:], scenes)
        for name in arguments.names or ["tank"]:
            folder = arguments.out or (ROOT / "scenes" if name == "tank" else GENERATED)
            for file, build in scenes[name].items():
                write(folder / file, build)
    except OSError as fault:
        cure = "" if arguments.mission or arguments.out else "; --out DIR names another folder"
        place = f"{fault.filename}: " if fault.filename else ""
        print(f"error: {place}{fault.strerror}{cure}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
