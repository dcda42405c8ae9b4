"""Sonar data in memory: the pings of a mission, with the same numbers as the files of `sonarsim render`.

    import sonarsim
    mission = sonarsim.open("mission.yaml", set={"seed": 3})
    ping = mission.ping(0, sensor="fls")
    ping.image                  # float32 [range, azimuth]
    ping.labels["class"]        # uint16 [range, azimuth], where output.labels asks for it
    ping.metadata["time_s"]
    for ping in mission:        # every ping of every sensor and variant
        ...

`sonarsim.data` reads written datasets; `sonarsim.torch` feeds a network on the fly. A mistake
in a mission is an InputError with the text of the command: file, line, what is wrong, what would be right.
"""
from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from . import _sonarsim
    from .mission import InputError, Mission, Ping, Sensor, Variants, load, open

    __version__: str = _sonarsim.version

__all__ = ["InputError", "Mission", "Ping", "Sensor", "Variants", "open"]


def __getattr__(name: str) -> Any:
    """Imports the compiled module with the first name that needs it: the commands of the package need none."""
    if name == "_sonarsim":
        return importlib.import_module("._sonarsim", __name__)
    if name == "__version__":
        return importlib.import_module("._sonarsim", __name__).version
    if name in __all__ or name == "load":
        return getattr(importlib.import_module(".mission", __name__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
