#!/usr/bin/env python3
"""Writes the example scenes as .glb files: ./scripts/make_scenes.py [name ...] [--out DIR]

tank      a concrete tank, 8 x 6 x 3 m, with a few objects (the default; scenes/tank.glb)
seafloor  200 x 200 m of sand and silt with a hundred boulders, a million triangles
wreck     a broken hull with ribs on a rippled bottom, 60 x 60 m
close_bottom  a rough bottom half a metre below a sonar; besides it close_bottom_surface and
          close_bottom_flocs, which move
lifeboat  a hull with rails, ropes and gear, of one material, for comparisons of the engines
minefield a rippled sandy bottom with rocks, 40 x 40 m, and besides it the objects that a mission
          may place on it: cylinder_mine, cone_mine, tyre, drum, block, rock

The same command writes the same bytes on every machine.
"""
import argparse
import pathlib
import sys

from scenes import close_bottom, lifeboat, minefield, seafloor, tank, wreck
from scenes.glb import write_glb

ROOT = pathlib.Path(__file__).resolve().parent.parent


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="name", help="one of those above")
    parser.add_argument("--out", type=pathlib.Path, metavar="DIR",
                        help="default: scenes/ for the tank, scenes/generated/ for the others")
    parser.add_argument("--cells", type=int, default=708, metavar="N",
                        help="the sea floor has N x N cells of two triangles (default 708)")
    parser.add_argument("--area", type=float, default=200.0, metavar="M",
                        help="the sea floor is M x M metres (default 200)")
    parser.add_argument("--quarterings", type=int, default=0, metavar="N",
                        help="every triangle of the lifeboat is cut into four, N times (default 0)")
    arguments = parser.parse_args()
    if not 1 <= arguments.cells <= 10000 or not 1.0 <= arguments.area <= 1e5:
        parser.error("--cells takes 1 to 10000, --area 1 to 100000 metres")
    if not 0 <= arguments.quarterings <= 4:
        parser.error("--quarterings takes 0 to 4")

    builders = {
        "tank": tank.build,
        "seafloor": lambda: seafloor.build(arguments.cells, arguments.area),
        "wreck": wreck.build,
        "close_bottom": close_bottom.build,
        "lifeboat": lambda: lifeboat.build(arguments.quarterings),
        "minefield": minefield.bottom,
    }
    for name in arguments.names or ["tank"]:
        if name not in builders:
            parser.error(f"no scene '{name}'; there are {', '.join(builders)}")
    for name in arguments.names or ["tank"]:
        folder = arguments.out or ROOT / "scenes" / ("" if name == "tank" else "generated")
        folder.mkdir(parents=True, exist_ok=True)
        files = {name: builders[name]}
        if name == "minefield":
            files.update(minefield.OBJECTS)
        if name == "close_bottom":
            files.update(close_bottom.OBJECTS)
        for file, build in files.items():
            parts = build()
            size = write_glb(folder / f"{file}.glb", parts)
            triangles = sum(part.triangles() for part in parts)
            print(f"{folder / file}.glb: {len(parts)} objects, {triangles} triangles, {size} bytes")
    return 0


if __name__ == "__main__":
    sys.exit(main())
