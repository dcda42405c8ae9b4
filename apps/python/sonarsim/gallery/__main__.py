"""sonarsim gallery OUT: writes OUT/index.html and OUT/index_files/, a page to look through a dataset."""
import argparse
import base64
import collections
import hashlib
import json
import os
import pathlib
import re
import shutil
import sys

from .dataset import PINGS_PER_CHUNK, DataError, Dataset, short
from .statistics import AXES, Tally

PAGE = pathlib.Path(__file__).parent / "page"
SCRIPTS = ("data.js", "picture.js", "objects.js", "statistics.js", "controls.js")
MARK = b'<meta name="generator" content="sonarsim gallery">'
FILES = "index_files"
OWN_FILE = re.compile(r"index\.html|\d+(_\d+_\d+)?\.js")
BAD_DATA = (KeyError, IndexError, TypeError, ValueError, AttributeError, ArithmeticError, RecursionError)


def damaged(file, error):
    what = f"{error} is missing" if isinstance(error, KeyError) else \
        "a value has the wrong type" if isinstance(error, (TypeError, AttributeError)) else str(error)
    return DataError(f"{file}: is not as sonarsim writes it ({what})")


def source_of(text):
    """What a content security policy calls a script or a style of the page."""
    return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'"


def page_html(about):
    style = (PAGE / "page.css").read_text("utf-8")
    script = "".join((PAGE / name).read_text("utf-8") for name in SCRIPTS)
    # Some browsers match nothing on a disk with 'self'.
    policy = (f"default-src 'none'; style-src {source_of(style)}; script-src {source_of(script)} 'self' file:; "
              "img-src 'self' file:; base-uri 'none'; form-action 'none'")
    page = (PAGE / "page.html").read_text("utf-8")
    for place, text in (("policy", policy), ("style", style), ("script", script),
                        ("data", json.dumps(about).replace("<", "\\u003c"))):
        page = page.replace(f"<!--{place}-->", text, 1)
    return page


def write_chunk(files, key, value):
    """JSON as text within a script, so that no name in it means anything to JavaScript."""
    text = json.dumps(json.dumps(value, separators=(",", ":"), allow_nan=False))
    (files / f"{key}.js").write_text(f'take("{key}",{text})\n', "utf-8")
    return len(text)


def write_dataset(files, k, folder, classes, totals):
    """The files of a dataset. Returns its number of pings and the bytes."""
    dataset = None
    try:
        dataset = Dataset(folder, classes, totals)
        sensors, size = [], 0
        for s, told in enumerate(dataset.description["sensors"]):
            sensor, chunks = dataset.sensor(told)
            sensors.append(sensor)
            size += sum(write_chunk(files, f"{k}_{s}_{c}", chunk) for c, chunk in chunks.items())
        # As text, since JavaScript rounds whole numbers from 2^53 on.
        about = {key: str(dataset.description.get(key)) for key in ("program_version", "seed", "poses")}
        about |= {"complete": dataset.description.get("complete") is True, "labels": dataset.labels,
                  "sensors": sensors,
                  "background": [number for name, number in classes.items() if name in dataset.background]}
        return sum(sensor["pings"] for sensor in sensors), size + write_chunk(files, k, about)
    except BAD_DATA as error:
        raise damaged(dataset.file if dataset else folder / "dataset.json", error) from error


def members_of(out):
    """The folders of the datasets with what was drawn for each, and the number of variants that are missing."""
    if (out / "dataset.json").is_file():
        return {"": {}}, 0
    if not out.is_dir():
        raise DataError(f"{out}: is no folder")
    found = sorted(path.parent.name for path in out.glob("*/dataset.json") if not path.parent.is_symlink())
    if not found:
        raise DataError(f"{out}: is no dataset and holds none; a dataset's folder has a dataset.json")
    drawn = {}
    if (out / "variants.json").is_file():
        try:
            drawn = {one["folder"]: {str(key): str(short(value)) for key, value in one.get("drawn", {}).items()}
                     for one in json.loads((out / "variants.json").read_text("utf-8"))["variants"]}
        except BAD_DATA as error:
            raise damaged(out / "variants.json", error) from error
    return {name: drawn.get(name, {}) for name in found}, len(drawn.keys() - set(found))


def require_ours(out):
    """Refuses to replace what another program wrote."""
    page = out / "index.html"
    if os.path.lexists(page) and (page.is_symlink() or MARK not in page.read_bytes()[:1000]):
        raise DataError(f"{page}: is not of sonarsim's making, and would be replaced; move it away")
    for folder in (out / FILES, out / f"{FILES}.tmp"):
        if os.path.lexists(folder) and (folder.is_symlink() or not folder.is_dir() or
                                        not all(OWN_FILE.fullmatch(name) for name in os.listdir(folder))):
            raise DataError(f"{folder}: is not of sonarsim's making, and would be replaced; move it away")


def write_page(out):
    """Writes the page, whole or not at all. Returns the numbers of datasets and pings, and the bytes."""
    members, missing = members_of(out)
    require_ours(out)
    files, partial = out / FILES, out / f"{FILES}.tmp"
    shutil.rmtree(partial, ignore_errors=True)
    partial.mkdir()
    try:
        classes, totals = {}, collections.defaultdict(Tally)
        written = [write_dataset(partial, k, out / name, classes, totals) for k, name in enumerate(members)]
        html = page_html({
            "name": out.resolve().name, "missing": missing, "classes": list(classes), "chunk": PINGS_PER_CHUNK,
            "axes": [axis[1:] for axis in AXES], "datasets": list(members.items()),
            "statistics": {sensor: tally.json() for sensor, tally in totals.items()}})
        (partial / "index.html").write_text(html, "utf-8")
        shutil.rmtree(files, ignore_errors=True)
        partial.rename(files)
        (files / "index.html").replace(out / "index.html")
    except BaseException:
        shutil.rmtree(partial, ignore_errors=True)
        raise
    return len(members), sum(pings for pings, _ in written), sum(size for _, size in written) + len(html)


def main():
    parser = argparse.ArgumentParser(prog="sonarsim gallery", description="Writes a page to look through a "
                                     "dataset, index.html in its folder. Open it in a browser.")
    parser.add_argument("folder", type=pathlib.Path, metavar="OUT",
                        help="the folder of a dataset, of the variants of a mission, or of several datasets")
    parser.add_argument("-q", "--quiet", action="store_true", help="print only errors")
    arguments = parser.parse_args()
    try:
        datasets, pings, size = write_page(arguments.folder)
    except DataError as error:
        print(f"sonarsim gallery: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"sonarsim gallery: {error.filename or arguments.folder}: {error.strerror}", file=sys.stderr)
        return 1
    if not arguments.quiet:
        print(f"{arguments.folder / 'index.html'}: {datasets} datasets, {pings} pings, {size / 1e6:.1f} MB; "
              "open it in a browser")
    return 0


if __name__ == "__main__":
    sys.exit(main())
