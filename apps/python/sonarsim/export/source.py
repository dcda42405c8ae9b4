"""The pictures of datasets that are exported, and the objects in them."""
import dataclasses
import math
import pathlib
import re

import numpy as np

from .. import data
from ..command import need
from . import split

MAX_PIXELS = 1 << 31
MAX_FAN_PIXELS = 1 << 22   # of a fan that is drawn from its bins; those of sonarsim are at most 1024 wide
ADVICE = "set output.labels: [objects] and render it again"
FACTS = ("range_m", "bearing_deg", "contrast_db", "visible_share", "shadow_contrast_db")


@dataclasses.dataclass
class Picture:
    """A picture of a dataset, with what is needed to read it and its objects."""
    path: pathlib.Path
    facts: pathlib.Path         # the file that lists its objects
    name: str                   # of the exported picture: "variant_0003-fls-000012"
    dataset: int                # its index in Source.datasets
    kind: str                   # "fan", "bins", "strip" (waterfall, echogram) or "sweep"
    width: int
    height: int
    full_scale: float           # the intensity that is white, for arrays of intensities; of raw/ the largest value
    parts: list                 # the part of each row or column of pings of a strip, else one part
    rows_are_pings: bool = True
    bins: object = None         # the bin of each pixel, -1 for none, of a fan that is drawn from its bins
    pixel_m: tuple = None       # width and height of a pixel in metres, for crops


class Source:
    """The datasets in some folders: `datasets`, `numbers` (for each the number of every class by its
    name, 0 for no object), `classes` (number k is entry k - 1) and `pictures`."""

    def __init__(self, folders, options):
        found = named_datasets(folders)
        self.datasets, self._names = list(found.values()), list(found)
        for dataset in self.datasets:
            if not dataset.classes:
                raise ValueError(f"{dataset.folder}: has no objects; {ADVICE}")
        self._shares = self._shares_of_datasets(options)
        self._number_classes(options)
        require_known(options.sensor, {name: 0 for one in self.datasets for name in one.sensors}, "--sensor")
        self.pictures, self._taken = [], set()
        for index in range(len(self.datasets)):
            self._add_pictures(index, options)
        if not self.pictures:
            raise ValueError(f"{folders[0]}: has no pictures to export: none of the sensors writes any")
        if options.tile and not any(one.kind in ("strip", "sweep") for one in self.pictures):
            raise ValueError("--tile: cuts waterfalls, echograms and sweeps, and there is none")

    def _shares_of_datasets(self, options):
        """The part of each dataset that is one of several variants of a mission; the shares of the others."""
        shares, variants = [options.split] * len(self.datasets), {}
        for index, one in enumerate(self.datasets if options.split else ()):
            if (one.folder.resolve().parent / "variants.json").is_file():
                variants.setdefault(one.folder.resolve().parent, []).append(index)
        for group in filter(lambda one: len(one) > 1, variants.values()):
            for index, part in zip(group, split.variants_parts(options.split, len(group), options.rounds)):
                shares[index] = part
        return shares

    def _number_classes(self, options):
        known = [(name, name in one.background) for one in self.datasets for name in one.classes.values()]
        annotated = dict.fromkeys(name for name, is_background in known if not is_background)
        require_known(options.without, dict(known), "--without")
        if not annotated:
            raise ValueError(f"{self.datasets[0].folder}: each class is background by labels.background of its "
                             "mission; [none] there makes all of them objects")
        self.classes = [name for name in annotated if name not in options.without]
        if not self.classes:
            raise ValueError("--without: no class is left")
        numbers = {name: k + 1 for k, name in enumerate(self.classes)}
        self.numbers = [{name: 0 if name in dataset.background else numbers.get(name, 0)
                         for name in dataset.classes.values()} for dataset in self.datasets]

    def _add_pictures(self, index, options):
        dataset, shares = self.datasets[index], self._shares[index]
        count, file = dataset.description["poses"], dataset.folder / "dataset.json"
        if isinstance(shares, dict):
            parts = split.poses_parts(shares, count, options.gap, options.rounds)
        else:
            parts = [shares if options.split else "train"] * count
        for sensor in dataset.sensors.values():
            if options.sensor and sensor.name not in options.sensor:
                continue
            with data.reading(file):
                for picture in pictures_of(sensor, parts, options):
                    self._name(picture, index, sensor.name)
                    if options.format == "crops":
                        picture.pixel_m = pixel_m_of(picture, sensor, dataset)
                    self.pictures.append(picture)

    def _name(self, picture, index, sensor):
        stem = picture.path.name.split(".")[0]
        # Trainers cut the name of a sample at its first point, shells at a blank.
        picture.name = re.sub(r"[^A-Za-z0-9_+-]", "_", "-".join(filter(None, [self._names[index], sensor, stem])))
        picture.name = unused(picture.name, self._taken)
        self._taken.add(picture.name)
        picture.dataset = index


def unused(name, taken):
    """The name itself, or with the first number after it that is not taken."""
    return next(one for one in (name, *(f"{name}-{k}" for k in range(2, len(taken) + 2))) if one not in taken)


def named_datasets(folders):
    """The datasets of folders by name: "" for one alone, else by folder and variant. ValueError for half and equal ones."""
    named = {}
    for folder in map(pathlib.Path, folders):
        for one in data.open_datasets(folder):
            if one.complete is not True:
                raise ValueError(f"{one.folder}: is not complete; run the render command that made it again")
            name = "-".join([folder.resolve().name] * (len(folders) > 1) + [one.folder.name] * (one.folder != folder))
            named[unused(name, named)] = one
    if len({one.folder.resolve() for one in named.values()}) < len(named):
        raise ValueError("a dataset is given twice")
    return named


def require_known(given, known, option):
    for name in given:
        if name not in known:
            raise ValueError(f"{option}: there is no {name!r}; there are: {', '.join(known)}")


def fault_of(sensor, what):
    return data.DataError(f"{sensor.folder}: sensor {sensor.name!r} {what}")


def pictures_of(sensor, parts, options):
    """Yields the pictures of a sensor; none for a kind without pictures. `parts` has those of all poses."""
    part_of_ping = [parts[pose] for pose in sensor.pings]
    if sensor.picture("sensor") or sensor.picture("sweep"):
        if options.image == "raw":
            raise fault_of(sensor, "has no fans, whose values --image raw takes; choose others with --sensor")
        yield from records_of(sensor, part_of_ping)
    elif sensor.kind in ("imaging", "profiling"):
        yield from pings_of(sensor, part_of_ping, options.bins, options.image == "raw")


def pings_of(sensor, part_of_ping, is_bins, is_raw):
    wanted = ("raw",) if is_raw else ("image", "polar") if is_bins else ("fan",)
    names = [name for name in wanted if name in sensor.keys]
    if not names and is_raw:
        raise fault_of(sensor, "has no raw; leave out --image, or render with output.raw: true and model: calibrated")
    if not names or not is_bins and "fan" not in sensor.keys:     # objects have masks in fans where there are fans
        advice = ("neither images nor arrays of its bins; set output.image: true and render it again, or leave out "
                  "--bins" if is_bins else "no fans; set output.fan: true and render it again, or take the "
                  "pictures of its bins with --bins")
        raise fault_of(sensor, f"has {advice}")
    if "objects" not in sensor.keys:
        raise fault_of(sensor, f"has no objects; {ADVICE}")
    shape = len(sensor.azimuth_edges_rad) - 1, len(sensor.range_edges_m) - 1
    bins, kind = None, "bins" if is_bins else "fan"
    if not is_bins:
        width, height = (data.whole(sensor.description["fan"][key], 1, key) for key in ("width_px", "height_px"))
        if is_raw and width * height > MAX_FAN_PIXELS:
            raise fault_of(sensor, f"has too large a fan: {width} x {height} pixels")
        if is_raw:
            bins = sensor.to_fan(np.arange(shape[0] * shape[1]).reshape(shape[::-1]), width, -1)
        shape = width, height
    full_value = full_value_of(sensor) if is_raw else float(sensor.description["full_scale"])
    for k, part in enumerate(part_of_ping):
        one = picture(sensor, sensor.file(k, names[0]), sensor.file(k, "objects"), kind, shape, [part])
        one.bins, one.full_scale = bins, full_value
        yield one


def mission_of(folder):
    """The mission of a dataset with every default."""
    need("export", "yaml")
    from ..recording import dataset as own     # pylint: disable=import-outside-toplevel
    return own.read_yaml(folder / "mission.resolved.yaml", own.LARGEST_MISSION)


def full_value_of(sensor):
    """The largest value of the raw/ of a sensor: 2^bits - 1."""
    with data.reading(sensor.folder / "mission.resolved.yaml"):
        bits = mission_of(sensor.folder)["sensors"][sensor.name]["instrument"]["receiver"]["bits"]
        return 2.0 ** data.whole(bits, 4, "bits") - 1


def pixel_m_of(picture, sensor, dataset):
    """Width and height in metres of a pixel of a fan, or of a waterfall by slant range and median way between pings."""
    if picture.kind == "fan":
        return (sensor.fan_shape(picture.width)[2],) * 2
    if sensor.kind != "sidescan":
        raise fault_of(sensor, "has neither fans nor a waterfall to cut crops from; choose others with --sensor, without --bins")
    ways = np.linalg.norm(np.diff(dataset.poses()[sensor.pings, 1:4], axis=0), axis=1)
    along = float(np.median(ways)) * sensor.picture("sensor").get("pings_per_pixel", 1) if ways.size else 0
    if not along > 0:
        raise fault_of(sensor, "stands still, so that its rows have no scale")
    return float(np.diff(sensor.range_edges_m).mean()), along


def records_of(sensor, part_of_ping):
    """The waterfall or echogram of a sensor, or the picture of each sweep."""
    strip, sweep = sensor.picture("sensor"), sensor.picture("sweep")
    steps = max(1, len(part_of_ping)) if strip else data.whole(sweep["pings"], 1, "pings")
    for k in range(-(-len(part_of_ping) // steps)):
        facts = f"{sensor.name}/objects.json" if strip else f"{sensor.name}/objects_{k:04}.json"
        if not (sensor.folder / facts).is_file():
            raise data.DataError(f"{sensor.folder}: has no {facts}, which lists the objects; {ADVICE}")
        path = data.own_file(sensor.folder, strip["boxes_of"] if strip else sweep["boxes_of"] % k)
        facts = data.own_file(sensor.folder, facts)
        with data.reading(facts):
            sheet = data.read_json(facts.read_bytes())
            shape = sheet["width"], sheet["height"]
        end = min((k + 1) * steps, len(part_of_ping))
        each = data.whole(strip.get("pings_per_pixel", 1), 1, "pings_per_pixel") if strip else steps
        shown = [set(part_of_ping[first:min(first + each, end)]) for first in range(k * steps, end, each)]
        one = picture(sensor, path, facts, "strip" if strip else "sweep", shape,
                      [parts.pop() if len(parts) == 1 else None for parts in shown])
        one.rows_are_pings = not strip or strip.get("pings_along", "y") == "y"
        if strip and len(one.parts) != (one.height if one.rows_are_pings else one.width):
            raise data.DataError(f"{facts}: has a picture with more or fewer pings than dataset.json says")
        yield one


def picture(sensor, path, facts, kind, shape, parts):
    width, height = (data.whole(side, 1, "width or height") for side in shape)
    if width * height > MAX_PIXELS:
        raise data.DataError(f"{path}: is too large a picture: {width} x {height} pixels")
    return Picture(path, facts, "", 0, kind, width, height, float(sensor.description["full_scale"]), parts)


def object_of(one, kind, number):
    """An object's id, class (number), mask (compressed runs), shadow (box) and FACTS. None: background, or not shown."""
    shown = one["fan"] if kind == "fan" else one
    if not number or shown is None:
        return None
    shadow = one.get("shadow") or {}
    facts = {**one, "shadow_contrast_db": shadow.get("contrast_db", one.get("shadow_contrast_db"))}
    if one.get("azimuth_rad") is not None:
        facts["bearing_deg"] = -math.degrees(one["azimuth_rad"])
    found = {key: None if facts.get(key) is None else float(facts[key]) for key in FACTS}
    box = shadow.get("box_bins") if kind == "bins" else shown.get("shadow_box_px")
    across, along = ("beam", "range") if kind == "bins" else ("x", "y")
    found["shadow"] = (*map(int, box[across]), *map(int, box[along])) if box else None
    found |= {key: one[key] for key in ("side", "clipped") if key in one}
    return {**found, "id": data.whole(one["id"], 1, "id"), "class": number, "mask": str(shown["mask"])}
