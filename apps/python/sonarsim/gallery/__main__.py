"""sonarsim gallery OUT: writes OUT/index.html and OUT/index_files/, a page to look through a dataset."""
import argparse
import collections
import json
import os
import pathlib
import re
import shutil
import sys

from ..command import need, run

need("gallery", "numpy")

from .. import data
from ..tally import EDGES, Tally
from .dataset import PINGS_PER_CHUNK, Shown, short

PAGE = pathlib.Path(__file__).parent / "page"
SCRIPTS = ("data.js", "picture.js", "objects.js", "statistics.js", "controls.js")
MARK = b'<meta name="generator" content="sonarsim gallery">'
FILES = "index_files"
OWN_FILE = re.compile(r"index\.html|page\.(css|js)|\d+(_\d+_\d+)?\.js")


def members_of(out):
    """The datasets by their folders, what was drawn for each, and the number of variants that are missing."""
    if (out / "dataset.json").is_file():
        return {"": data.open_dataset(out)}, {}, 0
    found = {path.parent.name: data.open_dataset(path.parent) for path in sorted(out.glob("*/dataset.json"))
             if not path.parent.is_symlink()}
    if not found:
        raise ValueError(f"{out}: is no dataset and holds none; a dataset's folder has a dataset.json")
    variants = data.read_variants(out) if (out / "variants.json").is_file() else {}
    with data.reading(out / "variants.json"):
        drawn = {name: {str(key): str(short(value)) for key, value in one.get("drawn", {}).items()}
                 for name, one in variants.items()}
    return found, drawn, len(variants.keys() - found.keys())


def require_ours(out):
    """Refuses to replace what another program wrote."""
    page = out / "index.html"
    if os.path.lexists(page) and (page.is_symlink() or MARK not in page.read_bytes()[:1000]):
        raise ValueError(f"{page}: is not of sonarsim's making, and would be replaced; move it away")
    for folder in (out / FILES, out / f"{FILES}.tmp"):
        if os.path.lexists(folder) and (folder.is_symlink() or not folder.is_dir() or
                                        not all(OWN_FILE.fullmatch(name) for name in os.listdir(folder))):
            raise ValueError(f"{folder}: is not of sonarsim's making, and would be replaced; move it away")


def write_chunk(files, key, value):
    """JSON as text within a script, so that no name in it means anything to JavaScript."""
    text = json.dumps(json.dumps(value, separators=(",", ":"), allow_nan=False))
    (files / f"{key}.js").write_text(f'take("{key}",{text})\n', "utf-8")


def write_dataset(files, k, shown):
    """The files of a dataset. Returns its number of pings."""
    description, sensors = shown.dataset.description, []
    for s, one in enumerate(shown.dataset.sensors.values()):
        sensor, chunks = shown.sensor(one)
        sensors.append(sensor)
        for c, chunk in chunks.items():
            write_chunk(files, f"{k}_{s}_{c}", chunk)
    # As text, since JavaScript rounds whole numbers from 2^53 on.
    about = {key: str(description.get(key)) for key in ("program_version", "seed", "poses")}
    write_chunk(files, k, about | {"complete": description.get("complete") is True, "labels": shown.labels,
                                   "sensors": sensors, "background": shown.background})
    return sum(sensor["pings"] for sensor in sensors)


def write_page(out, is_quiet):
    """Writes the page, whole or not at all."""
    datasets, drawn, missing = members_of(out)
    require_ours(out)
    files, partial = out / FILES, out / f"{FILES}.tmp"
    shutil.rmtree(partial, ignore_errors=True)
    partial.mkdir()
    try:
        classes = list(dict.fromkeys(one.classes[k] for one in datasets.values() for k in one.class_of.values()))
        totals, pings = collections.defaultdict(lambda: Tally(classes)), 0
        for k, dataset in enumerate(datasets.values()):
            with data.reading(dataset.folder / "dataset.json"):
                pings += write_dataset(partial, k, Shown(dataset, classes, totals))
        about = {"name": out.resolve().name, "missing": missing, "classes": classes, "chunk": PINGS_PER_CHUNK,
                 "edges": EDGES, "datasets": [(name, drawn.get(name, {})) for name in datasets],
                 "statistics": {sensor: tally.as_json() for sensor, tally in totals.items()}}
        page = (PAGE / "page.html").read_text("utf-8")
        page = page.replace("<!--data-->", json.dumps(about).replace("<", "\\u003c"))
        (partial / "index.html").write_text(page, "utf-8")
        (partial / "page.js").write_bytes(b"".join((PAGE / name).read_bytes() for name in SCRIPTS))
        shutil.copyfile(PAGE / "page.css", partial / "page.css")
        size = sum(file.stat().st_size for file in partial.iterdir())
        shutil.rmtree(files, ignore_errors=True)
        partial.rename(files)
        (files / "index.html").replace(out / "index.html")
    except BaseException:
        shutil.rmtree(partial, ignore_errors=True)
        raise
    if not is_quiet:
        print(f"{out / 'index.html'}: {len(datasets)} datasets, {pings} pings, {size / 1e6:.1f} MB; open it in a browser")


def main():
    parser = argparse.ArgumentParser(prog="sonarsim gallery", description="Writes a page to look through a "
                                     "dataset, index.html in its folder. Open it in a browser.")
    parser.add_argument("folder", type=pathlib.Path, metavar="OUT",
                        help="the folder of a dataset, of the variants of a mission, or of several datasets")
    parser.add_argument("-q", "--quiet", action="store_true", help="print only errors")
    arguments = parser.parse_args()
    return run("gallery", write_page, arguments.folder, arguments.quiet)


if __name__ == "__main__":
    sys.exit(main())
