"""The pings of a mission in memory; `import sonarsim` has these names."""
from __future__ import annotations

import collections
import concurrent.futures
import dataclasses
import functools
import itertools
import json
import os
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, overload

import numpy as np
import numpy.typing as npt

try:
    from . import _sonarsim
    from ._sonarsim import InputError
except ImportError as error:
    raise ImportError(f"{sys.executable} finds no compiled module of sonarsim: install python3-sonarsim, or pybind11-dev "
                      f"and python3-dev and build sonarsim again ({error})") from error

Path = str | os.PathLike[str]


def open(mission: Path | Mapping[str, Any], set: Mapping[str, Any] | None = None, *,
         paths_from: Path | None = None) -> Mission:
    """Opens a mission: a YAML file, or a dict with the same keys.

    `set` changes keys, as --set does: {"sensors.fls.range_bins": 256}. A text is read as on the command line; another
    value is taken as it is. Relative paths of the mission start at `paths_from`: by default the folder of the file, or
    the current folder for a dict. InputError for anything wrong in the mission or the files that it names.
    """
    opened = load(mission, set, paths_from=paths_from)
    if not opened.variants:
        opened._loaded.read()
    return opened


def load(mission: Path | Mapping[str, Any], set: Mapping[str, Any] | None = None, *,
         paths_from: Path | None = None) -> Mission:
    """As open(), without reading the files that the mission names. They are read for the first ping."""
    settings = [f"{key}={value if isinstance(value, str) else _yaml(value)}" for key, value in (set or {}).items()]
    if isinstance(mission, Mapping):
        file, text, folder = "mission", _yaml(mission), os.getcwd()
    else:
        file, text = os.fspath(mission), None
        folder = os.path.dirname(file)
    base = folder if paths_from is None else os.fspath(paths_from)
    for given in (file, base, *settings, text):
        if isinstance(given, str):
            _require_utf8(given)
    return Mission(_sonarsim.load(file, base, settings, text))


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Sensor:
    """A sonar of a mission. `description` is its block in dataset.json (docs/dataset.md)."""

    name: str
    kind: str
    pings: range
    """The numbers of its pings: the poses that it pings at."""
    range_edges_m: npt.NDArray[np.float64]
    azimuth_edges_rad: npt.NDArray[np.float64] | None
    """From starboard (-) to port (+); None where the kind has none."""
    full_scale: float
    """The intensity that is white in pictures."""
    description: dict[str, Any]

    def __repr__(self) -> str:
        return f"<sensor {self.name!r}: {self.kind}, {len(self.pings)} pings>"


@dataclasses.dataclass(frozen=True, eq=False, repr=False)
class Ping:
    """A ping of a sonar. Its arrays may be changed."""

    sensor: str
    number: int
    """The number of its pose, which its files have in their names."""
    variant: int | None
    """The index of the variant; None for a mission without variants."""
    image: npt.NDArray[np.float32]
    """The intensities: [range, azimuth] as in polar/; where the kind has a record, the values of one row of it."""
    raw: npt.NDArray[np.integer[Any]] | None
    """The integers that the instrument of the calibrated model delivers, else None."""
    labels: dict[str, Any]
    """The labels of output.labels by the names of their files: arrays, and `objects` as a dict."""
    pose: npt.NDArray[np.float64]
    """The vehicle: t, x, y, z, qx, qy, qz, qw, in seconds and metres."""
    _metadata: str

    @functools.cached_property
    def metadata(self) -> dict[str, Any]:
        """The content of meta/NNNNNN.json."""
        return dict(json.loads(self._metadata))

    def __repr__(self) -> str:
        of = "" if self.variant is None else f" of variant {self.variant}"
        names = ", ".join(["image", *(["raw"] if self.raw is not None else []), *self.labels])
        return f"<ping {self.number} of {self.sensor!r}{of}: {names} {list(self.image.shape)}>"


class Mission:
    """A mission, as open() returns it. Many threads may make pings at a time, as each releases the interpreter lock."""

    def __init__(self, loaded: _sonarsim.LoadedMission):
        self._loaded = loaded
        self.variants = Variants(loaded)
        """Its variants, each a mission without variants; empty if it has none."""
        self.name, self.seed = loaded.name, loaded.seed
        self.sensor_names = [name for name, _ in loaded.sensors]
        """The names of the sonars, in the order of the mission."""

    @functools.cached_property
    def description(self) -> dict[str, Any]:
        """The dataset.json of the dataset that `sonarsim render` would begin."""
        return dict(json.loads(self._one().describe()))

    @functools.cached_property
    def sensors(self) -> dict[str, Sensor]:
        """The sonars by name, in the order of the mission."""
        return {one["name"]: _sensor(one) for one in self.description["sensors"]}

    @property
    def instances(self) -> dict[int, str]:
        """The names of the ids of the labels `instance`, `second` and `shadow`."""
        return self._names("instances")

    @property
    def classes(self) -> dict[int, str]:
        """The names of the ids of the labels `class` and `semantic`."""
        return self._names("classes")

    @property
    def materials(self) -> dict[int, str]:
        """The names of the ids of the label `material`."""
        return self._names("materials")

    @functools.cached_property
    def poses(self) -> npt.NDArray[np.float64]:
        """The poses of the vehicle [pose, 8]: t, x, y, z, qx, qy, qz, qw."""
        return self._one().poses()

    @functools.cached_property
    def warnings(self) -> list[str]:
        """The warnings that `sonarsim render` prints before the first ping."""
        return self._one().warnings()

    def ping(self, number: int, sensor: str | None = None) -> Ping:
        """The ping of a sensor at the pose of this number. The sensor may be left out if the mission
        has only one. IndexError where the sensor does not ping, KeyError for an unknown sensor."""
        loaded = self._one()
        names = self.sensor_names
        if sensor is None and len(names) > 1:
            raise ValueError(f"mission {self.name!r} has the sensors {', '.join(names)}: name one, as in "
                             f"ping({number}, sensor={names[0]!r})")
        index = 0 if sensor is None else _index_of(sensor, names)
        every = loaded.sensors[index][1]
        if not 0 <= number < len(self.poses) or number % every:
            rule = f"a multiple of {every} " if every > 1 else ""
            raise IndexError(f"sensor {names[index]!r} has no ping {number}: its numbers are {rule}"
                             f"from 0 to {len(self.poses) - 1}")
        return self._make(number, index)

    def pings(self, sensor: str | None = None, *, threads: int = 1, shard: tuple[int, int] = (0, 1)) -> Iterator[Ping]:
        """Iterates over the pings of all poses and variants, in the order of the poses.

        `sensor`: only the pings of this sensor. `threads`: the number of pings that are made at a time;
        up to eight for each thread are made ahead. `shard` (i, n): the i-th of n disjoint parts,
        counted from 0: whole variants if there are at least n, else every n-th ping.
        """
        index, count = shard
        if not 0 <= index < count:
            raise ValueError(f"shard is {shard} and must be (i, n) with i from 0 to n - 1")
        if threads < 1:
            raise ValueError(f"threads is {threads} and must be 1 or more")
        return self._pings(sensor, threads, shard)

    def __iter__(self) -> Iterator[Ping]:
        return self.pings()

    def __len__(self) -> int:
        """The number of pings of all sensors and variants."""
        return self.count()

    def count(self, sensor: str | None = None, *, shard: tuple[int, int] = (0, 1)) -> int:
        """The number of pings that pings() yields."""
        if self.variants:
            return sum(self.variants[k].count(sensor, shard=rest) for k, rest in self._shares(shard))
        poses = self._loaded.pose_count()
        everies = [self._loaded.sensors[k][1] for k in self._chosen(sensor)]
        return len(range(shard[0], sum(len(range(0, poses, every)) for every in everies), shard[1]))

    def __repr__(self) -> str:
        what = f"{len(self.variants)} variants, " if self.variants else ""
        return f"<mission {self.name!r}: {what}sensors {', '.join(self.sensor_names)}>"

    def _one(self) -> _sonarsim.LoadedMission:
        """The mission itself. ValueError if it has variants."""
        if self.variants:
            raise ValueError(f"mission {self.name!r} has {len(self.variants)} variants: ask one of "
                             "them, as in mission.variants[0]")
        return self._loaded

    def _names(self, kind: str) -> dict[int, str]:
        return {one["id"]: one["name"] for one in self.description.get("labels", {}).get(kind, [])}

    def _chosen(self, sensor: str | None) -> Sequence[int]:
        names = self.sensor_names
        return range(len(names)) if sensor is None else (_index_of(sensor, names),)

    def _jobs(self, sensor: str | None, shard: tuple[int, int]) -> Iterator[Callable[[], Ping]]:
        chosen = [(k, self._loaded.sensors[k][1]) for k in self._chosen(sensor)]
        numbers = ((number, k) for number in range(self._loaded.pose_count()) for k, every in chosen if number % every == 0)
        for number, k in itertools.islice(numbers, shard[0], None, shard[1]):
            yield functools.partial(self._make, number, k)

    def _pings(self, sensor: str | None, threads: int, *shards: tuple[int, int]) -> Iterator[Ping]:
        """The pings of a shard; with more of them, of a shard of that shard."""
        shares = self._shares(*shards)
        if not self.variants:
            return _ahead(self._jobs(sensor, shares[0][1]), threads)
        return (ping for k, rest in shares for ping in self.variants[k].pings(sensor, threads=threads, shard=rest))

    def _shares(self, *shards: tuple[int, int]) -> list[tuple[int, tuple[int, int]]]:
        """The variants of a shard, or of a shard of a shard, each with the shard of its pings; at least one."""
        shares = [(k, (0, 1)) for k in range(max(1, len(self.variants)))]
        for index, count in shards:
            cut = [(k, (first + step * index, step * count)) for k, (first, step) in shares]
            shares = shares[index::count] if len(shares) >= count else cut
        return shares

    def _make(self, number: int, index: int) -> Ping:
        image, arrays, texts, metadata = self._loaded.ping(number, index)
        raw = arrays.pop("raw", None)
        labels: dict[str, Any] = arrays | {name: json.loads(text) if extension == ".json" else text
                                           for name, (extension, text) in texts.items()}
        variant = self._loaded.variant
        return Ping(self._loaded.sensors[index][0], number, None if variant < 0 else variant, image, raw,
                    labels, self.poses[number].copy(), metadata)


class Variants(Sequence[Mission]):
    """The variants of a mission, in order. Each reads its files for its first ping; the last reference frees it."""

    def __init__(self, loaded: _sonarsim.LoadedMission):
        self._loaded = loaded
        self._drawn: list[_sonarsim.LoadedMission] | None = None

    def __len__(self) -> int:
        return self._loaded.variant_count

    @overload
    def __getitem__(self, index: int) -> Mission: ...

    @overload
    def __getitem__(self, index: slice) -> list[Mission]: ...

    def __getitem__(self, index: int | slice) -> Mission | list[Mission]:
        if isinstance(index, slice):
            return [self[k] for k in range(*index.indices(len(self)))]
        if not -len(self) <= index < len(self):
            raise IndexError(f"variant {index} of {len(self)}")
        if self._drawn is None:
            self._drawn = self._loaded.variants()
        return Mission(self._drawn[index].unread())


def _yaml(value: Any) -> str:
    """JSON, which is YAML as well."""
    def plain(other: Any) -> Any:
        if isinstance(other, os.PathLike):
            return os.fspath(other)
        if isinstance(other, np.generic | np.ndarray):
            return other.tolist()
        raise TypeError(f"a mission cannot hold {other!r}: it takes numbers, texts, lists and dicts")

    return json.dumps(value, ensure_ascii=False, default=plain)


def _require_utf8(text: str) -> None:
    try:
        text.encode()
    except UnicodeEncodeError as fault:
        near = text[max(0, fault.start - 30):fault.start + 30]
        raise InputError(f"mission: {near!r} has one half of a letter of UTF-16, which no file can hold; write the whole "
                         "letter") from None


def _index_of(sensor: str, names: list[str]) -> int:
    if sensor not in names:
        raise KeyError(f"there is no sensor {sensor!r}, but {', '.join(names)}")
    return names.index(sensor)


def _sensor(description: dict[str, Any]) -> Sensor:
    every = description["every"]
    azimuth = description.get("azimuth_edges_rad")
    return Sensor(description["name"], description["kind"], range(0, every * description["pings"], every),
                  np.array(description["range_edges_m"]), None if azimuth is None else np.array(azimuth),
                  description["full_scale"], description)


def _ahead(jobs: Iterable[Callable[[], Ping]], threads: int) -> Iterator[Ping]:
    """The results of the jobs in their order. Threads work ahead while a batch is trained on; at most
    eight results for each thread wait. RuntimeError in a fork of the process: it has none of the threads."""
    if threads == 1:
        for job in jobs:
            yield job()
        return
    pool, process = concurrent.futures.ThreadPoolExecutor(threads), os.getpid()
    waiting: collections.deque[concurrent.futures.Future[Ping]] = collections.deque()
    try:
        while True:
            if os.getpid() != process:
                raise RuntimeError("pings() began before this process was forked from its parent, where its threads are; "
                                   "call pings() in the child")
            waiting.extend(pool.submit(job) for job in itertools.islice(jobs, 8 * threads - len(waiting)))
            if not waiting:
                return
            yield waiting.popleft().result()
    finally:
        if os.getpid() == process:
            pool.shutdown(cancel_futures=True)
