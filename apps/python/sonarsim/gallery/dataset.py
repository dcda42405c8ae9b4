"""What the page shows of a dataset: its sensors, pictures, pings and objects."""
import os
import re

from .. import data
from ..tally import EDGES, Tally

PINGS_PER_CHUNK = 250
FACTS = ("side", "range_m", "azimuth_rad", "bearing_deg", "area_bins", "area_px", "level", "level_around",
         "contrast_db", "visible_share", "shadow_contrast_db", "clipped", "buried")


def short(value):
    """A number with six digits, a whole one without a point; anything else as it is."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return value
    value = float(f"{value:.6g}")
    return int(value) if value == int(value) else value


def ranges_of(numbers):
    """[first, end, first, end, ...] of the runs in a set of numbers."""
    firsts = sorted(one for one in numbers if one - 1 not in numbers)
    ends = sorted(one + 1 for one in numbers if one + 1 not in numbers)
    return [border for run in zip(firsts, ends) for border in run]


def shape_of(box, x, y, mask="", shadow=None):
    """[left, top, right, bottom, mask, box of the shadow or 0]."""
    (left, right), (top, bottom) = box[x], box[y]
    return [*map(int, (left, top, right, bottom)), str(mask or ""), shape_of(shadow, x, y)[:4] if shadow else 0]


def facts_of_ping(meta):
    """When and where a ping was, and what it measured."""
    facts = dict(zip("xyz", meta["T_world_vehicle"]["position_m"])) | {"time_s": meta["time_s"]}
    for key, value in (meta.get("measured", {}) | {"estimated_error": meta.get("estimated_error")}).items():
        facts |= {f"{key}.{part}": one for part, one in value.items()} if isinstance(value, dict) else {key: value}
    return {key: short(value) for key, value in facts.items() if isinstance(value, (int, float))}


def numbered(folder, pattern):
    """(number, path) of the files of a pattern such as fls/objects/%06d.json that are there, in order."""
    inner, name = os.path.split(pattern)
    rule = re.compile(re.sub(r"%0\dd", r"(\\d{1,12})", re.escape(name)))
    names = os.listdir(folder / inner) if (folder / inner).is_dir() else []
    found = [match for match in map(rule.fullmatch, names) if match]
    return sorted((int(match[1]) if match.groups() else 0, data.own_file(folder, f"{inner}/{match[0]}"))
                  for match in found)


def view_of(picture, sensor):
    """How a picture of dataset.json is shown; `part` is the place of its shapes in an entry."""
    if data.is_behind_link(sensor.folder, picture["file"]):
        raise ValueError(f"{picture['file']!r} lies behind a link")
    view = {"part": 2} | {key: picture[key] for key in ("title", "file", "per")}
    if view["per"] == "ping":
        view["turned"] = picture.get("ahead") == "down"
        if picture.get("boxes_of") == "fan":
            fan = sensor.description["fan"]
            view |= {"part": 3, "width": fan["width_px"], "height": fan["height_px"]}
        elif "boxes_of" in picture:
            view |= {"width": len(sensor.azimuth_edges_rad) - 1, "height": len(sensor.range_edges_m) - 1}
    elif view["per"] == "sweep":
        view |= {"pings": data.whole(picture["pings"], 1, "pings"),
                 "radius": picture["radius_px"] / picture["width_px"]}
    elif "pings_along" in picture:
        view["along"] = "xy".index(picture["pings_along"])
        view |= {key: picture[key] for key in ("origin_px", "pixel_px", "pings_per_pixel")}
    return view


class Shown:
    """A dataset as the page shows it; `totals` are the tallies of all datasets, by sensor."""

    def __init__(self, dataset, classes, totals):
        self.dataset, self.classes, self.totals = dataset, classes, totals
        self.labels = [[str(dataset.instances[one]), classes.index(dataset.classes[number])]
                       for one, number in dataset.class_of.items()]
        self.label_of = {one: label for label, one in enumerate(dataset.class_of)}
        self.background = [k for k, name in enumerate(classes) if name in dataset.background]

    def entries(self, content, tallies):
        """[label, facts, shape in the image of bins or in the record, shape in the fan or 0] of each object."""
        entries, counted = [], []
        for seen in content["objects"]:
            label, shadow, fan = self.label_of[seen["id"]], seen.get("shadow") or {}, seen.get("fan")
            facts = {"shadow_contrast_db": shadow.get("contrast_db")} | seen
            facts = {key: short(facts[key]) for key in FACTS if isinstance(facts.get(key), (str, int, float))}
            own = (seen["box_px"], "x", "y") if "box_px" in seen else (seen["box_bins"], "beam", "range")
            shape = shape_of(*own, seen.get("mask"), seen.get("shadow_box_px") or shadow.get("box_bins"))
            entries.append([label, facts, shape, fan and shape_of(fan["box_px"], "x", "y", fan.get("mask"),
                                                                  fan.get("shadow_box_px"))])
            if self.labels[label][1] not in self.background:
                area = facts.get("area_px", facts.get("area_bins"))
                counted.append({**{key: facts.get(key) for key in EDGES}, "area": area, "id": seen["id"],
                                "class": self.labels[label][1] + 1, "iscrowd": 0})
        for tally in tallies:
            tally.add(self.dataset.folder, counted)
        return entries

    def record(self, sensor, view, tallies):
        """The entries of each picture of many pings, by its number, and the pairs (ping, label)."""
        is_sweep, pictures, seen = view["per"] == "sweep", {}, []
        for number, path in numbered(sensor.folder, f"{sensor.name}/objects{'_%04d' if is_sweep else ''}.json"):
            with data.reading(path):
                content = data.read_json(path.read_bytes())
                view |= {"width": int(content["width"]), "height": int(content["height"])}
                pictures[number] = self.entries(content, tallies)
                for label, _, box, _ in pictures[number]:
                    middle = 0 if is_sweep else (box[view["along"]] + box[view["along"] + 2]) / 2
                    seen.append((number * view["pings"] if is_sweep else int(middle * view["pings_per_pixel"]), label))
        return pictures, seen

    def sensor(self, sensor):
        """A sensor for the page, and its chunks: {number: {ping: {"objects": entries, "meta": facts}}}."""
        files, every = sensor.description["files"], sensor.pings.step
        tallies = Tally(self.classes), self.totals[sensor.name]
        views = [view_of(picture, sensor) for picture in sensor.description["pictures"]]
        of_many = [view for view in views if view["per"] == "sweep" or "along" in view]
        pictures, seen = self.record(sensor, of_many[0], tallies) if of_many else ({}, [])
        chunks, of_label = {}, {}
        for kind in ("objects", "meta"):
            for pose, path in numbered(sensor.folder, files[kind]) if kind in files else []:
                with data.reading(path):
                    ping, content = pose // every, data.read_json(path.read_bytes())
                    found = self.entries(content, tallies) if kind == "objects" else facts_of_ping(content)
                chunks.setdefault(ping // PINGS_PER_CHUNK, {}).setdefault(ping, {})[kind] = found
                seen += [(ping, entry[0]) for entry in found] if kind == "objects" else []
        for ping, label in seen:
            of_label.setdefault(label, set()).add(max(0, min(ping, len(sensor) - 1)))
        return {"name": sensor.name, "kind": sensor.kind, "every": every, "pings": len(sensor), "views": views,
                "meta": files.get("meta", ""), "pictures": pictures, "chunks": sorted(chunks),
                "statistics": tallies[0].as_json(),
                "seen": {label: ranges_of(own) for label, own in of_label.items()}}, chunks
