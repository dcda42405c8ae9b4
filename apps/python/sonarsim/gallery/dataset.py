"""What the page shows of a dataset: its sensors, pictures, pings and objects."""
import collections
import json
import os
import re

from .statistics import Tally

PINGS_PER_CHUNK = 250
LARGEST_JSON = 1 << 28  # characters
MOST_PINGS = 10**9
FACTS = ("side", "range_m", "azimuth_rad", "bearing_deg", "area_bins", "area_px", "level", "level_around",
         "contrast_db", "visible_share", "shadow_contrast_db", "clipped", "buried")


class DataError(Exception):
    """A file that is not as sonarsim writes it."""


def refuse_constant(text):
    raise ValueError(f"{text} is no number")


def short(value):
    """A number with six digits, a whole one without a point; anything else as it is."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return value
    value = float(f"{value:.6g}")
    return int(value) if value == int(value) else value


def ranges_of(numbers):
    """[first, end, first, end, ...] of the runs in a set of numbers."""
    ranges = []
    for one in sorted(numbers):
        if ranges and ranges[-1] == one:
            ranges[-1] = one + 1
        else:
            ranges += [one, one + 1]
    return ranges


def shape_of(box, x, y, mask, shadow):
    """[left, top, right, bottom, mask, box of the shadow or 0]."""
    (left, right), (top, bottom) = box[x], box[y]
    edges = [edge + 0 for edge in (left, top, right, bottom)]  # numbers, or a TypeError
    return [*edges, str(mask or ""), shape_of(shadow, x, y, "", None)[:4] if shadow else 0]


def facts_of_ping(meta):
    """When and where a ping was, and what it measured."""
    facts = dict(zip("xyz", meta["T_world_vehicle"]["position_m"])) | {"time_s": meta["time_s"]}
    for key, value in (meta.get("measured", {}) | {"estimated_error": meta.get("estimated_error")}).items():
        facts |= {f"{key}.{part}": one for part, one in value.items()} if isinstance(value, dict) else {key: value}
    return {key: short(value) for key, value in facts.items() if isinstance(value, (int, float))}


class Dataset:
    """Reads the files of one folder. Adds to the page's numbers of classes and to its statistics by sensor."""

    def __init__(self, folder, classes, totals):
        self.folder, self.root = folder, folder.resolve()
        self.tallies, self.totals = collections.defaultdict(Tally), totals
        self.file = folder / "dataset.json"  # read last, for messages
        self.description = self.read(self.file)
        told = self.description.get("labels") or {}
        names = {one["id"]: str(one["name"]) for one in told.get("classes", [])}
        self.background = set((told.get("annotations") or {}).get("background", []))
        instances = told.get("instances", [])
        self.label_of = {one["id"]: label for label, one in enumerate(instances)}
        self.class_of = [names[one["class"]] for one in instances]
        self.labels = [[str(one["name"]), classes.setdefault(name, len(classes))]
                       for one, name in zip(instances, self.class_of)]

    def inside(self, name):
        """A file of the dataset, whose name may not lead out of its folder."""
        path = self.folder / name
        if any(part in ("", ".", "..") or "\0" in part for part in name.split("/")) or \
                not path.resolve().is_relative_to(self.root):
            raise DataError(f"{self.file}: {name!r} is no path of a file in the dataset's folder")
        return path

    def read(self, path):
        self.file = path
        with open(path, encoding="utf-8") as file:
            value = json.loads(file.read(LARGEST_JSON), parse_constant=refuse_constant)
        if not isinstance(value, dict):
            raise ValueError("no JSON object")
        return value

    def numbered(self, pattern):
        """(number, path) of the files of a pattern such as fls/objects/%06d.json that are there, in order."""
        path = self.inside(pattern)
        before, _, after = (re.split(r"%0(\d)d", path.name, maxsplit=1) + ["", ""])[:3]
        name = re.compile(re.escape(before) + r"(\d{1,12})" + re.escape(after))
        if not path.parent.is_dir():
            return []
        with os.scandir(path.parent) as entries:
            return sorted((int(match[1]), path.parent / entry.name) for entry in entries
                          if (match := name.fullmatch(entry.name)) and entry.is_file(follow_symlinks=False))

    def entry(self, seen):
        """[label, facts, shape in the image of bins or in the record, shape in the fan or 0]."""
        shadow = seen.get("shadow") or {}
        facts = {"shadow_contrast_db": shadow.get("contrast_db")} | seen
        facts = {key: short(facts[key]) for key in FACTS if isinstance(facts.get(key), (str, int, float))}
        if "box_px" in seen:
            shapes = [shape_of(seen["box_px"], "x", "y", seen.get("mask"), seen.get("shadow_box_px")), 0]
        else:
            fan = seen.get("fan")
            shapes = [shape_of(seen["box_bins"], "beam", "range", seen.get("mask"), shadow.get("box_bins")),
                      fan and shape_of(fan["box_px"], "x", "y", fan.get("mask"), fan.get("shadow_box_px"))]
        return [self.label_of[seen["id"]], facts, *shapes]

    def picture(self, sensor, content):
        """The entries of a file of objects, added to the statistics of the sensor."""
        entries = [self.entry(seen) for seen in content["objects"]]
        counted = [(self.class_of[entry[0]], entry) for entry in entries]
        for tallies in (self.tallies, self.totals):
            tallies[sensor].add(self.folder, [one for one in counted if one[0] not in self.background])
        return entries

    def view(self, picture, sensor):
        """How a picture of dataset.json is shown; `part` is the place of its shapes in an entry."""
        self.inside(picture["file"])
        view = {"part": 2} | {key: picture[key] for key in ("title", "file", "per")}
        if view["per"] == "ping":
            view["turned"] = picture.get("ahead") == "down"
            if picture.get("boxes_of") == "fan":
                view |= {"part": 3, "width": sensor["fan"]["width_px"], "height": sensor["fan"]["height_px"]}
            elif "boxes_of" in picture:
                view |= {"width": len(sensor["azimuth_edges_rad"]) - 1, "height": len(sensor["range_edges_m"]) - 1}
        elif view["per"] == "sweep":
            view |= {"pings": max(1, int(picture["pings"])), "radius": picture["radius_px"] / picture["width_px"]}
        elif "pings_along" in picture:
            view["along"] = "xy".index(picture["pings_along"])
            view |= {key: picture[key] for key in ("origin_px", "pixel_px", "pings_per_pixel")}
        return view

    def record(self, name, views):
        """The entries of each picture of many pings, by its number, and the pairs (ping, label)."""
        pictures, seen = {}, []
        for view in [view for view in views if view["per"] == "sweep" or "along" in view][:1]:
            path = self.inside(f"{name}/objects.json")
            files = self.numbered(f"{name}/objects_%04d.json") if view["per"] == "sweep" else \
                [(0, path)] if path.is_file() else []
            for number, path in files:
                content = self.read(path)
                view |= {"width": int(content["width"]), "height": int(content["height"])}
                pictures[number] = self.picture(name, content)
                for label, _, box, _ in pictures[number]:
                    ping = number * view["pings"] if view["per"] == "sweep" else \
                        int((box[view["along"]] + box[view["along"] + 2]) / 2 * view["pings_per_pixel"])
                    seen.append((ping, label))
        return pictures, seen

    def sensor(self, sensor):
        """A sensor for the page, and its chunks: {number: {ping: {"objects": entries, "meta": facts}}}."""
        self.file = self.folder / "dataset.json"
        name, files, every = sensor["name"], sensor["files"], max(1, int(sensor["every"]))
        if not 0 < sensor["pings"] <= MOST_PINGS:
            raise ValueError(f"{sensor['pings']} pings of sensor '{name}'")
        if "pictures" not in sensor:
            raise DataError(f"{self.file}: lists no pictures of sensor '{name}', since an older sonarsim wrote it; "
                            "render the dataset again")
        views = [self.view(picture, sensor) for picture in sensor["pictures"]]
        pictures, seen = self.record(name, views)
        chunks = {}
        for kind in ("objects", "meta"):
            for pose, path in self.numbered(files[kind]) if "%" in files.get(kind, "") else []:
                ping, content = pose // every, self.read(path)
                found = self.picture(name, content) if kind == "objects" else facts_of_ping(content)
                chunks.setdefault(ping // PINGS_PER_CHUNK, {}).setdefault(ping, {})[kind] = found
                seen += [(ping, entry[0]) for entry in found] if kind == "objects" else []
        pings, of_label = int(sensor["pings"]), {}
        for ping, label in seen:
            of_label.setdefault(label, set()).add(max(0, min(ping, pings - 1)))
        return {"name": name, "kind": sensor["kind"], "every": every, "pings": pings, "views": views,
                "meta": files.get("meta", ""), "pictures": pictures, "chunks": sorted(chunks),
                "statistics": self.tallies[name].json(),
                "seen": {label: ranges_of(own) for label, own in of_label.items()}}, chunks
