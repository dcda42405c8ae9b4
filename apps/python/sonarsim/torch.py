"""Pings for a network, rendered while it trains. Needs PyTorch.

    from sonarsim.torch import PingDataset
    data = PingDataset("mission.yaml", sensor="fls", names=("image", "class"))
    for images, classes in torch.utils.data.DataLoader(data, batch_size=8, num_workers=2):
        ...
"""
from __future__ import annotations

import json
import os
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np

try:
    import torch
except ImportError as missing:
    raise ImportError("sonarsim.torch needs PyTorch, which is not installed: apt install python3-torch, "
                      "or pip install torch") from missing

import sonarsim

__all__ = ["PingDataset", "tensor_of"]


class PingDataset(torch.utils.data.IterableDataset):  # type: ignore[misc]
    """The pings of a mission in the order of the poses, variant after variant; the numbers are those of
    the files that `sonarsim render` writes.

    `mission`, `set` and `paths_from` are those of sonarsim.open(). `sensor`: its name, needed if the
    mission has several. An item is a tuple of tensors in the order of `names`: "image", "raw" or a
    label; or what `transform` makes of the sonarsim.Ping. uint16 becomes int32, since torch has none;
    "objects" is JSON text.

    `shard` (i, n) is the part of a process among several machines, as in sonarsim.Mission.pings().
    Each worker of a DataLoader renders its share of it, which is disjoint from the others', on
    `threads` threads: whole variants if there are at least as many as workers, else every n-th ping.
    Which pings come does not depend on the number of workers; their order does, since the loader takes
    batches from the workers in turn. Each worker opens the mission itself.
    """

    def __init__(self, mission: str | os.PathLike[str] | Mapping[str, Any],
                 set: Mapping[str, Any] | None = None, *, sensor: str | None = None, names: tuple[str, ...] = ("image",),
                 transform: Callable[[sonarsim.Ping], Any] | None = None, threads: int = 1,
                 shard: tuple[int, int] = (0, 1), paths_from: str | os.PathLike[str] | None = None):
        super().__init__()
        self._source = (mission, set, paths_from)
        self._names, self._transform = names, transform
        self._threads, self._shard = threads, shard
        # Mistakes in the mission show here, not in a worker. Its files are read in the workers.
        loaded = self._load()
        sensors = loaded.sensor_names
        if sensor is None and len(sensors) > 1:
            raise ValueError(f"mission {loaded.name!r} has the sensors {', '.join(sensors)}: name one")
        self.sensor = sensors[0] if sensor is None else sensor
        self._count = loaded.count(self.sensor, shard=shard)

    def __len__(self) -> int:
        """The number of pings of this shard, over all workers."""
        return self._count

    def __iter__(self) -> Iterator[Any]:
        worker = torch.utils.data.get_worker_info()
        # The workers share this shard: which pings it has must not depend on their number.
        share = (0, 1) if worker is None else (worker.id, worker.num_workers)
        for ping in self._load()._pings(self.sensor, self._threads, self._shard, share):
            yield self._transform(ping) if self._transform else tuple(tensor_of(ping, name) for name in self._names)

    def _load(self) -> sonarsim.Mission:
        mission, set_, paths_from = self._source
        return sonarsim.load(mission, set_, paths_from=paths_from)


def tensor_of(ping: sonarsim.Ping, name: str) -> Any:
    """"image", "raw" or a label of a ping as a tensor, without a copy unless it is uint16. `objects` is JSON
    text, since a DataLoader puts texts of any length into a batch. KeyError for a name that the ping does not have."""
    values = {"image": ping.image, "raw": ping.raw, **ping.labels}.get(name)
    if values is None:
        have = ["image", *(["raw"] if ping.raw is not None else []), *ping.labels]
        raise KeyError(f"sensor {ping.sensor!r} has no {name!r}, but {', '.join(have)}; output.labels of the "
                       "mission says which labels there are")
    if not isinstance(values, np.ndarray):
        return values if isinstance(values, str) else json.dumps(values)
    return torch.from_numpy(values.astype(np.int32) if values.dtype == np.uint16 else values)
