"""sonarsim gallery OUT: writes OUT/index.html and OUT/index_files/, a page to look through a dataset."""
import argparse
import json
import os
import pathlib
import re
import sys

from ..command import need, new_folder, replaced, run

need("gallery", "numpy")

from .. import data

PAGE = pathlib.Path(__file__).parent / "page"
SCRIPTS = ("data.js", "picture.js", "objects.js", "controls.js")
MARK = b'<meta name="generator" content="sonarsim gallery">'
OWN_FILE = re.compile(r"page\.(css|js)|\d+(_\d+_\d+)?\.js")
PINGS_PER_CHUNK = 250


def facts_of(content, *without):
    """The texts and numbers, also those in sections, with six digits."""
    facts = {f"{key}.{part}": one for key, value in content.items() if isinstance(value, dict)
             for part, one in value.items()} | content
    return {key: float(f"{value:.6g}") if isinstance(value, float) else value for key, value in facts.items()
            if isinstance(value, (str, int, float)) and key not in without}


def shape_of(box, x, y, mask="", shadow=None):
    """[left, top, right, bottom, mask, box of the shadow or 0]."""
    (left, right), (top, bottom) = box[x], box[y]
    return [*map(int, (left, top, right, bottom)), str(mask or ""), shape_of(shadow, x, y)[:4] if shadow else 0]


def ping_facts(meta):
    """When and where a ping was, and what it measured."""
    place = dict(zip("xyz", meta["T_world_vehicle"]["position_m"]))
    return facts_of({**place, "time_s": meta["time_s"], **meta.get("measured", {})})


class Shown:
    """A dataset as the page shows it."""

    def __init__(self, dataset, classes):
        self.dataset = dataset
        self.labels = [[str(dataset.instances[one]), classes.index(dataset.classes[number])]
                       for one, number in dataset.class_of.items()]
        self.label_of = {one: label for label, one in enumerate(dataset.class_of)}
        self.background = [k for k, name in enumerate(classes) if name in dataset.background]

    def entries(self, content):
        """[label, facts, shape in the image of bins or in the record, shape in the fan or 0] of each object."""
        entries = []
        for one in content["objects"]:
            shadow, fan = one.get("shadow") or {}, one.get("fan")
            facts = facts_of({key: value for key, value in one.items() if "box" not in key and key != "fan"},
                             "id", "name", "class", "mask")
            own = (one["box_px"], "x", "y") if "box_px" in one else (one["box_bins"], "beam", "range")
            shape = shape_of(*own, one.get("mask"), one.get("shadow_box_px") or shadow.get("box_bins"))
            fan_shape = fan and shape_of(fan["box_px"], "x", "y", fan.get("mask"), fan.get("shadow_box_px"))
            entries.append([self.label_of[one["id"]], facts, shape, fan_shape])
        return entries

    def contents(self, pattern, numbers, taken):
        """(number, what `taken` makes of its content) of the files that are there; an error within names the file."""
        for number in numbers:
            name = pattern % number if "%" in pattern else pattern
            if os.path.lexists(self.dataset.folder / name):
                with data.reading(data.own_file(self.dataset.folder, name)) as path:
                    yield number, taken(data.read_json(path.read_bytes()))

    def sensor(self, sensor):
        """A sensor for the page, and its chunks: {number: {ping: {"objects": entries, "meta": facts}}}."""
        own, files, seen, pictures, chunks = sensor.description, sensor.description["files"], {}, {}, {}
        # The place of shapes in an entry, and the size of the picture that is labelled.
        shapes = {"fan": (3, *(own.get("fan", {}).get(key) for key in ("width_px", "height_px"))),
                  "bins": (2, *(len(edges) - 1 for edges in (sensor.azimuth_edges_rad, sensor.range_edges_m)
                                if edges is not None))}
        views = [view | dict(zip(("part", "width", "height"), shapes.get(view.get("boxes_of"), (2,))))
                 for view in own["pictures"]]
        for view in [one for one in views if one["per"] == "sweep" or "pings_along" in one][:1]:
            is_sweep, pings = view["per"] == "sweep", data.whole(view.get("pings", max(len(sensor), 1)), 1, "pings")
            for number, (width, height, entries) in self.contents(
                    f"{sensor.name}/objects{'_%04d' if is_sweep else ''}.json", range(-(-len(sensor) // pings)),
                    lambda content: (int(content["width"]), int(content["height"]), self.entries(content))):
                view["width"], view["height"], pictures[number] = width, height, entries
        for kind in sorted({"objects", "meta"} & files.keys()):
            for pose, found in self.contents(files[kind], sensor.pings, self.entries if kind == "objects" else ping_facts):
                ping = pose // sensor.pings.step
                chunks.setdefault(ping // PINGS_PER_CHUNK, {}).setdefault(ping, {})[kind] = found
                for entry in found if kind == "objects" else ():
                    seen.setdefault(entry[0], []).append(ping)
        return {"name": sensor.name, "kind": sensor.kind, "every": sensor.pings.step, "pings": len(sensor), "views": views,
                "meta": files.get("meta", ""), "pictures": pictures, "chunks": sorted(chunks), "seen": seen}, chunks

    def write(self, files, k):
        """Writes the k-th dataset: JSON as text within scripts, so that no name in it means anything to JavaScript."""
        def write(key, value):
            text = json.dumps(json.dumps(value, separators=(",", ":"), allow_nan=False))
            (files / f"{key}.js").write_text(f'take("{key}",{text})\n', "utf-8")
        # As text, since JavaScript rounds whole numbers from 2^53 on.
        about = {key: str(self.dataset.description.get(key)) for key in ("program_version", "seed", "poses")} | {
            "complete": self.dataset.complete is True, "labels": self.labels, "background": self.background, "sensors": []}
        for s, one in enumerate(self.dataset.sensors.values()):
            sensor, chunks = self.sensor(one)
            about["sensors"].append(sensor)
            for c, chunk in chunks.items():
                write(f"{k}_{s}_{c}", chunk)
        write(k, about)


def write_page(out):
    """Writes the page, whole or not at all."""
    found = [""] if (out / "dataset.json").is_file() else sorted(
        path.parent.name for path in out.glob("*/dataset.json") if not path.parent.is_symlink())
    if not found:
        raise ValueError(f"{out}: is not a dataset and holds none; a dataset's folder has a dataset.json")
    datasets = [data.open_dataset(out / name) for name in found]
    variants = data.read_variants(out) if found[0] and (out / "variants.json").is_file() else {}
    page, files = out / "index.html", out / "index_files"
    for path, is_ours in ((page, lambda: MARK in page.read_bytes()[:1000]),
                          (files, lambda: all(map(OWN_FILE.fullmatch, os.listdir(files))))):
        if os.path.lexists(path) and (path.is_symlink() or not is_ours()):
            raise ValueError(f"{path}: is not of sonarsim's making, and would be replaced; move it away")
    with new_folder(files) as partial, replaced(page) as index:
        classes = list(dict.fromkeys(one.classes[k] for one in datasets for k in one.class_of.values()))
        for k, dataset in enumerate(datasets):
            with data.reading(dataset.folder / "dataset.json"):
                Shown(dataset, classes).write(partial, k)
        with data.reading(out / "variants.json"):
            drawn = [facts_of(variants.get(name, {}).get("drawn", {})) for name in found]
        about = {"name": out.resolve().name, "classes": classes, "chunk": PINGS_PER_CHUNK, "datasets": list(zip(found, drawn))}
        text = (PAGE / "page.html").read_text("utf-8").replace("<!--data-->", json.dumps(about).replace("<", "\\u003c"))
        index.write_text(text, "utf-8")
        (partial / "page.js").write_bytes(b"".join((PAGE / name).read_bytes() for name in SCRIPTS))
        (partial / "page.css").write_bytes((PAGE / "page.css").read_bytes())
    print(f"{page}: {len(datasets)} datasets; open it in a browser")


def main():
    parser = argparse.ArgumentParser("sonarsim gallery", description="Writes index.html, a page to look through a dataset")
    parser.add_argument("folder", type=pathlib.Path, metavar="OUT",
                        help="the folder of a dataset, of the variants of a mission, or of several datasets")
    return run("gallery", write_page, parser.parse_args().folder)


if __name__ == "__main__":
    sys.exit(main())
