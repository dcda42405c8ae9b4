"""Opens the datasets of sonarsim, of any kind of sonar. Needs numpy alone.

    import sonarsim.data
    dataset = sonarsim.data.open_dataset("out/tank_labels")
    fls = dataset["fls"]                       # a sensor, by its name
    for sample in fls:                         # a ping; its arrays are read when needed
        image = sample["polar"]                # float32 [range, azimuth]
        ids = sample["instance"]               # uint16 [range, azimuth]
        names = dataset.instances              # id -> name
    fan = fls.to_fan(image, width=512)         # [row, column], boresight up, port on the left
    image = fls.from_fan(fan)                  # back again
    points = fls.points(fls[0])                # [n, 3] in the world, with instance and class
    data = sonarsim.data.torch_dataset(fls, ("polar", "class"))      # where torch is installed

A sample has the names of docs/dataset.md: 'polar', 'image', 'fan', 'meta' and labels; sonars that are
written as records have their rows: 'waterfall', 'echogram', 'scan', 'soundings'.
"""
import collections.abc
import contextlib
import io
import json
import math
import os
import pathlib
import re
import struct
import tokenize
import typing
import zlib

import numpy as np

FORMAT_VERSION = 3
# The permitted letters in names of a dataset's files, since a dataset may come from anybody.
NAME = r"[A-Za-z0-9_+-][A-Za-z0-9_+.-]*"
INNER_PATH = re.compile(f"{NAME}(/{NAME})*", re.ASCII)
# The only number of a pattern stands in its last name.
PATTERN = re.compile(rf"(?:{NAME}/)*(?:{NAME})?%0[1-9]d[A-Za-z0-9_+.-]*", re.ASCII)
ANY_TEXT = re.compile(".*", re.DOTALL)
# The bytes that a pose takes in trajectory.tum: eight numbers, each with a blank or the line's end.
SHORTEST_POSE = 16
# A byte of a PNG file unpacks to at most this many bytes.
MAX_INFLATED = 1032
# Bits and colour type of the PNG files of pings: 0 is grey, 2 RGB, 3 a colour table.
PNG_KINDS = ((8, 0), (16, 0), (8, 2), (16, 2), (8, 3))


def open_dataset(folder):
    """The dataset in a folder. ValueError when there is none, or one of another format version."""
    return Dataset(pathlib.Path(folder))


def open_datasets(folder):
    """The datasets in a folder: its own, or the variants of a mission in order. ValueError as open_dataset()."""
    folder = pathlib.Path(folder)
    if not (folder / "variants.json").is_file():
        return [open_dataset(folder)]
    return [open_dataset(own_file(folder, name, is_folder=True)) for name in read_variants(folder)]


def read_variants(folder):
    """What variants.json of a folder says of each variant, by the name of its folder."""
    with reading(folder / "variants.json") as file:
        return {checked(one["folder"], re.compile(NAME, re.ASCII), "folder"): one
                for one in read_json(file.read_bytes())["variants"]}


class Dataset:
    """A dataset: `sensors` by name, and its dataset.json as `description`."""

    def __init__(self, folder):
        self.folder = folder
        path = folder / "dataset.json"
        if not path.is_file():
            raise DataError(f"{folder}: is not a dataset of sonarsim: it has no dataset.json")
        with reading(path):
            self.description = read_json(path.read_bytes())     # UTF-8, whatever the locale
            is_ours = isinstance(self.description, dict) and self.description.get("format") == "sonarsim dataset"
            version = self.description.get("format_version") if is_ours else None
            if version != FORMAT_VERSION:
                raise DataError(f"{path}: has format_version {version}; this reads {FORMAT_VERSION}")
            self._read()

    def _read(self):
        self.complete = self.description["complete"] is True
        poses = whole(self.description["poses"], 0, "poses")
        room = own_file(self.folder, "trajectory.tum").stat().st_size // SHORTEST_POSE
        if poses > room:
            raise Damage(f"'poses' is {poses}, and trajectory.tum has no room for more than {room}")
        self.sensors = {}
        for one in self.description["sensors"]:
            sensor = Sensor(self.folder, one)
            self.sensors[sensor.name] = sensor
            if sensor.pings and sensor.pings[-1] >= poses:
                raise Damage(f"sensor {sensor.name!r} has {len(sensor)} pings, more than poses")
        labels = self.description.get("labels", {})
        self.instances, self.classes, self.materials = (
            {whole(entry["id"], 0, "id"): checked(entry["name"], ANY_TEXT, "name") for entry in labels.get(kind, [])}
            for kind in ("instances", "classes", "materials"))
        self.class_of = {entry["id"]: whole(entry["class"], 0, "class") for entry in labels.get("instances", [])}
        if not self.classes.keys() >= set(self.class_of.values()):
            raise Damage("labels.instances has a class that labels.classes does not have")
        # The names of the classes that are not objects.
        self.background = {checked(name, ANY_TEXT, "background")
                           for name in labels.get("annotations", {}).get("background", [])}

    def __getitem__(self, name):
        return self.sensors[name]

    def __iter__(self):
        """The samples of all sensors, sensor after sensor."""
        for sensor in self.sensors.values():
            yield from sensor

    def poses(self):
        """The poses of the vehicle, float64 [pose, 8]: t, x, y, z, qx, qy, qz, qw."""
        return np.loadtxt(self.folder / "trajectory.tum", ndmin=2)


class Points(typing.NamedTuple):
    """Surface that a ping shows, a point for each bin of it."""
    position_m: np.ndarray      # float64 [n, 3]
    instance: np.ndarray        # [n], as in Dataset.instances
    class_id: np.ndarray        # [n], as in Dataset.classes
    bins: np.ndarray            # [n, 2]: row and column in the arrays of the ping


class Sensor:
    """A sonar of a dataset: a sequence of samples. `name`, `kind`, `range_edges_m`, `azimuth_edges_rad` (None where the
    kind has none), `pings` (the number of the pose of each), `keys` (what a sample holds)."""

    def __init__(self, folder, description):
        self.folder = folder
        self.description = description
        self.name = checked(description["name"], re.compile(NAME, re.ASCII), "name")
        self.kind = checked(description["kind"], ANY_TEXT, "kind")
        self.range_edges_m = numbers(description["range_edges_m"], "range_edges_m")
        azimuth = description.get("azimuth_edges_rad")
        self.azimuth_edges_rad = None if azimuth is None else numbers(azimuth, "azimuth_edges_rad")
        every, pings = (whole(description[key], low, key) for key, low in (("every", 1), ("pings", 0)))
        self.pings = range(0, every * pings, every)
        self._files = description["files"]
        self._records = dict(description.get("label_records", {}))
        if "records" in description:
            record = description["records"]
            # In a dataset of an older sonarsim only the name of the file gives the name of the record.
            name = record.get("name", pathlib.PurePath(record["file"]).stem)
            self._records[checked(name, re.compile(NAME, re.ASCII), "records.name")] = record
        for pattern in self._files.values():
            self._path(pattern, PATTERN)
        for record in self._records.values():
            self._path(record["file"], INNER_PATH)
        for one in description.get("pictures", ()):
            for key in ("file", "boxes_of")[:2 if one["per"] != "ping" and "boxes_of" in one else 1]:
                self._path(one[key], INNER_PATH if one["per"] == "sensor" else PATTERN)
        self._arrays = {}
        self.keys = [*self._files, *self._records]

    def _path(self, path, rule):
        """ValueError unless the path, or pattern, lies in the folder of the sensor."""
        if not checked(path, rule, "file").startswith(self.name + "/"):
            raise Damage(f"sensor {self.name!r} has {path!r}, which is not in its folder")

    def __len__(self):
        return len(self.pings)

    def __getitem__(self, index):
        if isinstance(index, slice):
            return [self[k] for k in range(*index.indices(len(self)))]
        if not -len(self) <= index < len(self):
            raise IndexError(f"ping {index} of {len(self)}")
        return Sample(self, index % len(self))

    def records(self, name):
        """All records of a name, as an array that is mapped, not read; its axes are given by axes()."""
        if name not in self._arrays:
            path = own_file(self.folder, self._records[name]["file"])
            self._arrays[name] = np.load(path, mmap_mode="r")
        return self._arrays[name]

    def axes(self, name):
        """The axes of records(name), as in ['range', 'ping']."""
        return self._records[name]["axes"]

    def file(self, index, name):
        """The path of a ping's file. ValueError where it is missing or lies behind a link."""
        if name not in self._files:
            raise KeyError(f"sensor {self.name!r} has no {name!r}, but {', '.join(self.keys)}")
        return own_file(self.folder, self._files[name] % self.pings[index])

    def picture(self, per):
        """The picture of dataset.json whose objects are labelled, per "sensor" or "sweep"; None for none."""
        pictures = self.description.get("pictures", ())
        return next((one for one in pictures if one["per"] == per and "boxes_of" in one), None)

    def raw(self, index, name):
        """The bytes of a ping's file."""
        return self.file(index, name).read_bytes()

    def read(self, index, name):
        """The content of a ping's file or record of this name: an array, or a dict for JSON."""
        if name in self._records:
            records = self.records(name)
            return records[:, index] if self.axes(name)[-1] == "ping" else records[index]
        with reading(self.file(index, name)) as path:
            if path.suffix not in DECODERS:
                raise Damage("is of a kind that this cannot read")
            return DECODERS[path.suffix](path.read_bytes())

    def fan_shape(self, width):
        """(height, width, metres per pixel) of a fan that is `width` pixels wide."""
        half = 0.5 * (self.azimuth_edges_rad[-1] - self.azimuth_edges_rad[0])
        reach, wide = self.range_edges_m[-1], half > 0.5 * np.pi
        width_m = 2 * reach * (1 if wide else np.sin(half))
        height_m = reach * (1 - np.cos(half) if wide else 1)
        pixel_m = max(width_m, 0.5 * height_m) / width
        return int(np.ceil(height_m / pixel_m - 1e-6)), width, pixel_m

    def to_fan(self, polar, width=512, blank=0):
        """[range, azimuth, ...] as a fan [row, column, ...]: each pixel is the bin at its centre; `blank` beyond the sector."""
        height, width, pixel_m = self.fan_shape(width)
        ahead = self.range_edges_m[-1] - (np.arange(height)[:, None] + 0.5) * pixel_m
        port = (0.5 * width - (np.arange(width)[None, :] + 0.5)) * pixel_m
        row = bin_of(np.hypot(ahead, port), self.range_edges_m)
        azimuth = np.arctan2(port, ahead)
        column = bin_of(azimuth, self.azimuth_edges_rad)
        # Straight astern, a full turn ends.
        column = np.where(azimuth == self.azimuth_edges_rad[-1], len(self.azimuth_edges_rad) - 2, column)
        fan = np.asarray(polar)[np.maximum(row, 0), np.maximum(column, 0)]
        fan[(row < 0) | (column < 0)] = blank
        return fan

    def from_fan(self, fan):
        """A fan [row, column, ...] as [range, azimuth, ...]: each bin is the pixel at its centre."""
        fan = np.asarray(fan)
        height, width, pixel_m = self.fan_shape(fan.shape[1])
        if height != fan.shape[0]:
            raise ValueError(f"a fan {width} wide is {height} high, not {fan.shape[0]}")
        ranges = middles(self.range_edges_m)[:, None]
        azimuths = middles(self.azimuth_edges_rad)[None, :]
        row = (self.range_edges_m[-1] - ranges * np.cos(azimuths)) / pixel_m
        column = 0.5 * width - ranges * np.sin(azimuths) / pixel_m
        return fan[np.clip(row.astype(int), 0, height - 1), np.clip(column.astype(int), 0, width - 1)]

    def points(self, sample, frame="world", spread_rad=math.inf):
        """The Points of a ping of a fan, in the frame "world", "vehicle" or "sensor": for each bin with visible surface
        the middle of its range and azimuth, at its mean elevation. Bins whose elevation_spread is above `spread_rad`
        are left out: they may hold several surfaces, one above the other. Sound is taken to be straight and the sonar
        to stand still while it listens. ValueError without the labels, or for a kind without a fan."""
        if self.kind not in ("imaging", "profiling"):
            raise ValueError(f"sensor {self.name!r} has no points: {self.kind} sonars have no fan")
        wanted = "elevation", "elevation_spread", "instance", "class"
        if not set(wanted) <= self._files.keys():
            raise ValueError(f"sensor {self.name!r} has no points: set output.labels: [elevation, instance, class] and "
                             "render it again")
        elevation, spread, instance, class_id = (sample[name] for name in wanted)
        bins = np.argwhere((spread <= spread_rad) & (instance != 0))
        at = tuple(bins.T)
        r, b = middles(self.range_edges_m)[at[0]], middles(self.azimuth_edges_rad)[at[1]]
        sine = np.sin(elevation[at].astype(np.float64))
        if "instrument" in self.description:    # the calibrated model: columns are cones about the y axis
            y = r * np.sin(b)
            x = np.sqrt(np.maximum(r ** 2 * (1 - sine ** 2) - y ** 2, 0))
        else:
            level = r * np.sqrt(1 - sine ** 2)
            x, y = level * np.cos(b), level * np.sin(b)
        position = np.stack([x, y, r * sine], axis=1)
        if frame != "sensor":
            meta = sample["meta"]
            position = moved(position, meta["T_world_sensor"])
            if frame == "vehicle":
                position = moved(position, meta["T_world_vehicle"], inverse=True)
            elif frame != "world":
                raise ValueError(f"there is no frame {frame!r}; there are: world, vehicle, sensor")
        return Points(position, instance[at], class_id[at], bins)


class Sample(collections.abc.Mapping):
    """A ping of a sensor. Its arrays are read when needed: sample['polar']."""

    def __init__(self, sensor, index):
        self.sensor, self.index = sensor, index
        self.ping = sensor.pings[index]     # the number of its pose

    def __getitem__(self, name):
        return self.sensor.read(self.index, name)

    def __iter__(self):
        return iter(self.sensor.keys)

    def __len__(self):
        return len(self.sensor.keys)

    def __repr__(self):
        return f"<ping {self.ping} of {self.sensor.name}: {', '.join(self)}>"


def torch_dataset(sensor, names=("polar",), transform=None):
    """The pings of a sensor as a torch.utils.data.Dataset: each item a tuple of tensors in the order of `names`, JSON
    ones as text, or what `transform` makes of that tuple. ImportError without torch."""
    if not hasattr(sensor, "read"):
        raise TypeError(f"torch_dataset() takes a sensor, such as dataset.sensors['fls'], not a {type(sensor).__name__}")
    import torch  # pylint: disable=import-outside-toplevel,import-error

    class Pings(torch.utils.data.Dataset):
        def __len__(self):
            return len(sensor)

        def __getitem__(self, index):
            # torch has no uint16; ids fit its int32.
            found = [sensor.read(index, name) for name in names]
            tensors = tuple(json.dumps(one) if isinstance(one, dict) else
                            torch.from_numpy(np.array(one, np.int32 if one.dtype == np.uint16 else None)) for one in found)
            return transform(tensors) if transform else tensors

        def __reduce__(self):       # for the workers of a DataLoader
            return torch_dataset, (sensor, names, transform)

    return Pings()


def moved(points, pose, inverse=False):
    """Points [n, 3] of the frame `b` in the frame `a`, by a pose T_a_b of a meta file; `inverse`: the other way."""
    x, y, z, w = pose["quaternion_xyzw"]
    turn = np.array([[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]])
    return (points - pose["position_m"]) @ turn if inverse else points @ turn.T + pose["position_m"]


def bin_of(values, edges):
    """The index of the bin [edges[i], edges[i + 1]) of each value; -1 outside."""
    index = np.searchsorted(edges, values, side="right") - 1
    return np.where(index < len(edges) - 1, index, -1)


def middles(edges):
    return 0.5 * (edges[:-1] + edges[1:])


class DataError(ValueError):
    """What is wrong with a dataset; the text names the file."""


class Damage(ValueError):
    """What is wrong in a file: a sentence that lacks its subject. reading() adds it."""


# What comes from the content of a damaged file; the last four from numpy.
FAULTS = (ValueError, LookupError, TypeError, AttributeError, ArithmeticError, SyntaxError, EOFError, RecursionError,
          tokenize.TokenError)


@contextlib.contextmanager
def reading(path):
    """Makes a DataError, which names the file, of any error that comes from what is in the file."""
    try:
        yield path
    except DataError:
        raise
    except FAULTS as fault:
        raise DataError(f"{path}: is damaged: {what_is_wrong(fault)}; sonarsim verify says more") from fault


def what_is_wrong(fault):
    """A sentence for one of FAULTS. The texts of Python and numpy mean nothing to who uses a command."""
    if isinstance(fault, Damage):
        return str(fault)
    if isinstance(fault, json.JSONDecodeError):
        return f"is not JSON from line {fault.lineno}, column {fault.colno} on"
    if isinstance(fault, KeyError) and fault.args:
        return f"lacks {str(fault.args[0])[:80]!r}"
    return "has a value of a type or size that sonarsim does not write"


def checked(text, rule, key):
    """The text, if all of it matches the rule; else Damage."""
    if isinstance(text, str) and rule.fullmatch(text):
        return text
    raise Damage(f"{key!r} is {str(text)[:80]!r}, which is not a name that sonarsim gives")


def whole(number, low, key):
    """The number, if it is whole, not below `low` and below 2^32; else Damage."""
    if isinstance(number, int) and not isinstance(number, bool) and low <= number < 1 << 32:
        return number
    raise Damage(f"{key!r} is {repr(number)[:80]} and must be a whole number from {low} on")


def numbers(values, key):
    """A list of finite numbers as an array; else Damage."""
    array = np.array(values, float)
    if array.ndim != 1 or not np.isfinite(array).all():
        raise Damage(f"{key!r} is not a list of numbers")
    return array


def own_file(folder, inner, is_folder=False):
    """The path of a file, or folder, in a folder. ValueError where it is missing or lies behind a link."""
    path = folder / inner
    there = path.is_dir() if is_folder else path.is_file()
    if not there or os.path.realpath(path) != os.path.join(os.path.realpath(folder), inner):
        raise DataError(f"{path}: is missing, or lies behind a link; the render command completes a dataset")
    return path


def read_png(data):
    """A PNG of 8 or 16 bits in grey or RGB, or of 8 bits with a colour table, that is not interlaced, as [row, column]
    or [row, column, 3]; with a colour table the numbers of the colours, which are ids. ValueError for any other."""
    if data[:8] != b"\x89PNG\r\n\x1a\n":
        raise Damage("is not a PNG")
    packed, header, at = [], None, 8
    while at + 12 <= len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        chunk = data[at + 8:at + 8 + size]
        if kind == b"IHDR" and len(chunk) == 13:
            header = struct.unpack(">IIBBBBB", chunk)
        elif kind == b"IDAT":
            packed.append(chunk)
        at += size + 12
    if header is None:
        raise Damage("is a PNG without a header")
    width, height, bits, colour, _, _, interlaced = header
    if (bits, colour) not in PNG_KINDS or interlaced:
        raise Damage("is a PNG of a kind that sonarsim does not write")
    channels = 3 if colour == 2 else 1
    pixel = channels * bits // 8
    expected = height * (1 + width * pixel)
    if not width or not height or expected > MAX_INFLATED * len(data):
        raise Damage("is a PNG whose width and height cannot be right")
    rows = np.frombuffer(unpacked(b"".join(packed), expected), np.uint8)
    rows = rows.reshape(height, 1 + width * pixel)
    pixels = unfiltered(rows[:, 0], rows[:, 1:].reshape(height, width, pixel))
    values = pixels.view(">u2").astype(np.uint16) if bits == 16 else pixels
    return values.reshape((height, width, channels) if channels > 1 else (height, width))


def unpacked(data, expected):
    """The bytes that zlib packed; ValueError if they are not `expected` bytes."""
    stream = zlib.decompressobj()
    try:
        out = stream.decompress(data, expected + 1)
    except zlib.error as fault:
        raise Damage(f"cannot be unpacked: {fault}") from fault
    if len(out) != expected:
        raise Damage("is a PNG with more or fewer rows than its header says")
    return out


def unfiltered(filters, rows):
    """PNG rows [row, column, byte of the pixel] without their filters: none, left or above, as sonarsim writes them."""
    out = np.array(rows)
    for y in np.flatnonzero(filters):
        if filters[y] == 1:
            out[y] = np.cumsum(rows[y], axis=0, dtype=np.uint8)
        elif filters[y] == 2:
            out[y] += out[y - 1] if y else 0
        else:
            raise Damage("is a PNG with filters that sonarsim does not use")
    return out


def read_npy(data):
    """The array in a .npy file, format 1.0; ValueError if it is not such a file, or not as long as its header says."""
    file = io.BytesIO(data)
    if np.lib.format.read_magic(file) != (1, 0):
        raise Damage("is not a .npy file, format 1.0")
    shape, _, dtype = np.lib.format.read_array_header_1_0(file)
    if dtype.hasobject or math.prod(shape) * dtype.itemsize != len(data) - file.tell():
        raise Damage(f"is {len(data)} bytes long, and its header says {shape} of {dtype}")
    return np.load(io.BytesIO(data))


def read_json(data):
    """What JSON says; Damage also for text that no file can hold."""
    try:
        value = json.loads(data)
        if re.search(rb"\\u[dD][89a-fA-F]", data):
            json.dumps(value, ensure_ascii=False).encode()
        return value
    except RecursionError as fault:
        raise Damage("is JSON that is nested too deep") from fault
    except UnicodeError as fault:
        raise Damage("is not UTF-8, or has one half of a letter of UTF-16") from fault


DECODERS = {".npy": read_npy, ".png": read_png, ".json": read_json}
