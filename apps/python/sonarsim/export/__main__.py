"""The command `sonarsim export`."""
import argparse
import concurrent.futures
import itertools
import multiprocessing
import os
import signal
import sys
from concurrent.futures.process import BrokenProcessPool

from ..command import need, run

need("export", "numpy", "PIL")

from ..data import DataError
from . import clouds, formats, holoocean, robot, split
from .pieces import frames_of, part_of, prepare
from .source import Source, named_datasets, require_known
from .statistics import Statistics

BATCH = 512     # pictures whose pieces are in memory at a time
# Formats of pings, which need no objects, and the writer of each.
OF_PINGS = {"points": clouds.write, "holoocean": holoocean.write, "mcap": robot.write}
# The formats that take an option, if it is not those of pictures.
FORMATS_OF = dict.fromkeys(("format", "folders", "dest", "sensor"), [*formats.KINDS, *OF_PINGS]) | {
    "whole": ["points"], "clean": ["holoocean"], "mesh": ["holoocean"], "licence": ["hf"], "crop": ["crops"],
    "negatives": ["crops"], "faint": ["coco", "masks"], "polygons": ["coco", "yolo"], "oriented": ["yolo"]}


class Parser(argparse.ArgumentParser):
    def error(self, message):
        self.exit(2, f"sonarsim export: {message}; --help lists the options\n")


# The least and largest values of numbers.
LIMITS = {"min_pixels": (1, 1 << 30), "min_visible_share": (0, 1), "min_contrast_db": (0, 100), "gap": (0, 1 << 30),
          "min_grey": (0, 255), "rounds": (1, 1 << 20), "overlap": (0, 65536), "least_share": (0, 1), "negatives": (0, 1000)}


def tile(text):
    """(width, height) of a text like 512 or 512x256."""
    sides = [int(side) if side.isdecimal() else 0 for side in text.split("x")]
    if len(sides) > 2 or not 16 <= min(sides) <= max(sides) <= 65536:
        raise argparse.ArgumentTypeError(f"{text!r} must be N or WIDTHxHEIGHT, of 16 to 65536 pixels each")
    return sides[0], sides[-1]


def parse(arguments):
    parser = Parser(prog="sonarsim export", allow_abbrev=False, description="Writes what trainers and robots read.")
    add = parser.add_argument
    add("folders", nargs="+", metavar="OUT... DEST", help="datasets or folders of variants, then the folder to write")
    add("--format", required=True, choices=FORMATS_OF["format"], help="the layout")
    add("--box", choices=("object", "shadow", "both"), default="object", help="what boxes are drawn around")
    add("--polygons", action="store_true", help="outlines instead of boxes (yolo) or runs (coco)")
    add("--oriented", action="store_true", help="of yolo: the least rectangle around the mask instead of the box")
    add("--licence", default="unknown", metavar="ID", help="of hf: the licence of the card, as in cc-by-4.0")
    add("--whole", action="store_true", help="of points: one cloud of all pings of a sonar")
    add("--clean", action="store_true", help="of holoocean: images without noise")
    add("--mesh", metavar="FILE", help="of holoocean: the .glb or heightmap of the scene, written with z up")
    add("--bins", action="store_true", help="of imaging and profiling sonars the picture of the bins, not the fan")
    add("--image", choices=("shown", "raw"), default="shown", help="pictures for people, or raw values")
    add("--sensor", action="append", default=[], metavar="NAME", help="only this sensor; may be repeated")
    add("--without", action="append", default=[], metavar="CLASS", help="a class that is not an object; may be repeated")
    add("--min-pixels", type=int, default=16, metavar="N", help="fewer make an object faint")
    add("--min-visible-share", type=float, default=0.1, metavar="X", help="less makes it faint")
    add("--min-contrast-db", type=float, default=1.0, metavar="DB", help="less, of object and shadow, makes it faint")
    add("--min-grey", type=float, default=12, metavar="N", help="what stands out by fewer greys is faint; 0: nothing is")
    add("--faint", choices=("omit", "crowd"), default="omit", help="faint objects are left out, or marked as crowd")
    add("--split", metavar="train=A,val=B,test=C", help="parts of the trajectory, or of the variants")
    add("--gap", type=int, metavar="N", help="poses left out at each border (default: a tenth of all, at most 10)")
    add("--rounds", type=int, default=1, metavar="N", help="repetitions of the parts")
    add("--tile", type=tile, metavar="N|WxH", help="cut waterfalls, echograms and sweeps into tiles")
    add("--overlap", type=int, default=0, metavar="N", help="pixels that tiles share")
    add("--least-share", type=float, default=0.2, metavar="X", help="pieces with less of their object are left out")
    add("--pixel-m", type=float, metavar="M", help="of crops: the side of a pixel in metres")
    add("--crop", type=tile, default=(64, 64), metavar="N|WxH", help="size of crops")
    add("--negatives", type=int, default=1, metavar="N", help="crops of each picture without an object")
    add("--link", action="store_true", help="hard links to pictures that need no change")
    options = parser.parse_intermixed_args(arguments)
    *options.folders, options.dest = options.folders
    if not options.folders:
        parser.error("name a dataset, then the folder to write")
    for key, (low, high) in LIMITS.items():
        if getattr(options, key) is not None and not low <= getattr(options, key) <= high:
            parser.error(f"--{key.replace('_', '-')} must be a number from {low} to {high}")
    if (options.format == "crops") != (options.pixel_m is not None) or options.pixel_m is not None and (
            not 1e-4 <= options.pixel_m <= 100 or options.tile):
        parser.error("--format crops needs --pixel-m, the side of a pixel from 0.0001 to 100 m, and no --tile; "
                     "other formats take no --pixel-m")
    for key, value in vars(options).items():
        if value != parser.get_default(key) and options.format not in FORMATS_OF.get(key, formats.KINDS):
            parser.error(f"--format {options.format} takes no --{key.replace('_', '-')}")
    outlines = options.polygons or options.oriented
    for is_wrong, text in (
            (options.oriented and options.polygons, "--oriented takes no --polygons"),
            (outlines and options.format == "yolo" and options.box != "object", "--box: the outlines of yolo are the object's"),
            (not options.split and (options.gap is not None or options.rounds != 1), "--gap and --rounds take --split"),
            ((options.overlap or options.least_share != 0.2) and not options.tile, "--overlap and --least-share take --tile"),
            (options.tile and options.overlap >= min(options.tile), "--overlap must be less than the sides of a tile")):
        if is_wrong:
            parser.error(text)
    return options


def prepare_all(pictures, numbers, options):
    """Yields what prepare() makes of each picture, in order; processes share the work."""
    context = multiprocessing.get_context("fork")
    with concurrent.futures.ProcessPoolExecutor(os.cpu_count(), context, initializer=signal.signal,
                                                initargs=(signal.SIGINT, signal.SIG_IGN)) as pool:
        try:
            for begin in range(0, len(pictures), BATCH):
                some = pictures[begin:begin + BATCH]
                yield from pool.map(prepare, some, [numbers[one.dataset] for one in some], [options] * len(some),
                                    chunksize=16)
        except BrokenProcessPool as fault:      # killed, mostly for its memory
            raise MemoryError from fault
        finally:
            pool.shutdown(cancel_futures=True)


def export_pings(options):
    """Writes a format for the fans of each dataset."""
    found = named_datasets(options.folders)
    require_known(options.sensor, {name: 0 for one in found.values() for name in one.sensors}, "--sensor")
    lines = [f"{options.dest}: {options.format}"]
    with formats.destination(options.dest, options.folders) as folder:
        for name, dataset in found.items():
            sensors = [one for one in dataset.sensors.values() if one.kind in ("imaging", "profiling") and len(one)
                       and (not options.sensor or one.name in options.sensor)]
            if not sensors:
                raise DataError(f"{dataset.folder}: has no ping of an imaging or profiling sonar to export")
            (folder / name).mkdir(exist_ok=True)
            written = OF_PINGS[options.format](folder / name, dataset, sensors, options)
            lines += [f"{name}{name and ': '}{line}" for line in written]
    print("\n".join(lines))


def export(options):
    if options.format in OF_PINGS:
        return export_pings(options)
    options.split = split.parse(options.split) if options.split else None
    source = Source(options.folders, options)
    described = [dataset.description for dataset in source.datasets]
    seeds = {one["seed"] for one in described}   # each variant has its own
    info = {"description": described[0]["mission"], "version": described[0]["program_version"],
            "seed": seeds.pop() if len(seeds) == 1 else None}
    statistics = Statistics(source.classes)
    if options.format == "masks" and (len(source.classes) > 255 or "background" in source.classes):
        raise ValueError("--format masks: holds at most 255 classes, none of them 'background'; leave some out (--without)")
    with formats.destination(options.dest, options.folders) as folder:
        layout = formats.KINDS[options.format](folder, source.classes, info, options)
        for pieces, left_out in prepare_all(source.pictures, source.numbers, options):
            for what, count in left_out.items():
                statistics.left_out[what] += count
            for piece in pieces:
                layout.add(piece)
                statistics.add(piece)
        for part in options.split or ["train"]:
            if part not in statistics.parts:
                raise ValueError(no_pictures(part, source.pictures, options))
        layout.finish()
        formats.write_json(folder / "statistics.json", statistics.as_json())
    return print(f"{options.dest}: {options.format}\n{statistics.text()}")


def no_pictures(part, pictures, options):
    """Why a part of the split gets none, with the tile, if there is one, that gives each part some."""
    picture = max(pictures, key=lambda one: len(set(one.parts)))
    runs = [(shown, len(list(run))) for shown, run in itertools.groupby(picture.parts)]
    along = min(max((length for shown, length in runs if shown == one), default=0) for one in options.split or [part])
    sides = (picture.width, along // 2) if picture.rows_are_pings else (along // 2, picture.height)
    options.tile = [max(16, side) for side in sides]
    if not any(shown == part for one in pictures for shown in one.parts):
        return f"--split: no variant or ping is left for {part!r}; give it a larger share, render more, or leave it out"
    text = f"--split: no picture is left for {part!r}: {picture.path} "
    if picture.kind == "strip" and options.overlap < min(options.tile) and set(options.split or ()) <= {
            part_of(picture, frame) for frame in frames_of(picture, options)}:
        return f"{text}is {picture.width} x {picture.height} pixels; cut it with --tile {options.tile[0]}x{options.tile[1]}"
    return f"{text}shows pings of other parts; take a smaller --gap, fewer --rounds or more variants, or leave it out"


def main(arguments):
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, lambda number, _: sys.exit(128 + number))
    return run("export", export, parse(arguments))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
